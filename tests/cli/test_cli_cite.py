"""``wearsim cite``, and that CITATION.cff and the package say the same."""

import re
import tomllib
from pathlib import Path

import pytest
import yaml

import wearsim
from wearsim.citation import citation_facts

ROOT = Path(__file__).parents[2]
REFERENCE_KEYS = {
    "type",
    "title",
    "authors",
    "publisher",
    "journal",
    "volume",
    "issue",
    "year",
    "start",
    "end",
    "doi",
    "notes",
}
TYPES = {"article", "book", "standard"}
"""Those of the schema of Citation File Format 1.2.0 that are used here."""


def check_authors(authors):
    assert authors
    for author in authors:
        assert set(author) in ({"name"}, {"family-names"}, {"family-names", "given-names"})
        assert all(isinstance(value, str) and value for value in author.values())


def test_cff_is_the_file(cli):
    assert cli("cite", "--format", "cff").out == (ROOT / "CITATION.cff").read_text("utf-8")


def test_cff_follows_its_rules(cli):
    content = yaml.safe_load(cli("cite", "--format", "cff").out)
    assert content["cff-version"] == "1.2.0"
    assert {"message", "title", "authors"} <= set(content)
    assert content["type"] in ("software", "dataset")
    assert content["version"] == wearsim.__version__
    assert len(content["keywords"]) == len(set(content["keywords"]))
    check_authors(content["authors"])
    for reference in content["references"]:
        assert {"type", "title", "authors"} <= set(reference) <= REFERENCE_KEYS
        assert reference["type"] in TYPES
        check_authors(reference["authors"])
        assert isinstance(reference.get("year", 0), int)
        assert re.fullmatch(r"10\.\d{4,9}/\S+", reference.get("doi", "10.1234/x"))
        assert all(isinstance(reference.get(key, ""), str) for key in ("issue", "start", "end"))
        assert set(reference.get("publisher", {"name": ""})) == {"name"}


def test_facts_agree_with_the_package():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    assert citation_facts()["title"] == project["name"]
    assert citation_facts()["abstract"] == project["description"]
    assert citation_facts()["license"] == project["license"]
    assert citation_facts()["keywords"] == project["keywords"]


@pytest.mark.parametrize("style", ["text", "apa", "bibtex", "cff"])
def test_every_source_is_named(cli, style):
    done = cli("cite", "--format", style)
    assert (done.code, done.err) == (0, "")
    for reference in citation_facts()["references"]:
        assert reference["authors"][0].get("family", "") in done.out
        assert reference["title"].split(":")[0] in done.out
    assert "Andrienko" in done.out and wearsim.__version__ in done.out


def test_text_is_the_default_and_says_what_for(cli):
    text = cli("cite").out
    assert text == cli("cite", "--format", "text").out
    for command in ("stiffness-spectrum", "wave-drive", "face-load", "strength", "synthesise"):
        assert f"  {command}" in text


def test_apa(cli):
    assert (
        "Golubkov, V. A., Shishlakov, V. F., Sharafudinov, T. T., & Lukyanenko, I. N. (2016). Modeling "
        "spectral characteristics of gear engagement stiffness. Information and Control Systems, 6, 99. "
        "https://doi.org/10.15217/issn1684-8853.2016.6.99"
    ) in cli("cite", "--format", "apa").out.splitlines()


def test_bibtex_is_well_formed(cli):
    text = cli("cite", "--format", "bibtex").out
    entries = re.findall(r"^@(\w+)\{(\w+),\n((?:  \w+ = \{.*\},\n)+)\}$", text, re.MULTILINE)
    assert len(entries) == 1 + len(citation_facts()["references"]) == text.count("@")
    assert len({key for _, key, _ in entries}) == len(entries)
    assert {kind for kind, _, body in entries if "journal = " not in body} == {"software", "book", "misc"}
    assert {"archard1953", "lewis2004", "dowson1968", "johnson"} <= {key for _, key, _ in entries}
    for _, _, body in entries:
        assert body.count("{") == body.count("}")
        assert not re.search(r"(?<!\\)[&%$#_]", re.sub(r"doi = \{.*\}", "", body))
    assert "author = {Andrienko and Pavlov and Ustinenko and others}" in text


def test_unknown_style(cli):
    assert cli("cite", "--format", "ris").code == 2


def test_sources_have_their_titles(cli):
    """The title pages of J. Appl. Phys. 24, 981, and Wear 261, 1253."""
    text = cli("cite", "--format", "bibtex").out
    assert "not on record" not in text
    assert "Contact and rubbing of flat surfaces" in text
    assert "A mathematical model to predict railway wheel profile evolution due to wear" in text
