"""V7: pins of plastic on a disc at two loads

Dry pins of PPS with PTFE ([pin_on_disc.csv](../tests/validation/data/pin_on_disc.csv)). The engine
runs a uniform contact given by a table (`mechanism.kind = "prescribed"`): a cycle is a metre of
sliding under the load of the pin. The area of the pin is not stated, so only the coefficient divided
by the area is identified.

Calibrated at 59.8 N, the mean of two tests: the late slope, and for the depth also the two
keys of the running-in. It predicts the late slope and the depths at 98.1 N, means of one test (PPS)
and of two tests (30 % PTFE). A factor of 2 is allowed; duplicates differ by as much.

Left out: 15 % PTFE, as there is no second load, and 45 % PTFE, whose depth is below the drift of
the gauge (one test is negative throughout).

Not shown: an absolute coefficient; a redistribution of pressure, since a flat pin stays flat;
anything about steel, oil or a line contact. Only Archard's proportion to load and sliding is
tested, and the slope of 30 % PTFE does not follow it (it falls by 7 % where it should grow by 64
%): it passes only because a factor of 2 is wide.
"""

import numpy as np
import pytest
from scipy.optimize import curve_fit

import wearsim
from wearsim.wear.running_in import NO_RUNNING_IN, RunningIn

LOW, HIGH = 59.841, 98.1
MATERIALS = ["PPS", "PPS_30PTFE"]
SCATTER = "duplicates up to a factor of 2"


@pytest.fixture
def tests_of(data):
    """Means over the tests of a material at a load, by distance."""
    table = data("pin_on_disc")

    def mean(material, load):
        own = table[(table.material == material) & np.isclose(table.load_N, load)]
        return own.groupby("distance_m")[["depth_um", "late_slope_um_per_m"]].mean()

    return mean


@pytest.fixture
def depth_at(even_contact):
    """Depth [um] after distances [m] of a pin under a load, by the engine.

    Running-in is given to the engine by a path: in a metre of the pin's way a point of the table
    slides through one width of contact.
    """

    def run(load, slope_per_load, distances, warp=NO_RUNNING_IN):
        def result(horizon, **keys):
            law = {"law": "archard", "specific_wear_rate_mm2_per_N": 1e-3 * slope_per_load}
            columns = {"load_per_width_N_per_mm": load, "slip_ratio": 1.0}
            return wearsim.simulate(even_contact(columns, law | keys, 10.0, horizon))

        width = 4.0 * load / (np.pi * result(1.0).initial_peak_pressure)
        keys = {"running_in_factor": warp.factor, "running_in_distance_mm": width * warp.cycles}
        history = result(float(max(distances)), **keys).history_columns
        return 1e3 * np.interp(distances, history["cycles"], history["max_depth_mm"])

    return run


@pytest.mark.parametrize("material", MATERIALS)
def test_late_slope(tests_of, depth_at, measured, material):
    low, high = (float(tests_of(material, load).late_slope_um_per_m.iloc[0]) for load in (LOW, HIGH))
    measured(
        f"{material}: late slope at 98.1 N",
        float(depth_at(HIGH, low / LOW, [100.0])[0] / 100.0),
        high,
        ("factor", 2),
        "passed",
        unit="um/m",
        scatter=SCATTER,
    )


def running_in(low):
    """Slope and running-in that fit the depths at the low load."""

    def depth(distance, slope, excess, length):
        warp = RunningIn(1.0 + excess, length)
        return np.array([slope * warp.steady_cycles(float(s)) for s in distance])

    start = (float(low.late_slope_um_per_m.iloc[0]), 3.0, 30.0)
    bounds = ([1e-4, 0.0, 1.0], [1.0, 100.0, 500.0])
    found, _ = curve_fit(depth, low.index.to_numpy(), low.depth_um, p0=start, bounds=bounds)
    slope, excess, length = (float(value) for value in found)
    return slope, RunningIn(1.0 + excess, length)


@pytest.mark.parametrize("material", MATERIALS)
def test_depth_over_distance(tests_of, depth_at, measured, material):
    low, high = tests_of(material, LOW), tests_of(material, HIGH)
    slope, warp = running_in(low)
    found = depth_at(HIGH, slope / LOW, high.index.to_numpy(dtype=float), warp)
    at = int(np.abs(np.log(found / high.depth_um.to_numpy())).argmax())
    measured(
        f"{material}: depth at 98.1 N after {high.index[at]} m, largest deviation of {len(high)}",
        float(found[at]),
        float(high.depth_um.iloc[at]),
        ("factor", 2),
        "passed",
        unit="um",
        scatter=SCATTER,
    )
