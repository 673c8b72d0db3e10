"""A lubricant that a program adds: a case names it as one of the catalogue."""

import pytest

import wearsim
from wearsim.catalogue.catalogues import lubricants

NUMBERS = {"lasts_sliding_m": 500.0, "fades_over_sliding_m": 100.0, "dry_factor": 20.0}


pytestmark = pytest.mark.usefixtures("catalogue_as_before")


def case(lubrication):
    """A tooth on a strand."""
    return wearsim.load_case(
        {
            "format_version": 1,
            "chain": {"designation": "16B-1"},
            "sprocket": {"teeth": 20, "profile": "evolute", "nodes": 51},
            "load": {"power_kW": 3, "speed_rpm": 100},
            "lubrication": lubrication,
        }
    )


def test_it_wears_as_its_numbers_given_as_keys():
    name = wearsim.lubricant("mine", wear_condition="hardened, oiled", source="own rig", **NUMBERS)
    own = case({"lubricant": name, "interval_hours": 100})
    keys = case({"lubricant": "manual", "interval_hours": 100, **NUMBERS})
    by_keys = keys.with_({"wear.condition": "hardened, oiled"})
    assert own.wear == by_keys.wear
    assert wearsim.simulate(own).life == wearsim.simulate(by_keys).life
    assert "lubricant 'mine' is user-defined: own rig" in own.assumptions


def test_more_of_it_lasts_longer():
    for lasts in (200.0, 400.0):
        numbers = {**NUMBERS, "lasts_sliding_m": lasts}
        wearsim.lubricant(f"{lasts:g} m", wear_condition="hardened, oiled", source="own rig", **numbers)
    short, long = (wearsim.simulate(case({"lubricant": f"{lasts} m"})).life.hours for lasts in (200, 400))
    assert short < long


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"name": "drip"}, "name: must not be a name of the catalogue (got 'drip')"),
        ({"wear_condition": "oiled"}, "wear_condition: no such wear condition"),
        ({"supply": "spray"}, "supply: must be 'applied', 'continuous', 'none' (got 'spray')"),
        ({"source": " "}, "source: must say where the numbers come from"),
        ({"dry_factor": 0.5}, "dry_factor: must be greater than or equal to 1 (got 0.5)"),
        ({"contamination_removed": 2.0}, "contamination_removed: must be less than or equal to 1"),
        ({"lasts_sliding_m": -1.0}, "lasts_sliding_m: must be"),
        (
            {"lasts_sliding_m": 1.0, "dry_factor": None},
            "dry_factor: must be given for a lubricant with a limited life",
        ),
    ],
)
def test_a_wrong_row_is_refused(values, words):
    row = {"name": "new", "wear_condition": "hardened, oiled", "source": "own rig", **NUMBERS, **values}
    with pytest.raises(wearsim.CaseError) as caught:
        wearsim.lubricant(**row)
    assert words in str(caught.value)
    assert "new" not in lubricants()
