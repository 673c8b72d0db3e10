"""What was read of a chain goes into its case: it is not doubted there, and gives the reading again."""

import pytest

import wearsim
from tests.drives import changed

DRIVE = {
    "format_version": 1,
    "chain": {"designation": "08B-1"},
    "sprocket": [
        {"name": "small", "role": "driver", "teeth": 15, "profile": "iso606", "nodes": 31},
        {"name": "large", "teeth": 38, "profile": "iso606", "nodes": 31},
    ],
    "drive": {"links": 100},
    "mechanism": {"phases": 2},
    "run": {"life_tolerance": 0.1, "horizon_hours": 60_000},
    "load": {"power_kW": 1, "speed_rpm": 300},
    "wear": {"condition": "hardened, oiled"},
}
READ = [{"time_hours": 500, "quantity": "elongation_percent", "value": 1.2, "error": 0.05}]
"""44 times as fast as oiled joints: a rate of dry ones."""


def doubts(case):
    return [text for text in case.warnings if "contradicts" in text or "delete this key" in text]


def test_a_coefficient_that_was_read_is_not_argued_with():
    fitted = wearsim.calibrate(DRIVE, READ).case
    assert doubts(fitted) == []
    rate = fitted.inputs["joint"]["specific_wear_rate_mm2_per_N"]
    # The same rate from nowhere is argued with, and says how it is not.
    (text,) = doubts(wearsim.load_case(changed(DRIVE, {"joint.specific_wear_rate_mm2_per_N": rate})))
    assert "say in joint.source where it was measured" in text


def test_the_coefficient_of_one_reading_is_that_of_calibrate_which_gives_it_again():
    """3 % at 1.2 % after 500 h is a life of 1250 h; the rate changes with pressure and speed."""
    one, fit = wearsim.remaining(DRIVE, 500, elongation_percent=1.2), wearsim.calibrate(DRIVE, READ)
    (value,) = fit.found.values
    assert one.coefficient == pytest.approx(value.value, rel=1e-6)
    assert any("holds at 21.28 MPa, 300 rpm and 12.7 mm" in text for text in one.found.assumptions)
    again = wearsim.remaining(fit.case, 500, elongation_percent=1.2)
    assert again.life.hours == pytest.approx(1250.0, rel=1e-6)
    assert again.found.factor == pytest.approx(1.0, rel=1e-6)


def test_a_constant_coefficient_of_one_reading_may_be_written_into_the_case():
    rate = "joint.specific_wear_rate_mm2_per_N"
    constant = changed(DRIVE, {rate: 1e-9, "joint.source": "a guess"})
    found = wearsim.remaining(constant, 500, elongation_percent=1.2)
    own = wearsim.load_case(
        changed(constant, {rate: found.coefficient, "joint.source": "ruler, after 500 h"})
    )
    assert doubts(own) == []
    assert wearsim.remaining(own, 500, elongation_percent=1.2).found.factor == pytest.approx(1.0, rel=1e-9)


def test_teeth_take_the_factor_of_the_chain_where_that_is_chosen():
    """Both coefficients times one factor: the life of a sprocket is its own over that."""
    own = wearsim.simulate(wearsim.load_case(DRIVE)).parts["small"].hours
    fits = {teeth: wearsim.calibrate(DRIVE, READ, teeth=teeth) for teeth in ("case", "chain")}
    (value,) = fits["chain"].found.values
    factor = value.value / value.in_case
    of_chain = wearsim.simulate(fits["chain"].case).parts["small"].hours
    assert of_chain == pytest.approx(own / factor, rel=1e-2)
    # Teeth of the case meet the same chains sooner, but wear as slowly as before.
    assert wearsim.simulate(fits["case"].case).parts["small"].hours_run > 10.0 * of_chain
    for teeth, found in fits.items():
        assert any(f"--teeth {teeth}" in text for text in found.found.assumptions)


def test_sprockets_with_a_wear_of_their_own_cannot_follow_the_chain():
    pytest.importorskip("pandera", reason="pandera is not installed")
    drive = changed(DRIVE, {})
    drive["sprocket"][0]["wear"] = {"specific_wear_rate_mm2_per_N": 1e-10}
    with pytest.raises(wearsim.CaseError, match=r"sprocket\.1\.wear: must be left out here"):
        wearsim.calibrate(drive, READ, teeth="chain")
