"""The table of names holds every input key and every output column, and nothing else."""

import json
import typing
from importlib.resources import files

import pytest
from pydantic import BaseModel

import wearsim
from wearsim.case.load import load_case
from wearsim.case.messages import Faults
from wearsim.case.schema import CaseTables
from wearsim.case.tables import read_prescribed
from wearsim.catalogue.tables import rows
from wearsim.quantities import Quantity, quantities
from wearsim.report.compare import comparison_table
from wearsim.report.loads import loads_json
from wearsim.report.profile import profile_table
from wearsim.simulation.loads import tooth_loads

CASE = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "evolute_offset_mm": 5.6, "nodes": 51},
    "load": {"power_kW": 3, "speed_rpm": 100},
    "wear": {"condition": "hardened, oiled"},
    "stop": {"critical_depth_mm": 0.01},
}

UNITS = {
    "mm": "mm", "mm2": "mm^2", "N": "N", "MPa": "MPa", "kW": "kW", "kN": "kN", "rpm": "rpm",
    "deg": "deg", "hours": "h", "hours_low": "h", "hours_high": "h", "hours_run": "h",
    "N_m": "N*m", "per_mm": "1/mm", "mm_per_s": "mm/s", "mm2_per_N": "mm^2/N", "N_per_mm": "N/mm",
    "kg_per_m": "kg/m", "km_per_hour": "km/h", "tonnes_per_hour": "t/h", "s": "s",
}  # fmt: skip

HERTZ_CHECK_FEM = {
    "meshes", "unknowns", "peak_pressure_error_percent", "half_width_error_percent",
    "surface_error_percent", "from_middle_mm",
}  # fmt: skip
"""Columns of ``hertz-check --fem``, which takes scikit-fem."""


def input_keys(model):
    for name, field in model.model_fields.items():
        tables = [
            kind
            for kind in (field.annotation, *typing.get_args(field.annotation))
            if isinstance(kind, type) and issubclass(kind, BaseModel)
        ]
        if tables:
            yield from input_keys(tables[0])
        else:
            yield name


def catalogue_columns():
    for table in ("chains", "materials", "wear_conditions", "regimes"):
        yield from rows(table)[0]
    yield from Quantity.__annotations__
    yield "file"


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
            "mechanism": {"phases": 1},
            "run": {"horizon_hours": 10},
        }
    )
    result, loads = wearsim.simulate(case), loads_json(tooth_loads(case))
    yield from (*result.history, *result.flank, *result.summary(), *loads, *loads["teeth"][0])
    yield from result.summary()["limits"][0]


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Every column and key that goes out."""
    case = load_case(CASE)
    result = wearsim.simulate(case)
    schema = json.loads(files("wearsim").joinpath("result.schema.json").read_text("utf-8"))
    return {
        *result.history,
        *result.flank,
        *result.summary(),
        *schema["$defs"]["life"]["properties"],
        *profile_table(case),
        *comparison_table([result]),
        *wrapped(),
        *("time_s", "turned", "chains_per_sprocket", "last_chain_used", "stops"),
        *("cost_per_1000_h", "classes", "same_link_kind"),
        *HERTZ_CHECK_FEM,
        *catalogue_columns(),
        *prescribed_columns(tmp_path_factory.mktemp("tables")),
    }


def test_every_input_key_is_listed():
    assert set(input_keys(CaseTables)) - set(quantities()) == set()


def test_every_column_is_listed(written):
    assert written - set(quantities()) == set()


def test_no_row_is_unused(written):
    assert set(quantities()) - written - set(input_keys(CaseTables)) == set()


def test_every_quantity_has_a_meaning():
    assert all(quantity.meaning for quantity in quantities().values())


def test_name_carries_the_unit():
    for name, quantity in quantities().items():
        endings = [ending for ending in UNITS if f"_{name}".endswith(f"_{ending}")]
        expected = UNITS[max(endings, key=len)] if endings else ""
        assert quantity.unit == expected, name
