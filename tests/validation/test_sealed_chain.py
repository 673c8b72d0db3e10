"""V5: a sealed chain that keeps its length

A motorcycle in dirt: its sealed chain did not grow in 17 000 km, while front sprockets wore out
([sealed_chain.csv](../tests/validation/data/sealed_chain.csv)). The engine runs the shipped case
`520-15t-wrap` (15/43 teeth, 12 kW at 90 km/h, 1e-6 mm3/(N m) on the teeth: all assumed) with joints
that do not wear.

This tests a sign; nothing is calibrated: no elongation, and yet the teeth reach a limit. An engine
whose teeth wear only because the chain has grown would fail. The distance is given for the
coefficient of the case, with its band, a factor of 3.

Failures: the distance. Teeth with the assumed coefficient last seven times as long as the
sprocket of the source (8000 km "and more"). Some 7e-6 mm3/(N m), near the typical value of
`hardened, dry`, would give it, but so would another power or another limit.

Not shown: a depth, as the source does not state the depth of wear; a coefficient of the teeth;
anything beyond the sign.
"""

import pytest

CASE = "520-15t-wrap"
KM_PER_HOUR = 90.0


@pytest.fixture(scope="module")
def figures(data):
    return data("sealed_chain").set_index("quantity").value


@pytest.fixture(scope="module")
def run(wrap_run):
    return wrap_run(CASE, "joint.specific_wear_rate_mm2_per_N=1e-20")


def test_no_elongation(run, figures, measured):
    measured(
        "elongation when the teeth are worn out",
        round(float(run.history_columns["elongation_percent"].max()), 6),
        float(figures.elongation),
        ("within", figures.reading_error),
        "passed",
        unit="%",
        scatter="ruler 0.1 %",
    )


def test_teeth_reach_a_limit(run, measured):
    assert run.stop == "critical_depth_mm"
    measured(
        "depth at the deepest point of a tooth over its limit",
        run.max_depth / run.stop_value,
        "front sprockets replaced",
        ("range", (0.999, 1.001)),
        "passed",
    )


def test_distance(run, figures, measured):
    measured(
        "distance of a front sprocket",
        KM_PER_HOUR * run.life.hours,
        float(figures.front_sprocket_distance),
        ("factor", 3),
        "failed",
        unit="km",
        scatter="one sprocket",
    )
