"""V8: plastic with carbon fibres at three loads

Mass loss over 1000 m of sliding, four contents of nanotubes
([carbon_fibre_plastic.csv](../tests/validation/data/carbon_fibre_plastic.csv)). The engine runs a
uniform contact given by a table (`mechanism.kind = "prescribed"`). Area and density are not
stated, so only the coefficient divided by them is identified.

Calibrated at 10 N: the slope from 200 to 1000 m for each content. It predicts the slopes at 20 and 30
N, twice and three times as high. A factor of 2 is allowed, as for the pins.

Failures: one slope of eight, which grew by 23 % where three times was predicted. All four at 20 N
grew by 10 to 38 % instead of doubling: they pass only because the factor is wide.

Not shown: an absolute coefficient, a distribution of pressure, anything about steel or oil; the
readings have no repeats.
"""

import numpy as np
import pytest

import wearsim

CALIBRATED = 10


def slope(table, content, load):
    """Loss in a metre of sliding [g/m], by least squares."""
    own = table[(table.nanotubes_percent == content) & (table.load_N == load)]
    return float(np.polyfit(own.distance_m, own.loss_g, 1)[0])


@pytest.mark.parametrize(
    ("content", "load", "verdict"),
    [
        (0.0, 20, "passed"),
        (0.5, 20, "passed"),
        (1.0, 20, "passed"),
        (1.5, 20, "passed"),
        (0.0, 30, "passed"),
        (0.5, 30, "failed"),
        (1.0, 30, "passed"),
        (1.5, 30, "passed"),
    ],
)
def test_slope(data, even_contact, measured, content, load, verdict):
    table = data("carbon_fibre_plastic")
    law = {"law": "archard", "specific_wear_rate_mm2_per_N": 1e-7}

    def depth(newtons):
        columns = {"load_per_width_N_per_mm": float(newtons), "slip_ratio": 1.0}
        return wearsim.simulate(even_contact(columns, law, 10.0, 1000.0)).max_depth

    measured(
        f"{content} % of nanotubes at {load} N, loss in 1000 m after the first 200",
        1e6 * slope(table, content, CALIBRATED) * depth(load) / depth(CALIBRATED),
        1e6 * slope(table, content, load),
        ("factor", 2),
        verdict,
        unit="mg",
        scatter="no repeats",
    )
