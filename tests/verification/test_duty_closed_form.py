"""Lives under a duty: from constant runs and from integrals over the log, by linear addition.

A block that alone would end the life after N_i cycles takes c_i/N_i of it in every cycle, so
1/N = sum c_i f_i/N_i where the shape worn off does not depend on the load: on a strand,
where depth ~ F^((m+1)/2) n^n_v at every point.
"""

from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

import wearsim
from wearsim.contact.resting_engagement import MateWear
from wearsim.drive.load_case import load_case
from wearsim.kernels.event_rows import EVENT_COUNT, EVENT_LOAD, EVENT_SPEED

STRAND = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "evolute_offset_mm": 5.6, "nodes": 51},
    "stop": {"critical_depth_mm": 0.01},
}
WRAP = {
    "format_version": 1,
    "chain": {"designation": "ANSI 40"},
    "sprocket": {"teeth": 19, "profile": "ansi_b29", "nodes": 61},
    "mechanism": {"phases": 1},
    "drive": {"slack_tension_N": 40.0},
    "joint": {"specific_wear_rate_mm2_per_N": 1e-10},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-9},
    "stop": {"critical_depth_mm": 0.01},
    "run": {"life_tolerance": 0.1, "horizon_hours": 1e6},
}
LAWS = {
    "archard": ({"specific_wear_rate_mm2_per_N": 1e-9}, 1.0, 0.0),
    "m 1.5": ({"law": "power", "coefficient": 1e-11, "pressure_exponent": 1.5}, 1.5, 0.0),
    "m 2": ({"law": "power", "coefficient": 3e-13, "pressure_exponent": 2}, 2.0, 0.0),
    "drozdov": (
        {
            "law": "drozdov",
            "coefficient": 1e-5,
            "pressure_exponent": 1.5,
            "hardness_MPa": 4000,
            "reference_speed_mm_per_s": 300,
            "speed_exponent": -0.4,
        },
        1.5,
        -0.4,
    ),
}
EVERY_LAW = pytest.mark.parametrize("law", LAWS)


def strand(law, **tables):
    return wearsim.simulate(load_case({**STRAND, "wear": LAWS[law][0], **tables}))


@cache
def constant(law, tension, speed):
    return strand(law, load={"tension_N": tension, "speed_rpm": speed}).life


def block(share, tension, speed, factor=1.0, kind="share_of_cycles"):
    return {kind: share, "tension_N": tension, "speed_rpm": speed, "wear_factor": factor}


def wrap(**tables):
    return wearsim.simulate(load_case({**WRAP, **tables}))


@cache
def constant_wrap():
    return wrap(load={"tension_N": 1300, "speed_rpm": 97.3})


def numbers(result):
    """All that a result counts."""
    lives = [*vars(result.life).values(), *vars(result.life_low).values()]
    lives += [value for life in result.parts.values() for value in vars(life).values()]
    columns = (*result.history_columns.values(), *result.flank_columns.values())
    return np.concatenate([lives, *map(np.ravel, columns)])


@EVERY_LAW
@pytest.mark.parametrize("kind", ["share_of_time", "share_of_cycles"])
def test_one_block_on_a_strand_is_the_constant_run(law, kind):
    load = {"tension_N": 5000, "speed_rpm": 97.3}
    one = strand(law, duty=[block(1, 5000, 97.3, kind=kind)])
    same = numbers(strand(law, load=load))
    assert_allclose(numbers(one), same, rtol=1e-12)


@pytest.mark.wide
@pytest.mark.parametrize("kind", ["share_of_time", "share_of_cycles"])
def test_one_block_on_a_wrap_is_the_constant_run(kind):
    one = wrap(duty=[block(1, 1300, 97.3, kind=kind)])
    same = numbers(constant_wrap())
    assert_allclose(numbers(one), same, rtol=1e-12)


@EVERY_LAW
def test_two_blocks_take_their_parts_of_the_life(validated, law):
    """The factor 0.25 is a state of lubrication; a quarter of the cycles are at 6000 N."""
    life = strand(law, duty=[block(0.25, 6000, 60), block(0.75, 2500, 180, 0.25)]).life
    heavy, light = constant(law, 6000, 60), constant(law, 2500, 180)
    cycles = 1 / (0.25 / heavy.cycles + 0.75 * 0.25 / light.cycles)
    quantity, source = f"life under two blocks, {law}", "1/N = sum c_i f_i/N_i of constant runs"
    shown = law in ("archard", "drozdov")
    validated(quantity, life.cycles, cycles, 1e-6, source, "cycles", page=shown)
    assert life.hours == pytest.approx(cycles / 60 * (0.25 / 60 + 0.75 / 180), rel=1e-6)


@EVERY_LAW
def test_lives_of_constant_loads_follow_the_powers(law):
    """N F^((m+1)/2) n^n_v is constant: what the reduction of a duty rests on."""
    _, m, n = LAWS[law]
    heavy, light = constant(law, 6000, 60), constant(law, 2500, 180)
    ratio = (6000 / 2500) ** ((m + 1) / 2) * (60 / 180) ** n
    assert light.cycles / heavy.cycles == pytest.approx(ratio, rel=1e-6)


def test_shares_of_time_and_of_cycles_differ_as_by_hand():
    """m = 1, half at 6000 N and 50 rpm, half at 2000 N and 150 rpm.

    Of the cycles: mean load 4000 N, mean speed 1/(0.5/50 + 0.5/150) = 75 rpm. Of the time: one
    cycle in four is heavy, mean load 3000 N, mean speed 100 rpm. Hours as 4000 * 75 to 3000 * 100.
    """
    pair = (0.5, 6000, 50), (0.5, 2000, 150)
    cycles, time = (
        strand("archard", duty=[block(*entry, kind=kind) for entry in pair]).life
        for kind in ("share_of_cycles", "share_of_time")
    )
    alone = constant("archard", 6000, 60).cycles * 6000
    assert cycles.cycles == pytest.approx(alone / 4000, rel=1e-6)
    assert time.cycles == pytest.approx(alone / 3000, rel=1e-6)
    assert cycles.hours == pytest.approx(alone / 4000 / 60 / 75, rel=1e-6)
    assert time.hours == pytest.approx(alone / 3000 / 60 / 100, rel=1e-6)


def test_constant_speed_makes_the_shares_alike():
    pair = (0.3, 6000, 80), (0.7, 2000, 80)
    lives = [
        strand("m 2", duty=[block(*entry, kind=kind) for entry in pair]).life
        for kind in ("share_of_cycles", "share_of_time")
    ]
    assert lives[0].hours == pytest.approx(lives[1].hours, rel=1e-12)


@pytest.mark.parametrize(("name", "mean", "within"), [("II", 0.4, 5e-4), ("0", 1.0, 1e-12)])
def test_typical_regime_on_a_strand(validated, name, mean, within):
    """All loads equally probable, m = 2: the mean of x^1.5 is 2/5."""
    life = strand("m 2", load={"tension_N": 6000, "speed_rpm": 60, "regime": name}).life
    hours, source = constant("m 2", 6000, 60).hours / mean, "mean of x^1.5 over the regime by hand"
    quantity, shown = f"life in the regime {name}, m = 2", name == "II"
    validated(quantity, life.hours, hours, within, source, "h", page=shown)


@pytest.fixture(scope="module")
def log(tmp_path_factory):
    """Path of a random log, and its steps, tensions and speeds."""
    random = np.random.default_rng(8)
    time = np.round(np.cumsum(random.uniform(0.5, 1.5, 301)), 3)
    tension, speed = np.round(random.gamma(4.0, 500.0, 301), 3), random.integers(40, 160, 301)
    path = tmp_path_factory.mktemp("log") / "log.csv"
    rows = zip(time, tension, speed, strict=True)
    path.write_text("time_s,tension_N,speed_rpm\n" + "".join(f"{a},{b},{c}\n" for a, b, c in rows))
    return path, np.diff(time), tension[:-1], speed[:-1].astype(float)


@pytest.mark.parametrize(
    ("law", "bins", "within"),
    [
        ("archard", [1, 1], 1e-6),
        ("archard", [20, 8], 1e-6),
        ("m 2", [20, 8], 1e-3),
        ("m 2", [100, 100], 3e-5),
        ("drozdov", [20, 8], 2e-3),
        ("drozdov", [100, 100], 3e-5),
    ],
)
def test_log_against_the_integral_over_it(validated, law, bins, within, log):
    """Hours from the wear of every second, integral of F^((m+1)/2) n^(1+n_v) over the time."""
    path, step, tension, speed = log
    _, m, n = LAWS[law]
    rate = np.average(tension ** ((m + 1) / 2) * speed ** (1 + n), weights=step)
    reference = 6000 ** ((m + 1) / 2) * 60 ** (1 + n)
    hours = constant(law, 6000, 60).hours * reference / rate
    life = strand(law, load={"duty_file": str(path), "duty_bins": bins}).life
    quantity, source = f"life under a log of 300 steps, {law}", "integral of the wear over the log"
    shown = bins == [100, 100]
    validated(quantity, life.hours, hours, within, source, "h", page=shown)
    mean = np.average(speed, weights=step)
    assert life.cycles == pytest.approx(life.hours * 60 * mean, rel=1e-12)


class TestWrap:
    """A wrap adds the contacts of its blocks; joints add their wear."""

    PAIR = (0.25, 1300, 80), (0.75, 600, 240)

    @staticmethod
    def contact(**tables):
        case = load_case({**WRAP, **tables})
        return case.drive.contact(case)

    @staticmethod
    def table(contact):
        profile = contact.profile
        outlines = (np.tile(points, (contact.bodies, 1)) for points in (profile.x, profile.y))
        return contact.events(*outlines, MateWear(0.01), contact.memory())

    def test_contacts_are_those_of_the_constant_loads(self):
        """Count times share times factor, all else as it is."""
        both = self.table(self.contact(duty=[block(*self.PAIR[0]), block(*self.PAIR[1], 3.0)]))
        columns = both.shape[1] // 2
        parts = both[:, :columns], both[:, columns:]
        for part, factor, (share, tension, speed) in zip(parts, (1, 3), self.PAIR, strict=True):
            alone = self.table(self.contact(load={"tension_N": tension, "speed_rpm": speed}))
            alone[EVENT_COUNT] *= share * factor
            assert np.array_equal(part, alone)
        heavy, light = (part[EVENT_LOAD].max() for part in parts)
        assert heavy > 2.0 * light > 0.0
        # Three times the speed, of a little less path.
        speeds = [part[EVENT_SPEED][part[EVENT_LOAD] > 0].max() for part in parts]
        assert 2.0 < speeds[1] / speeds[0] < 3.5

    def test_chain_grows_by_the_mean_of_the_blocks(self):
        """Joint pressure is tension plus q v^2 over A; v of 19 * 12.7 mm a turn."""
        duty = [block(*entry) for entry in self.PAIR]
        duty_case = load_case({**WRAP, "duty": duty})
        chain = duty_case.drive.chain
        growth = 0.0
        for share, tension, speed in self.PAIR:
            own = 1e6 * chain.mass_per_length * (19 * 12.7e-3 * speed / 60) ** 2
            path = np.pi * chain.pin_diameter * (2 / 19)
            pressures = (tension + 40.0 + 2 * own) / chain.bearing_area
            growth += share * 1e-10 * pressures * path / 12.7 * 19 / duty_case.drive.layout.links
        assert self.contact(duty=duty).elongation_per_cycle == pytest.approx(growth, rel=1e-9, abs=0)

    def test_two_equal_blocks_are_one(self):
        half = block(0.5, 1300, 97.3)
        one = numbers(constant_wrap())
        assert_allclose(numbers(wrap(duty=[half, half])), one, rtol=1e-12)

    def test_two_blocks_hardly_apart_are_nearly_one(self):
        """They stay two: the steps of their wear follow one another."""
        life = wrap(duty=[block(0.5, 1300, 97.3), block(0.5, 1300.001, 97.3)]).parts["sprocket"]
        one = constant_wrap().parts["sprocket"]
        assert life.cycles == pytest.approx(one.cycles, rel=0.02)

    @pytest.mark.wide
    def test_twice_the_speed_is_half_the_hours_and_the_same_cycles(self):
        """Centrifugal tension loads joints but not teeth."""
        slow, fast = (
            wrap(duty=[block(0.5, 1300, speed), block(0.5, 700, speed)]).parts["sprocket"]
            for speed in (50, 100)
        )
        assert fast.cycles == pytest.approx(slow.cycles, rel=1e-4)
        assert fast.hours == pytest.approx(slow.hours / 2, rel=1e-4)

    @pytest.mark.wide
    @pytest.mark.parametrize(
        ("applies_to", "teeth", "joints"), [("all", 2.0, 2.0), ("teeth", 2.0, 1.0), ("joints", 1.0, 2.0)]
    )
    def test_factor_on_every_block_is_one_on_the_coefficient(self, applies_to, teeth, joints):
        duty = [block(0.5, 1300, 80, 2.0), block(0.5, 600, 80, 2.0)]
        factor = wrap(duty=[{**entry, "applies_to": applies_to} for entry in duty]).parts
        rate = wrap(
            duty=[{**entry, "wear_factor": 1.0} for entry in duty],
            wear={"specific_wear_rate_mm2_per_N": teeth * 1e-9},
            joint={"specific_wear_rate_mm2_per_N": joints * 1e-10},
        ).parts
        assert factor["sprocket"].cycles == pytest.approx(rate["sprocket"].cycles, rel=1e-12)
        assert factor["chain"].cycles == pytest.approx(rate["chain"].cycles, rel=1e-12)

    def test_idling_hardly_wears(self):
        """Half of the cycles near the slack tension: a life of about twice, not more."""
        duty = [block(0.5, 1300, 97.3), block(0.5, 41, 97.3)]
        ratio = wrap(duty=duty).parts["sprocket"].cycles / constant_wrap().parts["sprocket"].cycles
        assert 1.7 < ratio < 2.0


def test_twice_the_speed_on_a_strand_is_half_the_hours():
    slow, fast = (
        strand("archard", duty=[block(0.5, 6000, speed), block(0.5, 3000, speed)]).life for speed in (50, 100)
    )
    assert fast.cycles == pytest.approx(slow.cycles, rel=1e-12)
    assert fast.hours == pytest.approx(slow.hours / 2, rel=1e-12)
