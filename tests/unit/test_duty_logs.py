"""Logs with stops, other columns of the load, loads on the other flank, and the same on whole drives."""

import itertools

import pytest

from wearsim.drive.load_case import load_case, load_drive
from wearsim.drive.part_life import simulate
from wearsim.errors import CaseError

STRAND = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "nodes": 51},
    "wear": {"condition": "hardened, oiled"},
    "stop": {"critical_depth_mm": 0.01},
}
WRAP = {
    "format_version": 1,
    "chain": {"designation": "ANSI 40"},
    "sprocket": {"teeth": 19, "profile": "ansi_b29", "nodes": 51},
    "mechanism": {"phases": 2},
    "drive": {"slack_tension_N": 40.0, "mate_teeth": 38, "links": 110},
    "joint": {"specific_wear_rate_mm2_per_N": 1e-10},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-9},
    "stop": {"critical_depth_mm": 0.01},
    "run": {"life_tolerance": 0.1, "horizon_hours": 1e6},
}
RADIUS = 19 * 12.7 / (2.0 * 3.141592653589793)
"""Of a driver of 19 teeth [mm]: a torque is the difference of the tensions times this."""


def cog(teeth, **keys):
    return {"teeth": teeth, "profile": "ansi_b29", "nodes": 51, **keys}


TWO = {**WRAP, "sprocket": [cog(19), cog(38)], "drive": {"slack_tension_N": 40.0, "links": 110}}
PLACED = {
    **WRAP,
    "sprocket": [
        cog(19, name="motor", position_mm=[0, 0]),
        cog(19, name="pump", position_mm=[300, 0], power_share=0.6),
        cog(19, name="fan", position_mm=[150, 250], power_share=0.4, take_up={"guide_deg": 90}),
    ],
    "drive": {"slack_tension_N": 40.0},
}


@pytest.fixture
def logged(tmp_path):
    """Function that returns the load of a log with these rows: time, load and speed."""
    number = itertools.count()

    def load(*rows, head="time_s,tension_N,speed_rpm", **keys):
        path = tmp_path / f"log{next(number)}.csv"
        text = "\n".join([head, *(",".join(map(repr, row)) for row in rows)])
        path.write_text(f"{text}\n", encoding="utf-8")
        return {"load": {"duty_file": str(path), **keys}}

    return load


def blocks(case):
    """Share, tension, speed and factors on the wear of teeth and joints of every block, in order."""
    return sorted(
        (block.share, block.tension, block.speed_rpm, block.wear_factor, block.joint_factor)
        for block in case.drive.blocks
    )


def same(one, other):
    """Whether two duties are alike to 1e-12."""
    found, expected = blocks(one), blocks(other)
    assert len(found) == len(expected)
    for row, of in zip(found, expected, strict=True):
        assert row == pytest.approx(of, rel=1e-12)
    assert one.speed_rpm == pytest.approx(other.speed_rpm, rel=1e-12)


def said(case, words):
    """What a case assumes about something."""
    (text,) = [text for text in case.assumptions if words in text]
    return text


def every_second(loads, start=0.0, step=1.0, speed=90):
    return [(start + step * i, load, speed) for i, load in enumerate(loads)]


MINUTE = [1000.0, 1000.0, 1000.0, 1000.0, 1000.0, 3000.0]


class TestStops:
    """Six samples and six seconds of standstill, ten times: the same whether the stop is there or cut out."""

    @staticmethod
    def cut(stop, step=1.0):
        rows = [
            row for i in range(10) for row in every_second(MINUTE, start=i * (6 * step + stop), step=step)
        ]
        return [*rows, (rows[-1][0] + step, 1.0, 90)]

    @pytest.mark.parametrize("step", [1.0, 0.1, 5.0])
    @pytest.mark.parametrize("samples", [1, 6, 9, 40, 5000])
    def test_rows_cut_out_are_a_stop(self, logged, step, samples):
        ahead = load_case({**STRAND, **logged(*self.cut(0.0, step))})
        same(load_case({**STRAND, **logged(*self.cut(samples * step, step))}), ahead)

    def test_hours_are_those_of_the_log_numbered_anew(self, logged):
        """The mean load is (5 * 1000 + 3000)/6 N; rows held through the stops would give 8/3 of it."""
        lives = [simulate(load_case({**STRAND, **logged(*self.cut(stop))})).life for stop in (0.0, 6.0)]
        (mean,) = [simulate(load_case({**STRAND, "load": {"tension_N": 8000 / 6, "speed_rpm": 90}})).life]
        assert lives[1].hours == pytest.approx(lives[0].hours, rel=1e-12)
        assert lives[1].hours == pytest.approx(mean.hours, rel=1e-6)

    def test_rows_of_standstill_are_a_stop(self, logged):
        rows = []
        for i in range(10):
            rows += every_second(MINUTE, start=12.0 * i)
            rows += every_second([250.0] * 6, start=12.0 * i + 6.0, speed=0)
        whole = load_case({**STRAND, **logged(*rows, (120.0, 0.0, 0))})
        same(whole, load_case({**STRAND, **logged(*self.cut(0.0))}))
        assert "stands still for 50 % of the time" in said(whole, "stands")
        assert "1000 running hours take 2000 h including stops" in said(whole, "stands")

    def test_it_says_what_is_taken_for_a_stop(self, logged):
        case = load_case({**STRAND, **logged(*self.cut(6.0))})
        assert "9 steps are much longer than the usual 1 s: the row before each counts" in said(
            case, "much longer"
        )
        assert "stands still for 47.4 % of the time" in said(case, "the drive stands")  # 54 of 114 s
        assert not case.warnings

    @pytest.mark.parametrize(("day", "words"), [(8, "take 16 h including the stops"), (16, "take 32 h")])
    def test_hours_of_a_day_are_running_hours(self, logged, day, words):
        rows = [(0, 1000.0, 90), (60, 0.0, 0), (120, 0.0, 0)]
        case = load_case({**STRAND, **logged(*rows), "service": {"hours_per_day": day}})
        (text,) = [
            text for text in (*case.assumptions, *case.warnings) if text.startswith("service.hours_per_day")
        ]
        assert words in text
        assert (text in case.warnings) == (day == 16)

    def test_a_log_of_changes_holds_every_row(self, logged):
        """10 s at 1000 N, 30 s at 3000 N and 60 rpm: 10, 30 turns."""
        rows = [(0, 1000.0, 60), (10, 3000.0, 60), (40, 1000.0, 60), (50, 3000.0, 60), (80, 0.0, 0)]
        case = load_case({**STRAND, **logged(*rows)})
        assert [row[:2] for row in blocks(case)] == [(0.25, 1000.0), (0.75, 3000.0)]
        assert not any("stands" in text for text in case.assumptions)

    def test_a_gap_in_a_log_of_changes_is_warned_of(self, logged):
        """Steps of 1, 2, 3 and 200 s: the last is 2.5 s of running."""
        rows = [(0, 1000.0, 60), (1, 3000.0, 60), (3, 1000.0, 60), (6, 3000.0, 60), (206, 0.0, 0)]
        case = load_case({**STRAND, **logged(*rows)})
        assert [row[0] for row in blocks(case)] == pytest.approx([4 / 8.5, 4.5 / 8.5])
        assert any("much longer than the usual 2.5 s" in text for text in case.warnings)


SPEEDS = 60.0, 150.0


class TestColumns:
    """Half of the time 40 N m at 60 rpm, half 10 N m at 150 rpm."""

    DUTY = tuple(
        {"share_of_time": 0.5, "torque_N_m": torque, "speed_rpm": speed}
        for torque, speed in zip((40.0, 10.0), SPEEDS, strict=True)
    )

    @staticmethod
    def loads(column):
        """Its values of a torque T: P = 2 pi n T/60."""
        powers = [
            2.0 * 3.141592653589793 * speed / 60.0 * torque
            for torque, speed in zip((40.0, 10.0), SPEEDS, strict=True)
        ]
        return {
            "torque_N_m": [40.0, 10.0],
            "power_W": powers,
            "power_kW": [1e-3 * power for power in powers],
            "watts": powers,
            "tension_N": [40.0 + 1e3 * torque / RADIUS for torque in (40.0, 10.0)],
        }[column]

    @pytest.mark.parametrize("column", ["torque_N_m", "power_W", "power_kW", "watts", "tension_N"])
    @pytest.mark.parametrize(("time", "second"), [("time_s", 1.0), ("time_hours", 1 / 3600), ("secs", 1.0)])
    @pytest.mark.parametrize("speed", ["speed_rpm", "cad"])
    def test_two_levels_are_two_blocks(self, logged, column, time, second, speed):
        first, then = self.loads(column)
        rows = (0.0, first, SPEEDS[0]), (60 * second, then, SPEEDS[1]), (120 * second, 0.0, 0.0)
        log = logged(*rows, head=f"{time},{column},{speed}")
        same(load_case({**WRAP, **log}), load_case({**WRAP, "duty": [*self.DUTY]}))

    def test_columns_in_any_order(self, logged):
        rows = (SPEEDS[0], 0.0, 40.0), (SPEEDS[1], 60.0, 10.0), (0.0, 120.0, 0.0)
        log = logged(*rows, head="speed_rpm,time_s,torque_N_m")
        same(load_case({**WRAP, **log}), load_case({**WRAP, "duty": [*self.DUTY]}))

    def test_a_torque_beyond_the_chain_names_its_row(self, logged):
        """13.8 kN of an ANSI 40 at a radius of 38.4 mm are 530 N m."""
        rows = (0, 40.0, 60), (60, 900.0, 60), (120, 0.0, 0)
        with pytest.raises(CaseError, match=r"\.csv:3: torque_N_m must keep the pull below"):
            load_case({**WRAP, **logged(*rows, head="time_s,torque_N_m,speed_rpm")})

    def test_a_log_of_another_shaft(self, logged):
        """A motor that turns three times as fast gives a third of the torque."""
        ahead = [(0.0, 40.0, 60.0), (60.0, 10.0, 150.0), (120.0, 0.0, 0.0)]
        motor = [(time, torque / 3.0, 3.0 * speed) for time, torque, speed in ahead]
        head = "time_s,torque_N_m,speed_rpm"
        log = logged(*motor, head=head, duty_speed_ratio=1 / 3)
        same(load_case({**WRAP, **log}), load_case({**WRAP, **logged(*ahead, head=head)}))


class TestOtherFlank:
    """A minute at 40 N m, then one at -25 N m, both at 90 rpm."""

    HEAD = "time_s,torque_N_m,speed_rpm"
    ROWS = (0, 40.0, 90), (60, -25.0, 90), (120, 0.0, 0)
    DUTY = tuple({"share_of_time": 0.5, "torque_N_m": torque, "speed_rpm": 90} for torque in (40.0, 25.0))

    @pytest.mark.parametrize(
        ("head", "rows"),
        [
            (HEAD, ROWS),
            (HEAD, ((0, 40.0, -90), (60, -25.0, -90), (120, 0.0, 0))),
            ("time_s,power_W,speed_rpm", ((0, 377.0, 90), (60, -235.6, 90), (120, 0.0, 0))),
            ("time_s,power_W,speed_rpm", ((0, 377.0, 90), (60, 235.6, -90), (120, 0.0, 0))),
            ("time_s,tension_N,speed_rpm", ((0, 1081.6, 90), (60, -691.0, 90), (120, 0.0, 0))),
        ],
    )
    def test_the_sign_of_the_torque_tells_the_flank(self, logged, head, rows):
        case = load_case({**WRAP, **logged(*rows, head=head)})
        found = {round(block.tension): (block.wear_factor, block.joint_factor) for block in case.drive.blocks}
        assert found == {1082: (1.0, 1.0), 691: (0.0, 1.0)}
        assert "for 50 % of the cycles the load is negative" in said(case, "negative")

    @pytest.mark.wide
    def test_joints_wear_in_full_and_the_flank_half(self, logged):
        """The chain of both blocks; the teeth as in the half of the cycles at 40 N m alone."""
        found = simulate(load_case({**WRAP, **logged(*self.ROWS, head=self.HEAD)}))
        both = simulate(load_case({**WRAP, "duty": [*self.DUTY]}))
        assert found.parts["chain"].hours == pytest.approx(both.parts["chain"].hours, rel=1e-12)
        assert found.parts["sprocket"].hours > 1.2 * both.parts["sprocket"].hours

    def test_the_flank_of_a_strand_wears_in_its_own_half(self, logged):
        rows = (0, 3000.0, 90), (60, -3500.0, 90), (120, 0.0, 0)
        case = load_case({**STRAND, **logged(*rows)})
        alone = simulate(load_case({**STRAND, "load": {"tension_N": 3000, "speed_rpm": 90}}))
        assert simulate(case).life.hours == pytest.approx(2.0 * alone.life.hours, rel=1e-9)
        assert any("do 1.17 times the work" in text for text in case.warnings)

    def test_pitting_counts_the_cycles_of_its_flank(self, logged):
        fatigue = {"sprocket": {"treatment": "surface_hardened", "hardness_HRC": 45.0}}
        rows = (0, 9000.0, 90), (60, -12000.0, 90), (120, 0.0, 0)
        lives = [
            simulate(load_case({**STRAND, "fatigue": fatigue, **load})).parts["sprocket_fatigue"]
            for load in (logged(*rows), {"load": {"tension_N": 9000, "speed_rpm": 90}})
        ]
        assert lives[0].hours == pytest.approx(2.0 * lives[1].hours, rel=1e-6)


class TestWholeDrives:
    HEAD = "time_s,torque_N_m,speed_rpm"
    ROWS = (0, 40.0, 60), (60, 10.0, 150), (120, 0.0, 0), (180, 0.0, 0)
    DUTY = TestColumns.DUTY

    @pytest.mark.parametrize("drive", [TWO, PLACED])
    def test_two_levels_are_two_blocks(self, logged, drive):
        log = load_drive({**drive, **logged(*self.ROWS, head=self.HEAD)})
        duty = load_drive({**drive, "duty": [*self.DUTY]})
        for one, other in zip(log.sprockets, duty.sprockets, strict=True):
            same(one.case, other.case)

    def test_tension_on_two(self, logged):
        rows = (0, 800.0, 200), (60, 400.0, 200), (120, 0.0, 0)
        duty = [{"share_of_time": 0.5, "tension_N": tension, "speed_rpm": 200} for tension in (800, 400)]
        found = [load_drive({**TWO, **tables}) for tables in (logged(*rows), {"duty": duty})]
        for one, other in zip(*(drive.sprockets for drive in found), strict=True):
            same(one.case, other.case)

    def test_cogs_of_a_cassette(self, logged):
        cassette = {
            "profile": "ansi_b29",
            "nodes": 51,
            "cog": [{"teeth": 19, "share_of_time": 0.25}, {"teeth": 17, "share_of_time": 0.75}],
        }
        drive = {**TWO, "sprocket": [cog(38), cassette]}
        log = load_drive({**drive, **logged(*self.ROWS, head=self.HEAD)})
        duty = load_drive({**drive, "duty": [*self.DUTY]})
        for one, other in zip(log.sprockets, duty.sprockets, strict=True):
            same(one.case, other.case)

    def test_tension_in_a_loop_of_places_is_refused(self, logged):
        with pytest.raises(CaseError, match=r"load.duty_file: each span has its own tension"):
            load_drive({**PLACED, **logged((0, 500.0, 90), (60, 0.0, 0))})

    def test_braking_swaps_the_spans_of_a_loop(self, logged):
        """F_t = T/R = 651 N: driving 40, 651 + 40 and between them 0.6 of it; braking the other way round."""
        rows = (0, 25.0, 90), (60, -25.0, 90), (120, 0.0, 0)
        drive = load_drive({**PLACED, **logged(*rows, head=self.HEAD)})
        pull = 25e3 / RADIUS
        ahead, braked = drive.driver.drive.blocks
        assert ahead.spans == pytest.approx((40.0, 40.0 + 0.6 * pull, 40.0 + pull))
        assert braked.spans == pytest.approx((40.0 + pull, 40.0 + 0.4 * pull, 40.0))
        assert (braked.pull, braked.wear_factor, braked.joint_factor) == (pytest.approx(pull), 0.0, 1.0)

    def test_a_sprung_take_up_that_braking_pushes_back_is_named(self, logged):
        """150 N hold the slack span, not one that pulls with 650 N."""
        fan = cog(19, name="fan", position_mm=[150, 250], power_share=0.4)
        sprung = {**fan, "take_up": {"guide_deg": 90, "tensioner_force_N": 150}}
        drive = {**PLACED, "sprocket": [*PLACED["sprocket"][:2], sprung], "drive": {}}
        with pytest.raises(CaseError, match=r"every span must be in tension.*negative loads of the log swap"):
            load_drive({**drive, **logged((0, 1.0, 90), (60, -25.0, 90), (120, 0.0, 0), head=self.HEAD)})

    def test_idling_in_a_loop(self, logged):
        rows = (0, 25.0, 90), (60, 0.0, 90), (120, 0.0, 0)
        drive = load_drive({**PLACED, **logged(*rows, head=self.HEAD)})
        assert sorted(block.tension for block in drive.driver.drive.blocks) == pytest.approx(
            [40.0, 40.0 + 25e3 / RADIUS]
        )
