"""V3: which pitches grow

Two chains, new and worn, measured between the rollers over 11 and over 10 pitches
([odd_and_even_spans.csv](../tests/validation/data/odd_and_even_spans.csv)). Joint wear lengthens
only the outer links: the rollers turn on bushes, which are fixed in the inner links. The engine gives
the pitches of both links at a given elongation.

Calibrated on the growth over 10 pitches, it predicts how much more 11 pitches grow: nothing if the
span begins and ends with an inner link, the wear of two joints if with outer links. The source does
not state which. The alternative is `joint.pitch = "uniform"`. The clearance of the rollers cancels
in the difference. More than 0.1 mm is not allowed.

Failures: a span that begins with an outer link, on both chains, and the alternative on one. If the
spans began with inner links, this supports the default pattern of the engine, though weakly: the
resolution of the caliper is 0.05 mm.

Not shown: how fast a chain grows, or how much faster a sprocket wears because of unequal
pitches.
"""

import pytest

SPANS = [
    ("Shimano XT HG94", "inner", "passed"),
    ("Shimano XT HG94", "outer", "failed"),
    ("Campagnolo Veloce", "inner", "passed"),
    ("Campagnolo Veloce", "outer", "failed"),
]


def growths(data, chain):
    row = data("odd_and_even_spans").set_index("chain").loc[chain]
    return row.worn_11_mm - row.new_11_mm, row.worn_10_mm - row.new_10_mm


def excess(span, over_10, *pattern):
    """By how much 11 pitches grow more than 10, by the engine's pitches."""
    elongation = over_10 / span(10, 0.0)
    over_11 = span(11, elongation, *pattern) - span(11, 0.0)
    return over_11 - (span(10, elongation, *pattern) - span(10, 0.0))


@pytest.mark.parametrize(("chain", "first", "verdict"), SPANS)
def test_alternating_pitches(data, span, measured, chain, first, verdict):
    over_11, over_10 = growths(data, chain)
    measured(
        f"{chain}: growth over 11 pitches less that over 10, {first} links at both ends",
        excess(span, over_10, first, "alternating"),
        float(over_11 - over_10),
        ("below", 0.1),
        verdict,
        unit="mm",
        scatter="steps of 0.05 mm, two of them",
    )


@pytest.mark.parametrize(
    ("chain", "verdict"), [("Shimano XT HG94", "passed"), ("Campagnolo Veloce", "failed")]
)
def test_uniform_pitches(data, span, measured, chain, verdict):
    over_11, over_10 = growths(data, chain)
    measured(
        f"{chain}: the same, alternative: all pitches grow equally",
        excess(span, over_10, "inner", "uniform"),
        float(over_11 - over_10),
        ("below", 0.1),
        verdict,
        unit="mm",
        scatter="steps of 0.05 mm, two of them",
    )
