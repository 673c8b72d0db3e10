"""V3: which pitches grow

Two chains, new and worn, between the rollers over 11 and over 10 pitches
([odd_and_even_spans.csv](../tests/validation/data/odd_and_even_spans.csv)). Joint wear lengthens
only the outer links: the rollers sit on bushes that the inner links hold. The engine gives the
pitches of both links at an elongation.

Calibrated on the growth over 10 pitches, predicts by how much 11 pitches grow more: nothing where
the span begins and ends in an inner link, two joints' wear where in outer ones. Where it began is
not stated. The rival is `joint.pitch = "uniform"`. What the play of the rollers adds falls out of
the difference. More than 0.1 mm is not allowed.

What fails: a span that begins in an outer link, on both chains, and the rival on one. That supports
the pattern which the engine has by default, if the spans began in inner links; weakly, as the
caliper reads 0.05 mm.

It cannot show: how fast a chain grows, nor by how much a sprocket is worn faster by unequal
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
        f"{chain}: growth over 11 less over 10 pitches, {first} links at both ends",
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
        f"{chain}: the same, rival: all pitches grow alike",
        excess(span, over_10, "inner", "uniform"),
        float(over_11 - over_10),
        ("below", 0.1),
        verdict,
        unit="mm",
        scatter="steps of 0.05 mm, two of them",
    )
