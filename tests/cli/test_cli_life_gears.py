"""``wearsim life`` on a gear pair, and what other commands say to one."""

import json

import pytest

GEARS = """\
format_version = 1
title = "Test gears"
[gear]
pinion_teeth = 19
wheel_teeth = 61
module_mm = 3
face_width_mm = 30
nodes = 61
[load]
torque_N_m = 100
speed_rpm = 1450
[wear]
specific_wear_rate_mm2_per_N = 1e-11
[stop]
critical_depth_mm = 0.02
"""


@pytest.fixture
def gears(tmp_path):
    """Function that writes the case, with lines replaced, and returns its path."""

    def write(**replaced):
        text = GEARS
        for key, value in replaced.items():
            (line,) = [line for line in text.splitlines() if line.startswith(f"{key} = ")]
            text = text.replace(line, f"{key} = {value}")
        path = tmp_path / "gears.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_life_in_words(cli, gears):
    done = cli("life", gears(), "--explain")
    assert done.code == 0
    assert done.out.startswith("Test gears\n  Life ")
    assert "wheel_critical_depth_mm" in done.out
    assert "every tooth meets every tooth of its mate (hunting)" in " ".join(done.out.split())
    assert "pair_stiffness_N_per_mm_um = 14" in " ".join(done.out.split())


@pytest.mark.wide
def test_life_as_json_and_as_files(cli, gears, tmp_path):
    done = cli("life", gears(), "--json", "--out", tmp_path / "run")
    content = json.loads(done.out)
    assert content["life_reached"] is True
    assert content["stop"] in ("critical_depth_mm", "wheel_critical_depth_mm")
    head = (tmp_path / "run" / "flank.csv").read_text().splitlines()[0]
    assert head.endswith("path_mm,wheel_x_mm,wheel_y_mm,wheel_depth_mm")
    again = cli("compare", tmp_path / "run", gears(torque_N_m=50), "--out", tmp_path / "both")
    assert again.code == 0
    assert (tmp_path / "both" / "flanks.svg").exists()


def test_twice_the_speed_is_half_the_life(cli, gears):
    lives = [
        json.loads(cli("life", gears(speed_rpm=speed), "--json").out)["life_hours"] for speed in (725, 1450)
    ]
    assert lives[0] == pytest.approx(2.0 * lives[1], rel=1e-12)


def test_required_hours_and_solving_for_a_key(cli, gears):
    assert cli("life", gears(), "--require-hours", "1e5").code == 4
    done = cli("life", gears(), "--require-hours", "5000", "--solve-for", "load.torque_N_m")
    assert done.code == 0
    assert "load.torque_N_m" in done.out


def test_grid_of_gears_is_verified(cli, gears):
    done = cli("life", gears(), "--verify-grid")
    assert done.code == 0
    assert "Grid" in done.out


@pytest.mark.parametrize(
    ("replaced", "said"),
    [
        ({"pinion_teeth": 4}, "gears.toml:4: gear.pinion_teeth"),
        ({"module_mm": '"3 s"'}, "gears.toml:6: gear.module_mm"),
        ({"wheel_teeth": 6}, "gears.toml:4: gear: the path of contact ends"),
        ({"specific_wear_rate_mm2_per_N": -1}, "wear.specific_wear_rate_mm2_per_N"),
    ],
)
def test_bad_input(cli, gears, replaced, said):
    done = cli("life", gears(**replaced))
    assert done.code == 2
    assert said in done.err
    assert "Traceback" not in done.err


def test_check_knows_gears(cli, gears):
    done = cli("check", gears(), "--explain")
    assert done.code == 0
    assert "assumes  gear.pinion_tip_radius_mm = 31.5" in done.out


@pytest.mark.parametrize("command", ["loads", "profile", "maintain"])
def test_commands_of_chains_refuse_gears(cli, gears, command):
    done = cli(command, gears())
    assert done.code == 2
    assert "mechanism.kind" in done.err


def test_remaining_life_of_a_worn_pinion(cli, gears):
    reading = ("--hours", "100", "--depth-mm", "0.01", "--reading-error-mm", "0.001")
    done = cli("remaining", gears(), *reading)
    assert done.code == 0
    assert "100 h" in done.out
