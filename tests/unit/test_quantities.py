"""The table of names holds every input key and every output column, and nothing else."""

import csv
import json
import typing
from pathlib import Path
from types import SimpleNamespace

import pytest
from click.testing import CliRunner
from pydantic import BaseModel

import wearsim
from tests.drives import STRAND, changed
from tests.photographs import Camera, new_gap, picture, wheel
from wearsim.cad.wheel_drawing import wheel_points
from wearsim.case.keys import CaseTablesOrDrive
from wearsim.case.keys.study_tables import Distribution
from wearsim.catalogue.catalogues import catalogue_rows
from wearsim.cli.main import wearsim_command
from wearsim.cli.schema import result_schema
from wearsim.command.registry import CALCULATIONS, OTHER_FILES, tables_of
from wearsim.drive.load_case import load_case
from wearsim.input.csv_tables import read_prescribed
from wearsim.input.duty_log import COLUMNS as LOG_COLUMNS
from wearsim.input.faults import Faults
from wearsim.input.mechanism_registry import MECHANISMS
from wearsim.mechanisms.wrap.tooth_loads import tooth_loads
from wearsim.quantities import Quantity, quantities
from wearsim.readings.dated_rows import TIMES
from wearsim.report.comparison import comparison_table
from wearsim.report.flank_view import profile_table
from wearsim.report.loads_table import loads_json
from wearsim.report.worn_flank import wheel_shapes
from wearsim.runner.scatter import ScatteredKey
from wearsim.runner.shard import COLUMNS
from wearsim.study.calibrate.model import calibrate
from wearsim.study.calibrate.readings import OPTIONAL, REQUIRED
from wearsim.study.calibrate.sheet import readings_table, values_table
from wearsim.study.judge.model import judge_series
from wearsim.study.judge.series_file import COLUMNS as SERIES_COLUMNS
from wearsim.study.judge.series_file import read_series
from wearsim.study.judge.sheet import constants_table, forecasts_table, laws_table
from wearsim.study.optimise.search_space import SearchSpace
from wearsim.study.optimise.sheet import candidates_table
from wearsim.study.optimise.trials import Candidate, OptimiseOutcome
from wearsim.study.select.ranking import select
from wearsim.study.select.requirements import DriveRequirements
from wearsim.study.select.sheet import drives_table
from wearsim.study.sensitivity.model import KeyEffect
from wearsim.study.sensitivity.sheet import SensitivityAnswer, sensitivity_table

CASE = changed(STRAND, {"sprocket.evolute_offset_mm": 5.6, "stop.critical_depth_mm": 0.01})

CALCULATION_CASES = sorted((Path(__file__).parents[2] / "cases" / "sizing").glob("*.toml"))
OTHER_ENDINGS = {"h": "hours", "km/h": "km_per_hour", "t/h": "tonnes_per_hour", "ml/h": "ml_per_hour"}
"""Endings of names whose unit is written otherwise in the table."""
WORDS_AFTER_UNIT = ("_at_least", "_low", "_high", "_run")


def ending(unit):
    """How a name in a unit ends: ``N_per_mm_um`` for N/(mm*um), ``per_mm`` for 1/mm."""
    if unit in OTHER_ENDINGS:
        return OTHER_ENDINGS[unit]
    for sign, word in {"(": "", ")": "", "^": "", "*": "_", "1/": "per_", "/": "_per_"}.items():
        unit = unit.replace(sign, word)
    return unit


def tables_in(annotation):
    """Tables that a type is made of: itself, or in a list, a choice or both."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [table for inner in typing.get_args(annotation) for table in tables_in(inner)]


HERTZ_CHECK_FEM = {
    "meshes",
    "unknowns",
    "peak_pressure_error_percent",
    "half_width_error_percent",
    "surface_error_percent",
    "from_middle_mm",
}
"""Columns of ``hertz-check --fem``, which takes scikit-fem."""


def input_keys(model):
    for name, field in model.model_fields.items():
        tables = tables_in(field.annotation)
        for table in tables:
            yield from input_keys(table)
        if not tables:
            yield field.alias or name


def all_input_keys():
    return {key for model in (CaseTablesOrDrive, *map(tables_of, OTHER_FILES)) for key in input_keys(model)}


def keys_below(content):
    """Keys of all objects of a JSON value."""
    if isinstance(content, dict):
        yield from content
    if isinstance(content, dict | list):
        for inner in content.values() if isinstance(content, dict) else content:
            yield from keys_below(inner)


def calculation_columns(path, folder):
    """JSON keys and columns that the command writes whose name a case file starts with."""
    command = max((name for name in CALCULATIONS if path.stem.startswith(name)), key=len)
    with pytest.MonkeyPatch.context() as patch:
        # Pictures have no columns, and take twice as long as all the rest.
        patch.setattr("matplotlib.figure.Figure.savefig", lambda *_, **__: None)
        done = CliRunner().invoke(
            wearsim_command, ["handbook", command, str(path), "-q", "--out", str(folder)]
        )
    assert done.exit_code == 0, done.output
    yield from keys_below(json.loads((folder / "result.json").read_text(encoding="utf-8")))
    for table in folder.glob("*.csv"):
        with table.open(encoding="utf-8", newline="") as file:
            yield from next(csv.reader(file))


def catalogue_columns():
    for table in ("chains", "materials", "wear_conditions", "lubricants", "environments", "regimes"):
        yield from catalogue_rows(table)[0]
    yield from Quantity.__annotations__
    yield "file"


def scan_columns(path):
    """Return the columns of both tables of a scan."""
    picture(wheel([new_gap(12.7, 8.51, 12)] * 12), Camera(size=(400, 400))).save(path)
    found = wearsim.scan(path, chain="08B")
    return {*found.teeth, *found.gap}


def prescribed_columns(folder):
    """Columns of a table of loads, from the messages about an empty one and a full one."""
    required = ("arc_length_mm", "load_per_width_N_per_mm", "flank_curvature_per_mm")
    optional = ("slip_ratio", "sliding_distance_mm", "sliding_speed_mm_per_s")
    for last in optional[:2]:
        names = [*required, last, optional[2]]
        path = folder / f"{last}.csv"
        path.write_text("\n".join([",".join(names), *(f"{i},1,0,1,1" for i in range(6))]))
        assert read_prescribed(path, "mechanism.table_file", Faults("", "", ())) is not None
        yield from names


def wrapped():
    """Every column and key of a chain around a sprocket."""
    case = load_case(
        {
            **CASE,
            "sprocket": {"teeth": 12, "profile": "iso606", "nodes": 101},
            "mechanism": {"phases": 2},
            "run": {"horizon_hours": 10},
        }
    )
    result, loads = wearsim.simulate(case), loads_json(tooth_loads(case))
    yield from (*result.history, *result.flank, *result.summary(), *loads, *loads["teeth"][0])
    yield from result.summary()["limits"][0]


def study_columns():
    """Columns of the tables of studies."""
    scatter = ScatteredKey("load.tension_N", Distribution(distribution="lognormal", sigma_ln=1), 1.0, "")
    effect = KeyEffect(scatter, *[1.0] * 9)
    cases = Path(__file__).parents[2] / "cases"
    readings = cases / "studies" / "16b-20t-readings.csv"
    found = calibrate(cases / "16b-20t-oiled.toml", readings)
    answer = SensitivityAnswer(None, 1.0, [effect], {scatter.key: 1.0}, ())
    yield from (*COLUMNS, *sensitivity_table(answer).frame())
    yield from (*TIMES, *REQUIRED, *OPTIONAL, *readings_table(found).frame(), *values_table(found).frame())
    rows = [{"distance_km": 1500, "quantity": "elongation_percent", "value": 0.2}]
    state = wearsim.remaining(wearsim.load_case("bicycle-17t-road"), readings=rows)
    yield from (*state.intervals, *state.readings)
    measures = {"life_hours": 1.0, "mass_kg": 1.0}
    one = Candidate(1, (), measures, True, "critical_depth_mm", 0.0, "", "")
    study = SimpleNamespace(space=SearchSpace(()), measures=tuple(measures), limits={})
    yield from candidates_table(OptimiseOutcome(study, one, (one,), (one,), True), [one]).frame()
    yield from drives_table(select(DriveRequirements(3.0, 120.0, 2.7, 15_000.0))).frame()
    judgement = judge_series(
        read_series(cases / "studies" / "metal-wear.csv"), 100, lambda law, _: law == "powers"
    )
    yield from SERIES_COLUMNS
    yield from laws_table(judgement).frame()
    yield from (*constants_table(judgement), *forecasts_table(judgement))
    yield from ("samples", *(f"p{share}_hours" for share in (10, 50, 90)))


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Every column and key that goes out."""
    case = load_case(CASE)
    result = wearsim.simulate(case)
    schema = result_schema()
    return {
        *result.history,
        *result.flank,
        *result.summary(),
        *schema["$defs"]["life"]["properties"],
        *profile_table(case),
        *wheel_points(wheel_shapes(case, None), ("new",)),
        *comparison_table([result]).frame(),
        *wrapped(),
        *MECHANISMS["gear_pair"].flank,
        *(
            "time_s",
            "turned",
            "chains_per_sprocket",
            "chains_per_sprocket_at_least",
            "last_chain_used",
            "stops",
        ),
        *("cost_per_1000_h", "classes", "same_link_kind"),
        *HERTZ_CHECK_FEM,
        *catalogue_columns(),
        *study_columns(),
        *prescribed_columns(tmp_path_factory.mktemp("tables")),
        *scan_columns(tmp_path_factory.mktemp("photograph") / "wheel.png"),
        *LOG_COLUMNS,
        *(
            name
            for path in CALCULATION_CASES
            for name in calculation_columns(path, tmp_path_factory.mktemp(path.stem) / "out")
        ),
    }


def test_every_input_key_is_listed():
    assert all_input_keys() - set(quantities()) == set()


@pytest.mark.wide
def test_every_column_is_listed(written):
    assert written - set(quantities()) == set()


def test_no_row_is_unused(written):
    assert set(quantities()) - written - all_input_keys() == set()


def test_every_calculation_has_a_case():
    for command in CALCULATIONS:
        assert any(path.stem.startswith(command) for path in CALCULATION_CASES), command


def test_every_quantity_has_a_meaning():
    assert all(quantity.meaning for quantity in quantities().values())


def test_name_carries_the_unit():
    """A name ends in its unit, and a name that ends like one of the units has that unit."""
    endings = {ending(q.unit): q.unit for q in quantities().values() if q.unit}
    for name, quantity in quantities().items():
        bare = name
        for word in WORDS_AFTER_UNIT:
            bare = bare.removesuffix(word)
        found = [end for end in endings if f"_{bare}".endswith(f"_{end}")]
        assert quantity.unit == (endings[max(found, key=len)] if found else ""), name
