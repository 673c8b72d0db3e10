"""A member of a list is known wherever the list is used."""

import tomllib
from dataclasses import replace
from pathlib import Path

import pytest

import wearsim
from tests.drives import STRAND
from wearsim.cad import DRAWINGS, STATES, WHEELS
from wearsim.cad.printed_page import drawing_bytes
from wearsim.case.keys import SprocketTable
from wearsim.catalogue.catalogues import chains
from wearsim.chain.standard_teeth import standard_form, standard_tip_diameter
from wearsim.cli.export import export
from wearsim.cli.init import new_case
from wearsim.drive.load_case import load_case
from wearsim.geometry.forms import TOOTH_FORMS
from wearsim.geometry.scene import Scene, line
from wearsim.input.mechanism_registry import mechanism_of
from wearsim.quantities import either, quantities
from wearsim.result import WearResult

DOCS = Path(__file__).parents[2] / "docs"
STANDARDS = [name for name, form in TOOTH_FORMS.items() if form.standard_gap]


SPROCKET = {
    "format_version": 1,
    "chain": {"designation": "08B-1"},
    "sprocket": {"teeth": 19, "profile": "iso606", "nodes": 101},
    "load": {"tension_N": 500, "speed_rpm": 60},
    "wear": {"condition": "hardened, oiled"},
}


def first_chain(series):
    return next(chain for chain in chains().values() if chain.series in series and chain.strands == 1)


@pytest.mark.parametrize("form", TOOTH_FORMS)
def test_a_tooth_form_is_in_the_schema_and_in_the_docs(form):
    row = TOOTH_FORMS[form]
    assert set(row.keys) <= set(SprocketTable.model_fields)
    keys = {row.file: "any.csv"} if row.file else {}
    assert SprocketTable.model_validate({"teeth": 20, "profile": form, **keys}).profile == form
    assert form in new_case("16B-1", 20, "wrap")
    assert f'"{form}"' in (DOCS / "input.md").read_text(encoding="utf-8")
    kind = "strand" if row.on_strand else "wrap"
    assert f".{kind}." in mechanism_of({"sprocket": {"profile": form}}).build


@pytest.mark.parametrize("form", STANDARDS)
def test_a_standard_form_makes_the_sprocket_of_its_chains(form):
    chain = first_chain(TOOTH_FORMS[form].series)
    text = new_case(chain.designation, 20, "wrap").replace(f'"{standard_form(chain)}"', f'"{form}"')
    case = load_case(tomllib.loads(text))
    assert case.inputs["sprocket"].keys() >= {"seat_centre", *TOOTH_FORMS[form].options}
    if chain.series in TOOTH_FORMS[form].usual_for:
        assert case.inputs["sprocket"]["tip_diameter_mm"] == standard_tip_diameter(chain, 20)


@pytest.mark.parametrize("series", sorted({chain.series for chain in chains().values()}))
def test_chains_of_a_series_have_one_usual_tooth_form(series):
    (usual,) = (name for name, form in TOOTH_FORMS.items() if series in form.usual_for)
    assert series in TOOTH_FORMS[usual].series
    written = tomllib.loads(new_case(first_chain((series,)).designation, 20, "wrap"))
    assert written["sprocket"]["profile"] == usual


@pytest.mark.parametrize(
    "form", [pytest.param(name, marks=[pytest.mark.slow] * bool(row.library)) for name, row in WHEELS.items()]
)
def test_a_wheel_is_written_in_every_format(form, tmp_path):
    choices = {option.name: option.type for option in export.params}
    assert form in choices["form"].choices and tuple(STATES) == tuple(choices["state"].choices)
    assert f"\n| `{form}` |" in (DOCS / "export.md").read_text(encoding="utf-8")
    if WHEELS[form].library:
        pytest.importorskip(WHEELS[form].library)
    for ending in (form, *WHEELS[form].endings):
        wearsim.export(SPROCKET, tmp_path / f"wheel.{ending}")
        assert (tmp_path / f"wheel.{ending}").stat().st_size > 1000


@pytest.mark.parametrize("form", DRAWINGS)
def test_a_drawing_is_written_in_every_format_of_a_gauge(form):
    endings = either(f".{name}" for name in DRAWINGS)
    (template,) = (option for option in export.params if option.name == "template")
    assert endings in template.help
    assert endings in (DOCS / "export.md").read_text(encoding="utf-8")
    scene = Scene((0.0, 0.0, 10.0, 10.0), (line("check", [(0.0, 5.0), (10.0, 5.0)]),))
    assert drawing_bytes(scene, {"check": (7, 25, "Continuous")}, form)


def test_no_other_format_is_written(tmp_path):
    with pytest.raises(wearsim.WearsimError, match="must be one of dxf, svg, csv, step, stl, is 'pdf'"):
        wearsim.export(SPROCKET).content("pdf")


@pytest.fixture(scope="module")
def result():
    return wearsim.simulate(STRAND)


@pytest.mark.parametrize("table", ["history", "flank"])
def test_a_column_that_a_run_adds_is_saved_and_read(result, table, tmp_path):
    """It takes a row of quantities beside what computes it."""
    parquet = pytest.importorskip("pyarrow.parquet", reason="pyarrow is not installed")
    columns = getattr(result, f"{table}_columns")
    added = {**columns, "tip_land_mm": 0.5 * columns["cycles"]}
    replace(result, **{f"{table}_columns": added}).save(tmp_path / "run", parquet=True)
    read = getattr(WearResult.load(tmp_path / "run"), f"{table}_columns")
    assert [*read] == [*added] and all((read[name] == added[name]).all() for name in added)
    field = parquet.read_schema(tmp_path / "run" / f"{table}.parquet").field("tip_land_mm")
    assert field.metadata == {b"unit": quantities()["tip_land_mm"].unit.encode()}


@pytest.mark.parametrize("name", ["no_such_quantity", "depth_mm"])
def test_a_column_of_no_quantity_or_twice_is_no_result(result, name, tmp_path):
    result.save(tmp_path / "run")
    file = tmp_path / "run" / "flank.csv"
    head, *rows = file.read_text().split()
    file.write_text("\n".join([f"{head},{name}", *(f"{row},1" for row in rows)]))
    with pytest.raises(wearsim.WearsimError, match=r"flank.csv must hold rows of cycles, .*: run its case"):
        WearResult.load(tmp_path / "run")
