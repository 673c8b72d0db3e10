"""When particles scratch a surface: from a hardness of 1.2 times its own on."""

import pytest

from wearsim.lubrication.dirt import abrasion_share


@pytest.mark.parametrize(
    ("abrasive", "surface", "share"),
    [(840.0, 700.0, 1.0), (839.0, 700.0, 0.0), (1100.0, 250.0, 1.0), (200.0, 250.0, 0.0), (6.0, 5.0, 1.0)],
)
def test_abrasion_begins_at_one_and_a_fifth_of_the_hardness(
    abrasive: float, surface: float, share: float
) -> None:
    assert abrasion_share(abrasive, surface) == share


@pytest.mark.parametrize("pair", [(0.0, 700.0), (800.0, -1.0)])
def test_a_hardness_must_be_above_zero(pair: tuple[float, float]) -> None:
    with pytest.raises(ValueError, match="above 0"):
        abrasion_share(*pair)
