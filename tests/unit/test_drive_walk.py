"""Changing any key of a whole drive changes what runs, or raises an error that names it.

What runs is the complete case of every sprocket without the echo of its input; that each number of a case
moves its life is walked through in test_case_schema_walk.py, whose bases become drives here.
"""

import dataclasses
import runpy
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

from wearsim.case.keys import CaseTablesOrDrive
from wearsim.drive.load_case import load_case, load_drive
from wearsim.errors import CaseError
from wearsim.input.keys import schema_fields
from wearsim.report.drive.layout import layout_json

pytestmark = pytest.mark.wide

OF_ONE = runpy.run_path(str(Path(__file__).with_name("test_case_schema_walk.py")))
BASES, CHANGES, OWN_CHAIN, WRAP, draw, edited = (
    OF_ONE[name] for name in ("BASES", "CHANGES", "OWN_CHAIN", "WRAP", "draw", "edited")
)

WITHOUT_EFFECT = {
    **{key: why for key, why in OF_ONE["WITHOUT_EFFECT"].items() if key.startswith("lubrication.")},
    "title": "only shown above the answer",
    "maintenance.currency": "only the plan (tests/verification/test_year_plan.py)",
    "maintenance.downtime_hours": "only the plan (tests/cli/test_drive_plan.py)",
    "maintenance.downtime_cost_per_hour": "only the plan (tests/cli/test_drive_plan.py)",
    "service.km_per_hour": "only how hours are shown (tests/cli/test_drive_report.py)",
    "service.tonnes_per_hour": "only how hours are shown",
    "service.start_date": "only how hours are shown (tests/cli/test_drive_plan.py)",
    "sprocket.back_flank": "belongs to profiles that no chain wraps",
}


def as_drive(base):
    """The drive of two sprockets of which a case of one is the first."""
    mate = {"teeth": base["drive"]["mate_teeth"], "profile": "iso606", "nodes": 31}
    drive = {key: value for key, value in base["drive"].items() if key != "mate_teeth"}
    return {**base, "sprocket": [{**base["sprocket"], "name": "own"}, mate], "drive": drive}


WRAPS = {name: as_drive(base) for name, base in BASES.items() if "drive" in base and "fatigue" not in base}
TWO = as_drive(WRAP)
LOOP = {
    **edited(WRAP, drive={"links": 92}, load={"power_kW": 1.3, "speed_rpm": 300}),
    "sprocket": [
        {"name": "motor", "teeth": 17, "profile": "iso606", "nodes": 31, "position_mm": [0, 0]},
        {
            "name": "tensioner",
            "role": "idler",
            "teeth": 13,
            "profile": "iso606",
            "nodes": 31,
            "position_mm": [62, 155],
            "outside": True,
            "take_up": {"tensioner_force_N": 80, "guide_deg": -37.5, "travel_mm": [-25, 30]},
        },
        {
            "name": "pump",
            "teeth": 20,
            "profile": "iso606",
            "nodes": 31,
            "position_mm": [200, 250],
            "power_share": 0.7,
        },
        {
            "name": "fan",
            "teeth": 25,
            "profile": "iso606",
            "nodes": 31,
            "position_mm": [306, 0],
            "power_share": 0.3,
        },
    ],
}
BY_HAND = {**LOOP, "sprocket": [*LOOP["sprocket"]], "drive": {"links": 92, "sag_percent": 0.5}}
BY_HAND["sprocket"][1] = {**BY_HAND["sprocket"][1], "take_up": {"travel_mm": [-25, 30]}}
TORQUES = {**LOOP, "sprocket": [*LOOP["sprocket"]]}
for at, torque in ((2, 34.0776), (3, 18.2558)):
    own = {key: value for key, value in LOOP["sprocket"][at].items() if key != "power_share"}
    TORQUES["sprocket"][at] = {**own, "torque_N_m": torque}
CASSETTE = {**TWO, "sprocket": [TWO["sprocket"][0], {"name": "set", "profile": "iso606", "nodes": 31}]}
CASSETTE["sprocket"][1]["cog"] = [{"teeth": 13, "share_of_time": 0.25}, {"teeth": 17, "share_of_time": 0.75}]
DUTY = edited(
    LOOP,
    load=None,
    duty=[
        {"share_of_time": 0.5, "power_kW": 1.3, "speed_rpm": 300, "power_share": {"pump": 0.1, "fan": 0.9}},
        {"share_of_time": 0.5, "power_kW": 0.9, "speed_rpm": 200},
    ],
)


def second(**keys):
    """The drive of two with more keys of its second sprocket."""
    return {**TWO, "sprocket": [TWO["sprocket"][0], {**TWO["sprocket"][1], **keys}]}


OILED = {"condition": "hardened, oiled"}
_PLACE = ("name", "role", "position_mm", "outside", "take_up")
SMOOTH = {
    **LOOP,
    "sprocket": [
        {**{key: one[key] for key in _PLACE if key in one}, "smooth_diameter_mm": 45.0}
        if number == 1
        else one
        for number, one in enumerate(LOOP["sprocket"])
    ],
}

MORE = {
    "two": TWO,
    "loop": LOOP,
    "smooth": SMOOTH,
    "by hand": BY_HAND,
    "torques": TORQUES,
    "cassette": CASSETTE,
    "loop duty": DUTY,
    "materials": {**TWO, "material": {"sprocket": {"name": "bronze"}}},
    "own wear": {
        **TWO,
        "sprocket": [{**TWO["sprocket"][0], "wear": {"condition": "hardened, oiled"}}, TWO["sprocket"][1]],
    },
    "no rate": edited(TWO, joint={"law": "constant"}),
    "priced": {**TWO, "maintenance": {"chain_price": 40.0, "sprocket_price": 100.0}},
    "regime": {**TWO, "load": {**WRAP["load"], "regime": "II"}},
    "daily": {**edited(TWO, run={"life_tolerance": 0.1}), "service": {"hours_per_day": 8}},
    "distance": WRAPS["distance"],
    "own chain": edited(TWO, chain=OWN_CHAIN),
    "double": edited(
        TWO,
        chain={**OWN_CHAIN, "pitch_mm": 25.4},
        sprocket=[TWO["sprocket"][0], {**TWO["sprocket"][1], "teeth": 40, "engaged_every": 2}],
    ),
    "pulled": {**BY_HAND, "drive": {"links": 92, "slack_tension_N": 40.0}},
    "drozdov": edited(TWO, wear=BASES["drozdov"]["wear"]),
    "points": {
        **TWO,
        "sprocket": [
            {
                "teeth": 13,
                "profile": "points",
                "points_file": "gap.csv",
                "points_noise_mm": 1e-4,
                "nodes": 31,
            },
            TWO["sprocket"][1],
        ],
    },
    "hub": second(bore_mm=20, keyway_width_mm=6, keyway_depth_mm=2.8, hub_diameter_mm=40, hub_length_mm=20),
    "duty": edited(
        TWO,
        load=None,
        duty=[
            {"share_of_time": 0.5, "tension_N": 800, "speed_rpm": 200},
            {"share_of_time": 0.5, "torque_N_m": 10, "speed_rpm": 200},
        ],
    ),
    "cycles": edited(
        TWO,
        load=None,
        duty=[
            {"share_of_cycles": 0.5, "tension_N": 800, "speed_rpm": 200},
            {"share_of_cycles": 0.5, "tension_N": 400, "speed_rpm": 200},
        ],
    ),
    "log": edited(TWO, load={"duty_file": "duty.csv"}),
    "power law": edited(TWO, wear={"law": "power", "coefficient": 1e-14, "pressure_exponent": 2.0}),
}
# Key with the number of its sprocket: (base, another value) for a change, (base, value, fault's key) for an
# error.
OWN_CHANGES = {
    "format_version": [("two", 2, "format_version")],
    "sprocket.2.name": [("two", "roll"), ("two", "own", "sprocket.2.name")],
    "sprocket.2.role": [("two", "driver", "sprocket.2.role")],
    "sprocket.2.position_mm": [
        ("loop", [63, 155]),
        ("two", [300, 0], "sprocket.1.position_mm"),
        ("loop", [20, 155], "sprocket.2"),
    ],
    "sprocket.2.outside": [("loop", False, "sprocket.2"), ("two", True, "sprocket.2.outside")],
    "sprocket.3.power_share": [("loop", 0.6, "sprocket.4.power_share")],
    "sprocket.3.torque_N_m": [
        ("torques", 34.2),
        ("torques", 50.0, "sprocket.4.torque_N_m"),
        ("loop", 30.0, "sprocket.3.torque_N_m"),
    ],
    "sprocket.2.take_up.guide_deg": [("loop", -45.0), ("by hand", -38.5)],
    "sprocket.2.take_up.travel_mm": [("loop", [-24, 30]), ("loop", [0, 0.1], "sprocket.2")],
    "sprocket.2.take_up.tensioner_force_N": [("loop", 90)],
    "sprocket.2.smooth_diameter_mm": [("smooth", 45.5), ("loop", 45.0, "sprocket.2.teeth")],
    "sprocket.2.cog.1.teeth": [("cassette", 14), ("cassette", 17, "sprocket.2.cog")],
    "sprocket.2.cog.1.share_of_time": [("cassette", 0.3, "sprocket.2.cog")],
    "sprocket.2.price": [("priced", 50.0), ("two", 50.0, "sprocket.2.price")],
    "sprocket.2.wear.condition": [("two", "hardened, dry")],
    "sprocket.2.wear.specific_wear_rate_mm2_per_N": [("two", 2e-9)],
    "sprocket.1.wear.specific_wear_rate_mm2_per_N": [("own wear", 2e-9)],
    "sprocket.2.material.name": [("two", "bronze")],
    "sprocket.2.material.youngs_modulus_MPa": [("two", 1e5)],
    "sprocket.2.material.poissons_ratio": [("two", 0.25)],
    "sprocket.1.profile": [("two", "ansi_b29", "sprocket.1.profile")],
    "sprocket.2.teeth": [("two", 21), ("two", 3, "sprocket.2.teeth"), ("cassette", 17, "sprocket.2.teeth")],
    "sprocket.2.bore_mm": [("two", 20.0), ("two", 73.0, "sprocket.2.bore_mm")],
    "sprocket.2.engaged_every": [("double", 1), ("own chain", 3, "sprocket.2.engaged_every")],
    "drive.mate_teeth": [("two", 20, "drive.mate_teeth")],
    "drive.links": [("loop", 120, "sprocket.2")],
    "joint.source": [("no rate", "a rig", "joint.source")],
    "drive.centre_distance_mm": [("loop", 300, "drive.centre_distance_mm")],
    "drive.slack_tension_N": [("pulled", 50.0), ("loop", 80.0, "drive.slack_tension_N")],
    "drive.sag_percent": [("by hand", 0.4), ("loop", 3.0, "drive.sag_percent")],
    "drive.inclination_deg": [("distance", 10.0, "drive.inclination_deg")],
    "drive.joint_friction": [("two", 0.2), ("loop", 0.2)],
    "drive.service_factor": [("two", 1.4), ("loop", 1.4)],
    "drive.joint_application_factor": [("two", 1.4), ("loop", 1.4)],
    "mechanism.kind": [("two", "strand", "mechanism.kind")],
    "mechanism.table_file": [("two", "loads.csv", "mechanism.table_file")],
    "load.power_kW": [("loop", 1.4)],
    "load.torque_N_m": [("two", 10.0, "load.torque_N_m")],
    "load.tension_N": [("loop", 900.0, "load.power_kW")],
    "load.regime": [("regime", "III")],
    "load.duty_file": [("log", "other_duty.csv"), ("two", "duty.csv", "load.tension_N")],
    "load.duty_bins": [("log", [1, 1]), ("two", [4, 4], "load.duty_bins")],
    "load.duty_speed_ratio": [("log", 0.5), ("two", 0.5, "load.duty_speed_ratio")],
    "duty.1.power_share": [("loop duty", {"pump": 0.2, "fan": 0.8})],
    "duty.1.power_share.pump": [("loop duty", 0.2, "duty.1.power_share")],
    "duty.1.power_share.gear": [("loop duty", 0.2, "duty.1.power_share.gear")],
    "duty.2.power_kW": [("loop duty", 1.0)],
    "maintenance.chain_price": [("priced", 50.0)],
    "maintenance.sprocket_price": [("priced", 50.0)],
    "maintenance.turn_sprocket": [("priced", True, "maintenance.turn_sprocket")],
    "maintenance.replace_at_percent": [("priced", [2], "maintenance.replace_at_percent")],
    "service.hours_per_day": [("daily", 16)],
    "optimise.objectives": [("two", ["life_hours"], "optimise.parameters")],
    "fatigue.load_factor": [("two", 1.1, "fatigue")],
    "wear.condition": [("no rate", "hardened, dry")],
    "wear.tooth_hardness": [("two", "hardened", "wear.tooth_hardness")],
    "sprocket.2.wear.tooth_hardness": [("two", "hardened", "sprocket.2.wear.tooth_hardness")],
    "wear.constants": [("two", {"k": 1.0}, "wear.constants")],
    "wear.law": [("two", "power", "wear.specific_wear_rate_mm2_per_N")],
    "wear.coefficient": [("power law", 2e-14)],
    "wear.pressure_exponent": [("power law", 2.01)],
    "wear.band_factor": [("two", 2.5)],
    "chain.pitch_mm": [("own chain", 12.8)],
    "material.sprocket.name": [("materials", "grey cast iron")],
    "stop.elongation_percent": [("two", 2.0), ("loop", 2.0)],
    "stop.critical_depth_mm": [("two", 0.06)],
    "run.horizon_hours": [("two", 90)],
    "run.cycles_per_update": [("two", 2, "run.cycles_per_update")],
    "chain.designation": [("two", "06B-1"), ("own chain", "08B-1", "chain.pitch_mm")],
    "chain.inner_width_mm": [("own chain", 7.0)],
    "chain.roller_diameter_mm": [("own chain", 8.4)],
    "duty.1.share_of_time": [("duty", 0.5000005), ("cycles", 0.5, "duty.1.share_of_cycles")],
    "duty.1.share_of_cycles": [("cycles", 0.5000005), ("duty", 0.5, "duty.1.share_of_cycles")],
    "duty.1.tension_N": [("duty", 801)],
    "duty.1.speed_rpm": [("duty", 201)],
    "duty.1.wear_factor": [("duty", 2)],
    "duty.2.torque_N_m": [("duty", 11)],
    "load.speed_rpm": [("two", 210), ("loop", 310)],
    "material.roller.name": [("two", "bronze")],
    "material.roller.youngs_modulus_MPa": [("two", 1e5)],
    "material.roller.poissons_ratio": [("two", 0.25)],
    "material.sprocket.youngs_modulus_MPa": [("two", 1e5)],
    "material.sprocket.poissons_ratio": [("two", 0.25)],
    **{
        f"sprocket.2.{key}": [("two", 4.1, f"sprocket.2.{key}")]
        for key in ("contact_start_mm", "contact_end_mm", "evolute_offset_mm")
    },
    "sprocket.2.face_width_mm": [("two", 6.0)],
    "sprocket.1.points_file": [("points", "other_gap.csv"), ("two", "gap.csv", "sprocket.1.points_file")],
    "sprocket.1.points_noise_mm": [("points", 3e-3)],
    "sprocket.2.keyway_width_mm": [("hub", 7.0)],
    "sprocket.2.keyway_depth_mm": [("hub", 3.0)],
    "sprocket.2.hub_diameter_mm": [("hub", 45.0)],
    "sprocket.2.hub_length_mm": [("hub", 25.0)],
    "stop.min_tip_land_mm": [("two", 0.5)],
    "wear.hardness_MPa": [("drozdov", 4100)],
    "wear.reference_speed_mm_per_s": [("drozdov", 310)],
    "wear.speed_exponent": [("drozdov", -0.2)],
    "wear.specific_wear_rate_mm2_per_N": [("two", 2e-9)],
    "wear.pv_limit_MPa_mm_per_s": [("two", 1e5, "wear.severe_factor")],
    "wear.severe_factor": [("two", 5.0, "wear.pv_limit_MPa_mm_per_s")],
    "wear.friction_coefficient": [("two", 0.1, "wear.friction_coefficient")],
    "film": [
        ("two", {"viscosity_mPa_s": 80.0, "pressure_viscosity_per_GPa": 20.0, "roughness_um": 0.5}, "film")
    ],
    "run.life_tolerance": [("two", 0.05)],
    "run.method": [("two", "per_cycle")],
}


def number_one(key):
    """A key of the case of one sprocket as that of the first one of a drive."""
    return key.replace("sprocket.", "sprocket.1.", 1) if key.startswith("sprocket.") else key


NOT_OF_A_DRIVE = {"sprocket.role", "drive.mate_teeth", "mechanism.kind"}
WALK = [
    (number_one(key), WRAPS[base], value, *map(number_one, named))
    for key, changes in CHANGES.items()
    for base, value, *named in changes
    if base in WRAPS and key not in NOT_OF_A_DRIVE
] + [
    (key, MORE[base], value, *named)
    for key, changes in OWN_CHANGES.items()
    for base, value, *named in changes
]

WALK += [
    (
        key,
        edited(TWO, wear=None, **{name: BASES[base].get(name) for name in ("lubrication", "service")}),
        value,
    )
    for key, changes in CHANGES.items()
    for base, value, *named in changes
    if key.startswith("lubrication.") and not named
]


def with_numbered(base, key, value):
    """The tables with one value set, that of a list by its number."""
    head, *rest = key.split(".")
    if not rest:
        return {**base, head: value}
    below = base.get(head, {}) if isinstance(base, dict) else base
    if isinstance(below, list):
        number, *rest = rest if rest[0].isdecimal() else ["1", *rest]
        entry = with_numbered(below[int(number) - 1], ".".join(rest), value)
        return {**base, head: [*below[: int(number) - 1], entry, *below[int(number) :]]}
    return {**base, head: with_numbered(below, ".".join(rest), value)}


def test_every_key_takes_part():
    keys = {key.replace("[]", "") for key, _ in schema_fields(CaseTablesOrDrive)}
    walked = {".".join(part for part in key.split(".") if not part.isdecimal()) for key, *_ in WALK}
    refused = ("fatigue.", "film.", "optimise.")
    missing = {
        key for key in keys - walked - set(WITHOUT_EFFECT) if not key.startswith((*refused, "sprocket.wear."))
    }
    assert missing == set()


ECHO = {"inputs", "files", "input_files", "assumptions", "warnings", "title"}


def flat(value):
    """Every number and word of a value, but for the echo of its input."""
    if dataclasses.is_dataclass(value):
        fields = [field.name for field in dataclasses.fields(value) if field.name not in ECHO]
        return tuple((name, flat(getattr(value, name))) for name in fields)
    if isinstance(value, np.ndarray):
        return value.tobytes()
    if isinstance(value, Mapping):
        return tuple((key, flat(entry)) for key, entry in value.items())
    if isinstance(value, tuple | list):
        return tuple(map(flat, value))
    assert value is None or isinstance(value, str | int | float | bool | np.generic), type(value)
    return value


RAN = {}


def runs(tables):
    """All that runs of a drive, its prices, and where the chain lies; of each drive once."""
    if (name := repr(tables)) not in RAN:
        RAN[name] = run(tables)
    return RAN[name]


def run(tables):
    drive = load_drive(tables)
    prices = [one.case.inputs.get("maintenance") for one in drive.sprockets]
    days = drive.driver.case.inputs.get("service")
    return flat((drive.sprockets, repr(layout_json(drive)), repr(prices), repr(days)))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("walk")
    draw(folder / "gap.dxf", {"first": 0.0, "second": 0.01})
    draw(folder / "other.dxf", {"first": 0.02})
    outline = load_case({**WRAP, "sprocket": {"teeth": 13, "profile": "iso606"}}).drive.outline
    for name, depth in (("gap", 0.0), ("other_gap", 0.01)):
        moved = outline.recede(depth)
        rows = "".join(f"{x:.12g},{y:.12g}\n" for x, y in zip(moved.x, moved.y, strict=True))
        (folder / f"{name}.csv").write_text("x_mm,y_mm\n" + rows)
    for name, pull in (("duty", 400), ("other_duty", 410)):
        rows = "".join(f"{i},{pull + 5 * i},{60 + i}\n" for i in range(20))
        (folder / f"{name}.csv").write_text("time_s,tension_N,speed_rpm\n" + rows)
    return folder


@pytest.mark.parametrize(("key", "base", "value", "named"), [(*one[:3], one[3:]) for one in WALK])
def test_key_changes_what_runs_or_is_named(folder, monkeypatch, key, base, value, named):
    monkeypatch.chdir(folder)
    changed = with_numbered(base, key, value)
    if not named:
        assert runs(base) != runs(changed)
        return
    with pytest.raises(CaseError) as caught:
        load_drive(changed)
    assert named[0] in [fault.key for fault in caught.value.faults], str(caught.value)
