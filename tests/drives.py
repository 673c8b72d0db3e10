"""Small drives that tests of several folders share: ``from tests.drives import GEARS, changed``."""

import copy
from functools import partial
from typing import Any

from wearsim.contact.stop_limits import LIMITS, StopLimit, stop_limit

Tables = dict[str, Any]

STRAND: Tables = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "nodes": 51},
    "load": {"power_kW": 3, "speed_rpm": 100},
    "wear": {"condition": "hardened, oiled"},
}
"""A sprocket under a straight strand."""

LIGHT_WRAP: Tables = {
    "format_version": 1,
    "chain": {"designation": "08B-1"},
    "sprocket": {"teeth": 13, "profile": "iso606", "nodes": 61},
    "drive": {"mate_teeth": 20, "links": 60, "slack_tension_N": 30},
    "mechanism": {"phases": 2},
    "load": {"tension_N": 800, "speed_rpm": 200},
}
"""A chain around few teeth."""

FAST_WRAP: Tables = {
    "format_version": 1,
    "chain": {"designation": "ANSI 40"},
    "sprocket": {"teeth": 19, "profile": "ansi_b29", "nodes": 51},
    "drive": {"mate_teeth": 57, "links": 120},
    "mechanism": {"kind": "wrap", "phases": 2},
    "joint": {"specific_wear_rate_mm2_per_N": 1.5e-8},
    "load": {"power_kW": 4.6, "speed_rpm": 1000},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-9},
}
"""A chain around 19 teeth at 1000 rpm that wears teeth and joints."""

ROAD_BICYCLE: Tables = {
    "format_version": 1,
    "chain": {
        "pitch_mm": 12.7,
        "roller_diameter_mm": 7.9,
        "inner_width_mm": 2.38,
        "pin_diameter_mm": 3.6,
        "bearing_area_mm2": 14,
        "mass_kg_per_m": 0.27,
    },
    "sprocket": {"role": "driven", "teeth": 17, "profile": "iso606", "nodes": 51},
    "drive": {"mate_teeth": 50, "links": 110},
    "load": {"power_kW": 0.2, "speed_rpm": 260},
    "wear": {"condition": "bicycle, wet drip"},
    "service": {"km_per_hour": 28},
}
"""50 to 17 teeth at 200 W and 28 km/h."""

GEARS: Tables = {
    "format_version": 1,
    "gear": {"pinion_teeth": 19, "wheel_teeth": 61, "module_mm": 3, "face_width_mm": 30, "nodes": 61},
    "load": {"torque_N_m": 100, "speed_rpm": 1450},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-11},
    "stop": {"critical_depth_mm": 0.02},
}
"""An involute pair."""


def changed(drive: Tables, values: dict[str, Any]) -> Tables:
    """A copy of a drive with other values of keys such as ``load.speed_rpm``, or with more of them."""
    copied = copy.deepcopy(drive)
    for key, value in values.items():
        *names, last = key.split(".")
        table = copied
        for name in names:
            table = table.setdefault(name, {})
        table[last] = value
    return copied


def depth_limit(depth: float) -> StopLimit:
    """The limit of the source, physics.md (12): the deepest point comes to a depth."""
    return stop_limit("critical_depth_mm", depth, partial(LIMITS["critical_depth_mm"].worn, None))
