"""A duty at the command line: faults at their line, hours of the whole of it, folders that run again."""

import json

import pytest

BLOCKS = """\
[[duty]]
share_of_time = 0.5
tension_N = 6000
speed_rpm = 50

[[duty]]
share_of_time = 0.5
power_kW = 2
speed_rpm = 150
"""
LOAD = "[load]\npower_kW = 3\nspeed_rpm = 100\n"
LOG = "time_s,tension_N,speed_rpm\n0,6000,50\n60,1600,150\n120,0,1\n"


@pytest.fixture
def case(drive, tmp_path):
    """Function that writes the drive with something in the place of its load, and a log."""

    def write(load, log=LOG):
        path = drive()
        text = path.read_text()
        assert LOAD in text
        path.write_text(text.replace(LOAD, load))
        (tmp_path / "log.csv").write_text(log)
        return path

    return write


def life(done):
    assert (done.code, done.err.count("Traceback")) == (0, 0)
    return json.loads(done.out)


def test_hours_are_those_of_the_whole_duty(cli, case):
    found = life(cli("life", case(BLOCKS), "--json"))
    assert found["speed_rpm"] == 100.0
    assert found["life_hours"] == pytest.approx(found["cycles_run"] / 6000, rel=1e-12)


def test_check_says_how_the_blocks_count(cli, case):
    done = cli("check", case(BLOCKS), "--explain")
    assert done.code == 0
    assert "speed 100 rpm is the time average of the duty" in done.out
    assert "that of the heaviest block" in done.out


def test_every_fault_of_the_blocks_with_its_line(cli, case):
    path = case(BLOCKS.replace("6000", "-6000").replace("= 150", "= 0"))
    lines = {number: text for number, text in enumerate(path.read_text().splitlines(), start=1) if text}
    done = cli("check", path)
    assert done.code == 2
    for wrong, key, least in (
        ("tension_N = -6000", "duty.1.tension_N", "greater than 0"),
        ("speed_rpm = 0", "duty.2.speed_rpm", "greater than or equal to 0.000001"),
    ):
        (number,) = [number for number, text in lines.items() if text == wrong]
        assert f"{path}:{number}: {key}: must be {least}" in done.err


def test_shares_that_do_not_sum_point_at_the_first_block(cli, case):
    path = case(BLOCKS.replace("share_of_time = 0.5", "share_of_time = 0.4", 1))
    number = path.read_text().splitlines().index("[[duty]]") + 1
    done = cli("life", path)
    assert done.code == 2
    assert f"{path}:{number}: duty: share_of_time of all blocks must sum to 1 (got 0.9)" in done.err


def test_fault_of_a_log_names_its_row(cli, case):
    path = case('[load]\nduty_file = "log.csv"\n', LOG.replace("60,1600,150", "60,1600,fast"))
    done = cli("check", path)
    assert done.code == 2
    assert "log.csv:3: speed_rpm must be a finite number (got 'fast')" in done.err


def test_log_of_two_states_is_the_duty_of_two_blocks(cli, case):
    log = life(cli("life", case('[load]\nduty_file = "log.csv"\n'), "--json"))
    blocks = life(cli("life", case(BLOCKS.replace("power_kW = 2", "tension_N = 1600")), "--json"))
    assert log["life_hours"] == pytest.approx(blocks["life_hours"], rel=1e-12)


def test_regime_at_the_command_line(cli, drive):
    """m = 1: the life is that of the mean load, half of the highest one in regime II."""
    path = drive()
    constant = life(cli("life", path, "--json"))
    regime = life(cli("life", path, "--json", "--set", "load.regime=II"))
    assert regime["life_hours"] == pytest.approx(2.0 * constant["life_hours"], rel=1e-6)


def test_block_at_the_command_line(cli, case):
    path = case("")
    duty = "duty=[{share_of_cycles=1.0,power_kW=3,speed_rpm=100}]"
    done = cli("life", path, "--json", "--set", duty)
    constant = life(cli("life", case(LOAD), "--json"))
    assert life(done)["life_hours"] == constant["life_hours"]


@pytest.mark.parametrize("load", [BLOCKS, '[load]\nduty_file = "log.csv"\nduty_bins = [3, 2]\n'])
def test_folder_runs_again(cli, case, load, tmp_path):
    first = life(cli("life", case(load), "--json", "--out", tmp_path / "run"))
    again = life(cli("life", tmp_path / "run" / "case.lock.toml", "--json"))
    assert again["cycles_run"] == first["cycles_run"]
    assert again["life_hours"] == first["life_hours"]
    assert (tmp_path / "run" / "inputs" / "log.csv").exists() == ("log.csv" in load)


DRIVE = """\
format_version = 1
[chain]
designation = "ANSI 40"
[[sprocket]]
teeth = 19
profile = "ansi_b29"
nodes = 51
[[sprocket]]
teeth = 38
profile = "ansi_b29"
nodes = 51
[mechanism]
phases = 2
[drive]
links = 110
[load]
duty_file = "brake.csv"
[wear]
condition = "hardened, oiled"
[run]
horizon_hours = 300
life_tolerance = 0.1
"""
BRAKED = "time_s,torque_N_m,speed_rpm\n0,40,600\n60,-20,600\n120,0,0\n180,0,0\n"


def test_log_of_a_whole_drive_is_told_kept_and_run_again(cli, tmp_path):
    """Of 180 s the drive stands for 60, of the cycles half are braked."""
    (tmp_path / "two.toml").write_text(DRIVE)
    (tmp_path / "brake.csv").write_text(BRAKED)
    first = cli("life", tmp_path / "two.toml", "--explain", "--out", tmp_path / "run")
    assert (first.code, first.err.count("Traceback")) == (0, 0)
    text = " ".join(first.out.split())
    assert "the drive stands still for 33.3 % of the time" in text
    assert "for 50 % of the cycles the load is negative" in text
    assert (tmp_path / "run" / "inputs" / "brake.csv").read_text() == BRAKED
    again = cli("life", tmp_path / "run" / "drive.lock.toml", "--json", "--out", tmp_path / "again")
    assert again.code == 0
    history = [(tmp_path / name / "history.csv").read_text() for name in ("run", "again")]
    assert history[0] == history[1]
