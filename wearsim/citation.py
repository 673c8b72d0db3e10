"""How to cite wearsim and the sources of its equations; the facts stand in citation.toml."""

import json
import re
import tomllib
from functools import cache
from importlib.resources import files
from typing import Any

from wearsim._version import __version__


@cache
def citation_facts() -> dict[str, Any]:
    """Return what is known of wearsim and its sources.

    Examples
    --------
    >>> citation_facts()["title"], len(citation_facts()["references"]) > 1
    ('wearsim', True)
    """
    text = files("wearsim").joinpath("citation.toml").read_text("utf-8")
    return {**tomllib.loads(text), "version": __version__}


def cff() -> str:
    """Return the Citation File Format 1.2.0, the content of ``CITATION.cff``."""
    known = citation_facts()
    lines = ["cff-version: 1.2.0", "type: software"]
    lines += [
        f"{key}: {_quoted(known[key])}" for key in ("message", "title", "abstract", "version", "license")
    ]
    lines += ["keywords:", *(f"  - {_quoted(word)}" for word in known["keywords"])]
    lines += ["authors:", *_cff_authors(known, "  ")]
    lines.append("references:")
    for reference in known["references"]:
        lines.append(f"  - type: {reference['type']}")
        lines.append(f"    title: {_quoted(reference['title'])}")
        lines += ["    authors:", *_cff_authors(reference, "      ")]
        if "publisher" in reference:
            lines += ["    publisher:", f"      name: {_quoted(reference['publisher'])}"]
        lines += [
            f"    {key}: {_quoted(reference[key])}"
            for key in ("journal", "volume", "issue", "year", "start", "end", "doi", "notes")
            if key in reference
        ]
    return "\n".join(lines) + "\n"


def _quoted(value: str | int) -> str:
    """Return a text as a double-quoted scalar of YAML, which JSON's strings are."""
    return json.dumps(value, ensure_ascii=False)


def _cff_authors(known: dict[str, Any], indent: str) -> list[str]:
    names = {"family": "family-names", "given": "given-names", "name": "name"}
    lines = []
    for author in known["authors"]:
        parts = [f"{names[key]}: {_quoted(value)}" for key, value in author.items()]
        lead = [f"{indent}- ", *[f"{indent}  "] * (len(parts) - 1)]
        lines += [start + part for start, part in zip(lead, parts, strict=True)]
    return lines


def bibtex() -> str:
    """Return entries for BibTeX."""
    known = citation_facts()
    own = {
        "author": _bibtex_authors(known),
        "title": _bibtex_text(known["title"]),
        "version": known["version"],
        "year": str(known["year"]),
        "note": _bibtex_text(known["abstract"]),
    }
    entries = [_bibtex_entry("software", "wearsim", own)]
    for reference in known["references"]:
        kind = _bibtex_kind(reference)
        pages = [str(reference[key]) for key in ("start", "end") if key in reference]
        fields = {
            "author": _bibtex_authors(reference),
            "title": _bibtex_text(reference["title"]),
            **{
                name: _bibtex_text(str(reference[key]))
                for name, key in (
                    ("journal", "journal"),
                    ("volume", "volume"),
                    ("number", "issue"),
                    ("publisher", "publisher"),
                    ("year", "year"),
                    ("doi", "doi"),
                    ("note", "notes"),
                )
                if key in reference
            },
            **({"pages": "--".join(pages)} if pages else {}),
        }
        entries.append(_bibtex_entry(kind, reference["key"], fields))
    return "\n".join(entries)


def _bibtex_kind(reference: dict[str, Any]) -> str:
    """Return the kind of an entry: an article must have a journal, a book publisher and year."""
    needed = {"article": ("journal",), "book": ("publisher", "year")}.get(reference["type"])
    return "misc" if needed is None or any(key not in reference for key in needed) else str(reference["type"])


def _bibtex_entry(kind: str, key: str, fields: dict[str, str]) -> str:
    lines = [f"  {name} = {{{value}}}," for name, value in fields.items()]
    return "\n".join([f"@{kind}{{{key},", *lines, "}", ""])


def _bibtex_text(text: str) -> str:
    return re.sub(r"([&%$#_{}])", r"\\\1", text)


def _bibtex_authors(known: dict[str, Any]) -> str:
    """Join authors; braces keep the name of a group in one piece."""
    return " and ".join(
        _bibtex_text(", ".join(filter(None, (author["family"], author.get("given")))))
        if "family" in author
        else "others"
        if author["name"].startswith("and ")
        else f"{{{_bibtex_text(author['name'])}}}"
        for author in known["authors"]
    )


def apa(version: str = __version__) -> str:
    """Return the references in the style of the APA."""
    known = citation_facts()
    own = (
        f"{_apa_authors(known)} ({known['year']}). {known['title']} (Version {version}) [Computer software]."
    )
    return "\n".join([own, *map(_apa_source, known["references"])]) + "\n"


def _apa_source(reference: dict[str, Any]) -> str:
    pages = "-".join(str(reference[key]) for key in ("start", "end") if key in reference)
    told = (reference.get(key) for key in ("journal", "volume", "issue"))
    place = ", ".join(str(part) for part in (*told, pages) if part)
    parts = [
        f"{_apa_authors(reference)} ({reference.get('year', 'n.d.')})",
        reference["title"],
        place or reference.get("publisher", ""),
    ]
    line = ". ".join(filter(None, parts)) + "."
    return f"{line} https://doi.org/{reference['doi']}" if "doi" in reference else line


def _apa_authors(known: dict[str, Any]) -> str:
    names = [
        ", ".join(filter(None, (author["family"], author.get("given"))))
        if "family" in author
        else author["name"]
        for author in known["authors"]
    ]
    if names[-1].startswith("and "):
        return f"{', '.join(names[:-1])}, {names[-1]}"
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])}, & {names[-1]}"


def citation_text() -> str:
    """Return what to cite in plain words, with what each source is used for."""
    known = citation_facts()
    own, *sources = apa().splitlines()
    lines = [known["message"], "", f"  {own}", "", "Sources of the equations:"]
    for reference, source in zip(known["references"], sources, strict=True):
        lines += ["", f"  {reference['used_by']}:", f"    {source}"]
        if "notes" in reference:
            lines.append(f"    {reference['notes']}")
    return "\n".join(lines) + "\n"
