"""compare with a case that fails: the rest is written and the exit code says so."""

from wearsim.command.options import FAILED, SOME_FAILED

COARSE = """
[run]
method = "per_cycle"
cycles_per_update = 1000000
"""
MINIMAL = """\
format_version = 1
[chain]
designation = "16B-1"
[sprocket]
teeth = 20
profile = "evolute"
[load]
power_kW = 3
speed_rpm = 100
[wear]
condition = "hardened, oiled"
"""


def test_the_rest_is_written(cli, tmp_path):
    good, bad = tmp_path / "good.toml", tmp_path / "bad.toml"
    good.write_text(MINIMAL, "utf-8")
    bad.write_text(MINIMAL + COARSE, "utf-8")
    done = cli("compare", good, bad, "--out", tmp_path / "out")
    assert done.code == SOME_FAILED
    assert "bad.toml" in done.err
    assert "cycles_per_update" in done.err
    assert len((tmp_path / "out" / "summary.csv").read_text("utf-8").splitlines()) == 2


def test_nothing_is_written_where_all_fail(cli, tmp_path):
    bad = tmp_path / "bad.toml"
    bad.write_text(MINIMAL + COARSE, "utf-8")
    done = cli("compare", bad, "--out", tmp_path / "out")
    assert done.code == FAILED
    assert not (tmp_path / "out").exists()
