"""The duty as it is read: blocks, typical regimes and logs, and every fault with its line."""

import re

import numpy as np
import pytest

from wearsim.catalogue.catalogues import regimes
from wearsim.drive.load_case import load_case
from wearsim.errors import CaseError
from wearsim.input.duty_log import DutyLog, LogBin, log_bins, merged

HEAD = """\
format_version = 1
[chain]
designation = "16B-1"
[sprocket]
teeth = 20
profile = "evolute"
evolute_offset_mm = 5.6
nodes = 51
[wear]
condition = "hardened, oiled"
"""
BLOCK = """\
[[duty]]
{share} = {part}
{load} = {value}
speed_rpm = {speed}
"""


def blocks(*given, share="share_of_time", load="tension_N"):
    """Tables of [[duty]] from pairs or triples of share, load and speed."""
    return "".join(
        BLOCK.format(share=share, part=part, load=load, value=value, speed=speed)
        for part, value, speed in given
    )


@pytest.fixture
def case(tmp_path):
    """Function that reads a case of HEAD and more, with a log beside it."""

    def read(more, log="", overrides=()):
        (tmp_path / "log.csv").write_text(log, encoding="utf-8")
        path = tmp_path / "drive.toml"
        path.write_text(HEAD + more, encoding="utf-8")
        return load_case(path, overrides)

    return read


@pytest.fixture
def faults(case):
    """Function that returns the faults of a case as pairs of line and message."""

    def found(more, log="", overrides=()):
        with pytest.raises(CaseError) as caught:
            case(more, log, overrides)
        return [(fault.line, f"{fault.key}: {fault.message}") for fault in caught.value.faults]

    return found


def table(case):
    """Shares, tensions, speeds and factors of the blocks of a case."""
    drive = case.drive
    return [(block.share, block.tension, block.speed_rpm, block.wear_factor) for block in drive.blocks]


class TestShares:
    """A quarter of the time at 60 rpm and three quarters at 180 rpm: 15 of 150 turns a minute."""

    TWO = ((0.25, 6000, 60), (0.75, 2000, 180))

    def test_of_time(self, case):
        found = case(blocks(*self.TWO))
        assert found.speed_rpm == pytest.approx(150.0, rel=1e-15)
        assert table(found) == [
            (pytest.approx(0.1), 6000.0, 60.0, 1.0),
            (pytest.approx(0.9), 2000.0, 180.0, 1.0),
        ]

    def test_of_cycles(self, case):
        """0.25/60 + 0.75/180 = 1/120 minute for a turn."""
        found = case(blocks(*self.TWO, share="share_of_cycles"))
        assert found.speed_rpm == pytest.approx(120.0, rel=1e-15)
        assert [row[0] for row in table(found)] == [0.25, 0.75]

    @pytest.mark.parametrize("share", ["share_of_time", "share_of_cycles"])
    def test_of_one_block_is_the_constant_drive(self, case, share):
        constant = case("[load]\ntension_N = 4321\nspeed_rpm = 97.3\n")
        found = case(blocks((1.0, 4321, 97.3), share=share))
        assert found.drive.blocks == constant.drive.blocks
        assert found.speed_rpm == constant.speed_rpm == 97.3

    def test_sum_within_1e_6_is_made_1(self, case):
        found = case(blocks((0.5, 5000, 100), (0.5000009, 4000, 100)))
        assert sum(row[0] for row in table(found)) == pytest.approx(1.0, abs=1e-15)

    def test_equal_blocks_are_one(self, case):
        """Their factors on wear count by their shares: (0.2 * 1 + 0.6 * 3)/0.8."""
        one = blocks((0.2, 5000, 100))
        more = blocks((0.6, 5000, 100)) + "wear_factor = 3\n"
        found = case(one + more + blocks((0.2, 4000, 100)))
        assert table(found) == [
            (pytest.approx(0.8), 5000.0, 100.0, pytest.approx(2.5)),
            (pytest.approx(0.2), 4000.0, 100.0, 1.0),
        ]


def test_equal_blocks_keep_the_factors_of_teeth_and_joints(case):
    """Factors 2, 3 and 5 with shares 0.2, 0.6 and 0.2 on all, the teeth and the joints.

    Teeth 0.2 * 2 + 0.6 * 3 + 0.2 * 1, joints 0.2 * 2 + 0.6 * 1 + 0.2 * 5.
    """
    acts = ("2", 'all"'), ("3", 'teeth"'), ("5", 'joints"')
    given = "".join(
        blocks((share, 5000, 100)) + f'wear_factor = {factor}\napplies_to = "{on}\n'
        for share, (factor, on) in zip((0.2, 0.6, 0.2), acts, strict=True)
    )
    (block,) = case(given, overrides=["mechanism.kind=wrap", "joint.law=constant"]).drive.blocks
    assert (block.wear_factor, block.joint_factor) == pytest.approx((2.4, 2.0), rel=1e-15)


def test_power_and_torque_of_a_block_are_those_of_load(case):
    """P/(omega R) with R = 20 p/(2 pi): 3 kW at 100 rpm pull 3543.3 N, 280 N m pull 3463.2 N."""
    found = case(blocks((0.5, 3, 100), load="power_kW") + blocks((0.5, 280, 100), load="torque_N_m"))
    pulls = [3e6 / (100 / 60 * 20 * 25.4), 280e3 / (20 * 25.4 / (2 * np.pi))]
    assert [row[1] for row in table(found)] == pytest.approx(pulls, rel=1e-12)
    assert found.drive.pull == max(row[1] for row in table(found))


def test_strings_with_units_are_read_in_a_block(case):
    found = case(blocks((1, '"5 kN"', '"10 rad/s"')))
    assert table(found) == [(1.0, 5000.0, pytest.approx(300 / np.pi, rel=1e-14), 1.0)]


def test_answer_says_what_the_heaviest_block_is_for(case):
    texts = " ".join(case(blocks((0.5, 5000, 100), (0.5, 3000, 100))).assumptions)
    assert "that of the heaviest block" in texts
    assert "heaviest" not in " ".join(case(blocks((1.0, 5000, 100))).assumptions)


PUBLISHED = {
    "I": (0.5, 0.3, 0.2),
    "II": (0.25, 0.143, 0.1),
    "III": (0.18, 0.065, 0.036),
    "IV": (0.125, 0.038, 0.016),
    "V": (0.063, 0.013, 0.004),
}
"""Table 2.2: mean of (T/T_max)^3, ^6 and ^9 over the cycles."""


def moment(name, power):
    return sum(share * load**power for load, share in regimes()[name])


class TestRegimes:
    @pytest.mark.parametrize("name", ["I", "II", "IV", "V"])
    def test_moments_are_published_to_every_digit(self, name):
        for power, value in zip((3, 6, 9), PUBLISHED[name], strict=True):
            digits = len(str(value).partition(".")[2])
            assert round(moment(name, power), digits) == value

    def test_moments_of_the_normal_one(self):
        """A normal distribution that has the published mean cube has no more of the others."""
        assert moment("III", 3) == pytest.approx(0.18, rel=2e-5)
        assert moment("III", 6) == pytest.approx(0.065, rel=0.015)
        assert moment("III", 9) == pytest.approx(0.036, rel=0.02)

    def test_constant_one(self):
        assert regimes()["0"] == ((1.0, 1.0),)

    @pytest.mark.parametrize("name", list(PUBLISHED))
    def test_shares_sum_to_1_and_loads_fall_from_the_given_one(self, name):
        loads, shares = zip(*regimes()[name], strict=True)
        assert sum(shares) == pytest.approx(1.0, abs=1e-12)
        assert sorted(loads, reverse=True) == list(loads)
        assert 0.0 < loads[-1] < loads[0] < 1.0

    def test_each_is_lighter_than_the_one_before(self):
        means = [moment(name, 1.25) for name in ("0", *PUBLISHED)]
        assert sorted(means, reverse=True) == means

    def test_it_scales_the_pull(self, case):
        found = case('[load]\npower_kW = 3\nspeed_rpm = 100\nregime = "II"\n')
        whole = 3e6 / (100 / 60 * 20 * 25.4)
        loads = [part * whole for part, _ in regimes()["II"]]
        assert [row[1] for row in table(found)] == pytest.approx(loads, rel=1e-12)
        assert [row[0] for row in table(found)] == [share for _, share in regimes()["II"]]
        assert found.speed_rpm == 100.0

    def test_constant_one_is_the_constant_drive(self, case):
        load = "[load]\ntension_N = 5000\nspeed_rpm = 100\n"
        assert case(load + 'regime = "0"\n').drive.blocks == case(load).drive.blocks
        found = case(load, overrides=["load.regime=0"])
        assert found.drive.blocks == case(load).drive.blocks
        assert found.inputs["load"]["regime"] == "0"

    def test_on_a_wrap_the_slack_strand_stays(self, case):
        """Torque goes with tight less slack."""
        load = '[load]\ntension_N = 5000\nspeed_rpm = 100\nregime = "V"\n'
        found = case(load, overrides=[*CUT, f"drive={DRIVE}"])
        assert found.drive.slack == 1000.0
        assert [row[1] for row in table(found)] == pytest.approx(
            [1000.0 + part * 4000.0 for part, _ in regimes()["V"]], rel=1e-14
        )


CUT = ("sprocket={teeth=20,profile='iso606',nodes=151}",)
DRIVE = "{slack_tension_N=1000}"


def log_text(*rows, head="time_s,tension_N,speed_rpm"):
    return "\n".join([head, *rows]) + "\n"


def random_log(rows=400, seed=5):
    random = np.random.default_rng(seed)
    step = random.uniform(0.5, 1.5, rows)
    return DutyLog(step, random.gamma(4.0, 500.0, rows), random.uniform(40.0, 160.0, rows))


def sums(found):
    """Time, revolutions and load times revolutions."""
    return np.array(
        [
            sum(block.time for block in found),
            sum(block.revolutions for block in found),
            sum(block.revolutions * block.load for block in found),
        ]
    )


class TestLog:
    KEYS = '[load]\nduty_file = "log.csv"\n'

    def test_rows_hold_until_the_next(self, case):
        """10 s at 1000 N and 60 rpm, 30 s at 4000 N and 120 rpm; the last row is the end."""
        found = case(self.KEYS, log_text("0,1000,60", "10,4000,120", "40,9,9"))
        assert table(found) == [
            (pytest.approx(10 / 70), 1000.0, pytest.approx(60.0), 1.0),
            (pytest.approx(60 / 70), 4000.0, pytest.approx(120.0), 1.0),
        ]
        assert found.speed_rpm == pytest.approx(60 * 70 / 40)
        assert [path.name for path in found.files] == ["log.csv"]

    @pytest.mark.parametrize("bins", [(1, 1), (20, 8), (7, 3), (100, 100)])
    def test_bins_keep_time_cycles_and_mean_tension(self, bins):
        log = random_log()
        turns = log.speed * log.step / 60.0
        kept = np.array([log.step.sum(), turns.sum(), (turns * log.load).sum()])
        found = log_bins(log, *bins)
        assert sums(found) == pytest.approx(kept, rel=1e-12)
        assert len(found) <= bins[0] * bins[1]
        for count in (len(found), 12, 3, 1):
            fewer = merged(found, count)
            assert len(fewer) == min(count, len(found))
            assert sums(fewer) == pytest.approx(kept, rel=1e-12)

    def test_the_smallest_joins_the_nearest(self):
        """10 turns of 1000 N go to 1100 N, not to 3000 N."""
        given = [LogBin(60.0, 60.0, 1100.0), LogBin(60.0, 60.0, 3000.0), LogBin(10.0, 10.0, 1000.0)]
        low, high = merged(given, 2)
        assert high == given[1]
        assert low == LogBin(70.0, 70.0, pytest.approx((66e3 + 10e3) / 70))

    def test_bins_are_the_case_s(self, case):
        rows = [f"{i},{1000 + 100 * i},{60 + i}" for i in range(12)]
        assert len(table(case(self.KEYS, log_text(*rows)))) == 11
        assert len(table(case(self.KEYS + "duty_bins = [2, 1]\n", log_text(*rows)))) == 2

    def test_a_constant_log_is_the_constant_drive(self, case):
        """0.1 s steps do not sum exactly."""
        rows = [f"{0.1 * i:.1f},4321,97.3" for i in range(40)]
        ((share, tension, speed, factor),) = table(case(self.KEYS, log_text(*rows)))
        assert (share, factor) == (1.0, 1.0)
        assert [tension, speed] == pytest.approx([4321.0, 97.3], rel=1e-14)

    def test_on_a_wrap_blocks_are_few_and_idling_takes_the_slack_tension(self, case):
        rows = [f"{i},{0 if i % 4 == 0 else 1000 + 40 * (i % 50)},{60 + i % 37}" for i in range(400)]
        found = case(self.KEYS, log_text(*rows), [*CUT, f"drive={DRIVE}"])
        assert len(table(found)) == 12
        tensions = [row[1] for row in table(found)]
        assert min(tensions) == found.drive.slack == 1000.0
        (text,) = [text for text in found.assumptions if text.startswith("log.csv")]
        assert re.search(r"399 s, .* to leave 12, .* lowers the mean square load by [\d.]+ %", text)
        assert any("pulls no more than the slack one" in text for text in found.assumptions)


GOOD = blocks((0.5, 5000, 100), (0.5, 3000, 100))
FIRST = HEAD.count("\n") + 1
"""Line of the first [[duty]] after HEAD; a block has four lines."""


class TestFaults:
    @pytest.mark.parametrize(
        ("more", "line", "words"),
        [
            (blocks((0.5, 5000, 100), (0.49, 3000, 100)), 0, "duty: share_of_time .* sum to 1 .*0.99"),
            (
                blocks((0.5, 5000, 100)) + blocks((0.5, 3000, 100), share="share_of_cycles"),
                5,
                r"duty.2.share_of_cycles: .*same key, in block 1 it is share_of_time",
            ),
            (GOOD + "share_of_cycles = 0.5\n", 8, "duty.2.share_of_cycles: give exactly one of"),
            (GOOD + "power_kW = 5\n", 8, r"duty.2.power_kW: give exactly one of .*tension_N, power_kW\)"),
            (GOOD.replace("tension_N = 3000\n", ""), 4, r"duty.2.tension_N: .*\(got none\)"),
            (GOOD.replace("= 3000", "= -3000"), 6, r"duty.2.tension_N: .*greater than 0 \(got -3000"),
            (GOOD.replace("time = 0.5", "time = -0.5", 1), 1, "duty.1.share_of_time: .*greater than 0"),
            (GOOD.replace("time = 0.5", "time = 1.5", 1), 1, "duty.1.share_of_time: .*less than"),
            (GOOD.replace("rpm = 100", "rpm = 0", 1), 3, r"duty.1.speed_rpm: .*or equal to 0\.000001"),
            (GOOD.replace("speed_rpm = 100\n", "", 1), 0, "duty.1.speed_rpm: this key is required"),
            (GOOD + "wear_factor = 0\n", 8, "duty.2.wear_factor: .*greater than 0"),
            (
                GOOD + 'wear_factor = 2\napplies_to = "joints"\n',
                9,
                r"duty.2.applies_to: joints wear only where a chain wraps the sprocket, here kind = "
                r"'strand': use 'all' or 'teeth', or set mechanism.kind = 'wrap'",
            ),
            (GOOD + 'applies_to = "rollers"\n', 8, "duty.2.applies_to: .*'teeth'"),
            (GOOD + "wear_faktor = 2\n", 8, "duty.2.wear_faktor: unknown key; .*wear_factor"),
            (GOOD.replace("= 3000", "= 1e9"), 6, "duty.2.tension_N: .*tensile strength"),
            ("[duty]\nspeed_rpm = 1\n", 1, r"duty: must be tables under headers \[\[duty\]\]"),
        ],
    )
    def test_of_a_block(self, faults, more, line, words):
        ((found, message),) = faults(more)
        assert re.match(words, message), message
        assert found == FIRST + line

    def test_all_in_one_pass(self, faults):
        more = GOOD.replace("= 3000", "= -3000").replace("rpm = 100", "rpm = 0", 1) + "[stop]\nx = 1\n"
        assert [line - FIRST for line, _ in faults(more)] == [3, 6, 9]

    @pytest.mark.parametrize(
        "keys", ["tension_N = 5", "speed_rpm = 5", 'regime = "I"', 'duty_file = "log.csv"']
    )
    def test_of_load_beside_duty(self, faults, keys):
        found = faults(GOOD + f"[load]\n{keys}\n")
        assert [line for line, _ in found] == [FIRST + 9]
        assert "[[duty]] gives load and speed" in found[0][1]

    @pytest.mark.parametrize("key", ["tension_N = 5", "speed_rpm = 5", 'regime = "I"'])
    def test_of_load_beside_a_log(self, faults, key):
        found = faults(f'[load]\nduty_file = "log.csv"\n{key}\n', log_text("0,1,1", "1,1,1"))
        assert [line for line, _ in found] == [FIRST + 2]
        assert "duty_file gives load and speed" in found[0][1]

    @pytest.mark.parametrize(
        ("load", "line", "words"),
        [
            ("", 0, "load: this table is required and missing"),
            ("[load]\ntension_N = 5000\n", 1, "load.speed_rpm: this key is required and missing"),
            ("[load]\nspeed_rpm = 5\n", 1, "load.tension_N: give exactly one of"),
            ('[load]\nregime = "I"\nspeed_rpm = 5\n', 1, "load.tension_N: give exactly one of"),
            ('[load]\ntension_N = 5000\nspeed_rpm = 5\nregime = "VI"\n', 3, "load.regime: must be '0', 'I'"),
            (
                "[load]\ntension_N = 5000\nspeed_rpm = 5\nduty_bins = [4, 4]\n",
                3,
                "load.duty_bins: belongs to duty_file",
            ),
            *(
                (f'[load]\nduty_file = "log.csv"\nduty_bins = {bins}\n', 2, "load.duty_bins: must be two")
                for bins in ("[20]", "[0, 8]", "[1.0, 8]", "20", "[101, 8]", "[true, 8]")
            ),
        ],
    )
    def test_of_load(self, faults, load, line, words):
        found = faults(load, log_text("0,1,1", "1,1,1"))
        assert [(number, message) for number, message in found if re.match(words, message)], found
        assert len(found) == 1
        assert found[0][0] == (FIRST + line if load else 0)

    @pytest.mark.parametrize(
        ("log", "words"),
        [
            (log_text("0,1000,60", "10,1000,60", "10,1000,60"), "log.csv:4: time_s must increase"),
            (log_text("0,1000,60", "10,1000,60", "5,1000,60"), "log.csv:4: time_s must increase"),
            (
                log_text("0,-5,60", "1,-6,60", "2,1,60"),
                "log.csv: tension_N .* in some row.*reverse its signs",
            ),
            (log_text("0,1000,0", "1,5,0", "2,1,60"), "log.csv: speed_rpm must not be 0 in every row"),
            (log_text("0,1000,60", "1,,60", "2,1,60"), "log.csv:3: tension_N must be a finite number"),
            (log_text("0,1000,60", "1,1000", "2,1,60"), "log.csv:3: needs 3 values, has 2"),
            (log_text("0,1e9,60", "1,1000,60"), "log.csv:2: tension_N must keep the pull below .* tensile"),
            (log_text("0,0,60", "1,0,60"), "log.csv: tension_N must be above 0 in some row"),
            (log_text("0,1000,60"), "log.csv: needs at least 2 rows, has 1"),
            (
                log_text("0,1,1,1", "1,1,1,1", head="time_s,tension_N,speed_rpm,torque"),
                "log.csv:1: unknown column 'torque'",
            ),
            (log_text("0,1", "1,1", head="time_s,tension_N"), "log.csv:1: column 'speed_rpm' is missing"),
            (
                log_text("0,1", "1,1", head="time_s,speed_rpm"),
                "log.csv:1: column 'tension_N' is missing, or torque_N_m or power_kW or power_W in its place",
            ),
            (
                log_text("0,1,1,1", "1,1,1,1", head="time_s,torque_N_m,power_kW,speed_rpm"),
                r"log.csv:1: only one column may give this \(got torque_N_m and power_kW\): keep one",
            ),
            (
                log_text("0,1,1,1", "1,1,1,1", head="time_s,secs,power_kW,speed_rpm"),
                r"log.csv:1: only one column may give this \(got time_s and secs\)",
            ),
        ],
    )
    def test_of_a_log(self, faults, log, words):
        found = faults('[load]\nduty_file = "log.csv"\n', log)
        assert [line for line, _ in found] == [FIRST + 1]
        assert re.match(f"load.duty_file: {words}", found[0][1])

    def test_of_a_log_that_is_not_there(self, faults):
        ((_, message),) = faults('[load]\nduty_file = "no.csv"\n')
        assert "must be readable CSV" in message

    @pytest.mark.parametrize(
        ("load", "key"),
        [
            ('[load]\nspeed_rpm = 100\ntension_N = 50\nregime = "I"\n', "load.regime"),
            ('[load]\nduty_file = "log.csv"\n', "load.duty_file"),
            (GOOD, "duty"),
        ],
    )
    def test_of_a_duty_with_a_table_of_loads(self, faults, load, key):
        mechanism = "mechanism={kind='prescribed',table_file='none.csv'}"
        found = faults(load, overrides=[mechanism])
        assert any(message.startswith(f"{key}: a table of loads") for _, message in found)

    def test_of_a_block_below_the_slack_tension(self, faults):
        more = blocks((0.5, 5000, 100), (0.5, 900, 100))
        ((line, message),) = faults(more, overrides=[*CUT, f"drive={DRIVE}"])
        assert line == FIRST + 6
        assert "duty.2.tension_N: the tight strand must pull more than the slack one, 1 000 N" in message

    def test_of_a_log_that_never_pulls(self, faults):
        log = log_text("0,900,60", "1,900,60")
        ((_, message),) = faults('[load]\nduty_file = "log.csv"\n', log, [*CUT, f"drive={DRIVE}"])
        assert "load.duty_file: the tight strand must pull more" in message
