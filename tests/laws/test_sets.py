"""Every set of tests/validation that holds wear of several readings, before the court of laws."""

import math

import pytest

pytestmark = pytest.mark.wide


def constant(found, law, name):
    """The middle of a constant of a law, with the scatter that scores higher."""
    taken = next(one for one in found.laws if one.law == law)
    return next(one.middle for one in taken.constants if one.name == name)


def test_metal_later(series_of, judged):
    """V1: metal specimens, later readings

    12 specimens whose wear slows down from the first reading on. Only a power of the cycles, 0.19,
    fits; the power of the load, 0.65, makes no difference here, as the load of each specimen is constant.
    Archard's law and an exponential running-in are far behind: the wear rate never becomes constant.

    Specimens drift. With a constant factor the 90 % band holds too few readings; with a drifting
    factor it holds 30 or 31 of 36, which agrees with 90 % for 12 specimens. That is just enough
    for the rows of V1 on the page [measured](measured.md), where the constant factor fails.
    """
    data = series_of("metal", lambda one: one.exposure > 50)
    split = "readings up to 50 cycles; those at 100, 200 and 500"
    found = judged(split, data, "cycle power", True, behind=("Archard", "running-in", "offset", "none"))
    assert found.best.scatter == "walk"
    assert constant(found, "powers", "exposure_exponent") == pytest.approx(0.19, abs=0.01)
    assert constant(found, "powers", "load_exponent") == pytest.approx(0.65, abs=0.02)
    stays = next(one for one in found.laws if (one.law, one.scatter) == ("powers", "factor"))
    assert stays.coverage_90 < 0.8
    assert round(36 * found.simplest.coverage_90) in (30, 31)


def test_metal_load(series_of, judged):
    """V1: metal specimens, another load

    The middle load is predicted from the other two, for unknown specimens. Again the powers of
    load and cycles are best. A running-in with a power of the load, whose scatter makes up for its
    shape, is tied with them.
    """
    data = series_of("metal", lambda one: one.load == 50)
    judged("10 and 100 g; 50 g", data, "powers", True, behind=("Archard", "load power", "none"))


def test_commuter_later(series_of, judged):
    """V2: two chains of a commuter, later readings

    Wear is the growth beyond the length at which a straight line through the early readings starts,
    measured to 0.1 mm. Four readings only rule out wear that slows down. Archard's law is as good as
    any other; no law here describes the faster wear at the end (salt, winter).
    """
    data = series_of("commuter", lambda one: one.exposure > 3250, lambda one: one.series != "Miche")
    judged("Shimano and KMC up to 3250 km; their later readings", data, "Archard", True, behind=("none",))


def test_commuter_rain(series_of, judged):
    """V2: a chain in the rain

    The last two readings of the third chain, one after a stretch without rain and one after a stretch
    with rain. A factor of the environment is the best law; it is about 3 (0.8 to 5). But two readings
    of one chain rule out hardly any law, and Archard's law is the simplest of those left.
    """
    data = series_of(
        "commuter",
        lambda one: one.series == "Miche" and one.exposure > 2850,
        lambda one: one.series == "Miche" or one.exposure <= 3250,
    )
    split = "early readings and the first rain; the rest of Miche"
    found = judged(split, data, "Archard", True, behind=("none",))
    assert found.best.law == "environment"
    assert constant(found, "environment", "rain over mixed") == pytest.approx(3.0, abs=0.6)


def test_single_chains(series_of, judged):
    """V6: chains of many riders

    One reading of each of 13 chains. Nothing is known of their drives. No law predicts them better
    than an elongation that does not depend on distance at all: the chains were measured when they
    were worn. Half of them differ from the forecast by more than a factor of 1.6.
    """
    chains = [one.series for one in _readings("single_chains")]
    data = series_of("single_chains", lambda one: chains.index(one.series) % 2 == 1)
    found = judged("every second chain; the others", data, "none", False)
    assert found.laws[0].median_error > math.log(1.5)


def _readings(name):
    from runpy import run_path

    return run_path(__file__.replace("test_sets", "conftest"))["SETS"][name]()[0]


def test_pins_later(series_of, judged):
    """V7: pins of plastic, later readings

    8 tests of three materials, each a series of its own (the material with drift of the gauge is left
    out). A power near 0.6 and a running-in that ends predict the later depth almost equally well, to
    about 10 %, if the factor of the pin may drift. Archard's law does not.
    """
    data = series_of("pins", lambda one: one.exposure > 200)
    judged("depths up to 200 m; those beyond", data, "cycle power", True, behind=("Archard", "none"))


def test_pins_load(series_of, judged):
    """V7: pins of plastic, another load

    Pins at 98.1 N predicted from others at 59.8 N. There is only one load to fit, so a power of the
    load keeps its prior range and does not help. Depth in proportion to the load is within a factor
    of 1.4 for half of the readings; that does not prove the proportion, as pins differ by as much.
    """
    data = series_of("pins", lambda one: one.load > 90, lambda one: "15PTFE" not in one.series)
    judged("59.8 N; 98.1 N", data, "cycle power", True, behind=("Archard", "none"))


def test_composite_later(series_of, judged):
    """V8: plastic with carbon fibres, later readings

    Mass losses of 12 specimens. A power of the distance, near 0.6, predicts within 6 %; a running-in
    that ends is slightly behind, Archard's law far behind.
    """
    data = series_of("composite", lambda one: one.exposure > 600)
    found = judged("200 to 600 m; 800 and 1000 m", data, "cycle power", True, behind=("Archard", "none"))
    assert constant(found, "cycle power", "exposure_exponent") == pytest.approx(0.6, abs=0.03)
    assert found.best.median_error < 0.07


def test_composite_load(series_of, judged):
    """V8: plastic with carbon fibres, another load

    Specimens at 30 N predicted from others at 10 and 20 N. The four contents of nanotubes differ in
    wear by a factor of 3, which no law includes and which hides the effect of the load. The bands are
    wide but hold; half of the readings are off by a factor of 1.4 to 1.7, and most laws are tied.
    """
    data = series_of("composite", lambda one: one.load == 30)
    judged("10 and 20 N; 30 N", data, "Archard", True, behind=("none",))


def test_twin_disc(series_of, judged):
    """V9: twin discs

    The published law from mild to severe wear, its scale fitted at slips of 0.2, 0.5 and 1 %, predicts
    3, 7.5 and 10 %. It must: **the data are that law**; no measured points were available. The table
    only shows that wear in proportion to sliding distance (Archard) does not fit.
    """
    data = series_of("twin_disc", lambda one: one.slip > 0.011)
    found = judged("slips up to 1 %; 3, 7.5 and 10 %", data, "T-gamma", True, behind=("Archard", "none"))
    assert found.best.median_error < 0.01
