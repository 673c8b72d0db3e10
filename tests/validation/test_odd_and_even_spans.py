"""V3: which pitches grow

Two chains, new and worn, between the rollers over 11 and over 10 pitches
([odd_and_even_spans.csv](../tests/validation/data/odd_and_even_spans.csv)). Joint wear lengthens only the outer links: the rollers sit
on bushes that the inner links hold. The engine gives the pitches of both links at an elongation.

Calibrated on the growth over 10 pitches, predicts by how much 11 pitches grow more: nothing where the span begins and ends in an
inner link, two joints' wear where in outer ones. Where it began is not stated. `joint.pitch = "uniform"` is the rival, and the play of
rollers falls out of the difference.

What fails: both rivals. That supports the pattern that the engine has by default, weakly: the caliper reads 0.05 mm.

It cannot show: how fast a chain grows, nor by how much a sprocket is worn faster by unequal pitches.
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


@pytest.mark.parametrize(("chain", "first", "verdict"), SPANS)
def test_alternating_pitches(data, span, measured, chain, first, verdict):
    over_11, over_10 = growths(data, chain)
    elongation = over_10 / span(10, 0.0)
    more = [span(pitches, elongation, first) - span(pitches, 0.0) for pitches in (11, 10)]
    measured(
        f"{chain}: growth over 11 less over 10 pitches, {first} links at both ends",
        more[0] - more[1],
        float(over_11 - over_10),
        ("within", 0.1),
        verdict,
        unit="mm",
        scatter="steps of 0.05 mm, two of them",
    )


@pytest.mark.parametrize(
    ("chain", "verdict"), [("Shimano XT HG94", "failed"), ("Campagnolo Veloce", "failed")]
)
def test_uniform_pitches(data, measured, chain, verdict):
    over_11, over_10 = growths(data, chain)
    measured(
        f"{chain}: the same if all pitches grew alike",
        over_10 / 10.0,
        float(over_11 - over_10),
        ("within", 0.1),
        verdict,
        unit="mm",
        scatter="steps of 0.05 mm, two of them",
    )
