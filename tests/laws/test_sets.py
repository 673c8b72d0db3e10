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
    holds; that of the load, 0.65, makes no difference here, as each specimen stays under its own.
    Archard's law and an exponential running-in are far behind: the wear never settles to a rate.

    Specimens wander. With a factor that stays, the band of 90 % holds too few readings; with one
    that wanders it holds 30 or 31 of 36, within what 12 specimens can tell: just enough
    for the rows of V1 on the page of [measured](measured.md), where the factor that stays fails.
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

    The middle load is foretold by the other two, for specimens of which nothing is known: the powers of
    load and cycles again. A running-in with a power of the load and a scatter that makes up for its
    shape is not told apart.
    """
    data = series_of("metal", lambda one: one.load == 50)
    judged("10 and 100 g; 50 g", data, "powers", True, behind=("Archard", "load power", "none"))


def test_commuter_later(series_of, judged):
    """V2: two chains of a commuter, later readings

    Wear is the growth since the length at which a straight line through the early readings begins,
    with a gauge good to 0.1 mm. Four readings tell nothing apart but the wrong direction: wear that
    slows down. Archard is as good as any law; the chains' faster end (salt, winter) has no law here.
    """
    data = series_of("commuter", lambda one: one.exposure > 3250, lambda one: one.series != "Miche")
    judged("Shimano and KMC up to 3250 km; their later readings", data, "Archard", True, behind=("none",))


def test_commuter_rain(series_of, judged):
    """V2: a chain in the rain

    The last two readings of the third chain, one stretch without rain noted and one with. A factor
    of the environment is the best law; it is about 3, anything from 0.8 to 5. But two readings of one
    chain tell hardly anything apart, and Archard's law is the simplest of those left.
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

    One reading of each of 13 chains. Nothing is known of their drives, and no law foretells them
    better than that a chain's elongation does not depend on its distance at all: they were read
    when they were worn. Half of them lie further than a factor of 1.6 from the forecast.
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

    8 tests of three materials, each judged as a series of its own (the material without drift of
    the gauge only). A power near 0.6 and a running-in that ends foretell the later depth nearly alike,
    off by about a tenth, if the factor of the pin may wander; Archard does not.
    """
    data = series_of("pins", lambda one: one.exposure > 200)
    judged("depths up to 200 m; those beyond", data, "cycle power", True, behind=("Archard", "none"))


def test_pins_load(series_of, judged):
    """V7: pins of plastic, another load

    Pins at 98.1 N foretold from others at 59.8 N. There is one load to learn from: a power of the
    load is only what was expected of it before, and helps nothing. Depth in proportion to the load
    is within a factor of 1.4 for half of the readings; that is no proof of the proportion, as pins
    differ by as much.
    """
    data = series_of("pins", lambda one: one.load > 90, lambda one: "15PTFE" not in one.series)
    judged("59.8 N; 98.1 N", data, "cycle power", True, behind=("Archard", "none"))


def test_composite_later(series_of, judged):
    """V8: plastic with carbon fibres, later readings

    Losses of 12 specimens. A power of the distance, near 0.6, foretells within 6 %; a running-in that
    ends is a little behind, Archard far.
    """
    data = series_of("composite", lambda one: one.exposure > 600)
    found = judged("200 to 600 m; 800 and 1000 m", data, "cycle power", True, behind=("Archard", "none"))
    assert constant(found, "cycle power", "exposure_exponent") == pytest.approx(0.6, abs=0.03)
    assert found.best.median_error < 0.07


def test_composite_load(series_of, judged):
    """V8: plastic with carbon fibres, another load

    Specimens at 30 N foretold from others at 10 and 20 N. The four contents of nanotubes differ by a
    factor of 3, which the laws do not know of; the load drowns in it. Bands hold and are wide, half of
    the readings are off by a factor of 1.4 to 1.7, and most laws are not told apart.
    """
    data = series_of("composite", lambda one: one.load == 30)
    judged("10 and 20 N; 30 N", data, "Archard", True, behind=("none",))


def test_twin_disc(series_of, judged):
    """V9: twin discs

    The published law from mild to severe, its scale fitted to slips of 0.2, 0.5 and 1 %, foretells
    3, 7.5 and 10 %. It must: **the data are that law**, no points were seen. That the way slid (Archard)
    does not lead there is all that this table shows.
    """
    data = series_of("twin_disc", lambda one: one.slip > 0.011)
    found = judged("slips up to 1 %; 3, 7.5 and 10 %", data, "T-gamma", True, behind=("Archard", "none"))
    assert found.best.median_error < 0.01
