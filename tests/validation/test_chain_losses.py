"""V11: efficiency of bicycle chains

Three cogs at four powers
([chain_efficiency.csv](../tests/validation/data/chain_efficiency.csv)), second hand, without
chainring, cadence and lubricant. The engine knows one loss, the friction of pin in bush where the
chain meets and leaves a sprocket; its drive has a ring of 44 teeth at 75 rpm, 112 links, 10 N in the
slack span (all assumed) and 0.11, its default for a joint.

Predicts the order: more is lost with fewer teeth and, in parts, with less power. Losses within a
factor of 2 were allowed; this factor was set when figures of other drives were known, not before.

What fails: the size. The friction of joints is a quarter to a third of the loss at 200 W, and less
of it at lower power, where most of the loss does not grow with the pull: derailleur, side plates
and drag of the oil are not in the engine. The table does not put 24 teeth above 19 either. Dry
joints are predicted with 0.42, a handbook's value for dry steel that slides (handbooks range from
0.1 to 0.62): they lose half of what is said. They would need 0.7 to 0.8, beyond that range, so
something besides the joints rubs.

It cannot show: which friction a joint has. As no source measures that of chains by lubricant,
[lubrication] sets wear and not friction; `drive.joint_friction` is yours to give.
"""

import functools
from itertools import pairwise

import numpy as np
import pytest

import wearsim

LOADS = (50, 100, 200, 400)


@functools.cache
def efficiency(cog, watts, friction=0.11):
    """Efficiency of a whole drive [%]."""
    sprocket = {"profile": "ansi_b29", "face_width_mm": 1.6}
    drive = {
        "format_version": 1,
        "chain": {
            "pitch_mm": 12.7,
            "roller_diameter_mm": 7.75,
            "inner_width_mm": 2.18,
            "pin_diameter_mm": 3.6,
            "bearing_area_mm2": 13.7,
            "mass_kg_per_m": 0.17,
        },
        "sprocket": [{"teeth": 44, **sprocket}, {"teeth": cog, **sprocket}],
        "drive": {"links": 112, "slack_tension_N": 10, "joint_friction": friction},
        "load": {"power_kW": 1e-3 * watts, "speed_rpm": 75},
        "joint": {"specific_wear_rate_mm2_per_N": 1e-9},
        "wear": {"specific_wear_rate_mm2_per_N": 1e-9},
    }
    return 100.0 * wearsim.check(drive).summary()["layout"]["efficiency"]


@pytest.fixture
def read(data):
    """Efficiencies as they were measured, by cog and load."""
    return data("chain_efficiency").set_index(["teeth", "power_W"]).efficiency_percent


@pytest.mark.wide
def test_order_of_loads(read, measured):
    """From load to load on each of three cogs."""
    rises = [
        sum(table(cog, more) > table(cog, less) for cog in (24, 19, 13) for less, more in pairwise(LOADS))
        for table in (efficiency, lambda cog, load: read[cog, load])
    ]
    measured("steps to the next power at which the efficiency rises, of 9", *rises, ("within", 0), "passed")


def test_order_of_teeth(read, measured):
    lower = [
        sum(table(13, load) < table(cog, load) for cog in (24, 19) for load in LOADS)
        for table in (efficiency, lambda cog, load: read[cog, load])
    ]
    measured("times that 13 teeth lose more than 19 or 24, of 8", *lower, ("within", 0), "passed")


def test_24_teeth_over_19(read, measured):
    lower = [
        sum(table(19, load) < table(24, load) for load in LOADS)
        for table in (efficiency, lambda cog, load: read[cog, load])
    ]
    measured("times that 19 teeth lose more than 24, of 4", *lower, ("within", 0), "failed")


@pytest.mark.parametrize("cog", [24, 19, 13])
def test_losses_at_200_w(read, measured, cog):
    measured(
        f"loss at 200 W, cog of {cog} teeth",
        100.0 - efficiency(cog, 200),
        float(100.0 - read[cog, 200]),
        ("factor", 2),
        "failed",
        unit="%",
    )


@pytest.mark.parametrize("cog", [24, 19, 13])
def test_losses_fall_with_power(read, measured, cog):
    measured(
        f"loss at 50 W over that at 400 W, cog of {cog} teeth",
        (100.0 - efficiency(cog, 50)) / (100.0 - efficiency(cog, 400)),
        float((100.0 - read[cog, 50]) / (100.0 - read[cog, 400])),
        ("factor", 2),
        "failed",
    )


def test_a_dry_chain_loses_more(measured):
    measured(
        "more lost by a dry chain at 200 W, 19 teeth, joints of 0.42",
        efficiency(19, 200) - efficiency(19, 200, 0.42),
        "4 to 5 %",
        ("range", (4, 5)),
        "failed",
        unit="%",
        scatter="one sentence",
    )


@pytest.mark.wide
def test_friction_of_a_dry_chain():
    """What the text says: 4 to 5 points more need joints of 0.7 to 0.8."""
    frictions = np.linspace(0.11, 1.0, 10)
    more = [efficiency(19, 200) - efficiency(19, 200, float(one)) for one in frictions]
    assert np.interp([4.0, 5.0], more, frictions).round(1).tolist() == [0.7, 0.8]
