"""Every command on every kind of shipped case: an answer, or a reason that is named."""

import shutil
from pathlib import Path

import pytest

pytestmark = pytest.mark.wide

CASES = Path(__file__).parents[2] / "cases"
COARSE = ("run.life_tolerance=0.1", "run.horizon_hours=20")
WRAP = ("sprocket.nodes=61", "mechanism.phases=1", *COARSE)


def _of_wheels(count: int) -> tuple[str, ...]:
    return (*(f"sprocket.{number}.nodes=61" for number in range(1, count + 1)), "mechanism.phases=1", *COARSE)


KINDS = {
    "strand": ("16b-20t-oiled.toml", ("sprocket.nodes=51", *COARSE)),
    "wrap": ("08b-19t-wrap.toml", WRAP),
    "gears": ("fzg-c14-16t-mild.toml", ("gear.nodes=61", *COARSE)),
    "table": ("hertz-arc-prescribed.toml", COARSE),
    "drive": ("drives/packaging-conveyor.toml", _of_wheels(2)),
    "loop": ("drives/camshaft-loop.toml", _of_wheels(3)),
    "cassette": ("drives/bicycle-cassette.toml", _of_wheels(2)),
}
"""A shipped case of each kind, coarse and short."""

AGES = ("--set", "lubrication.lasts_hours=50", "--set", "lubrication.dry_factor=4")
COMMANDS = {
    "check": (),
    "life": (),
    "life --verify-grid": (),
    "compare": (),
    "report": ("--out", "out"),
    "loads": (),
    "profile": (),
    "export": ("--out", "out.d", "--format", "dxf"),
    "animate": ("--frames", "2", "--width", "320", "--out", "out.gif"),
    "maintain": (),
    "lubricate": AGES,
    "remaining --hours 10 --depth-mm 0.0005 --reading-error-mm 0.0001": (),
    "remaining --hours 10 --elongation 0.3": (),
    "uncertainty --samples 2 --threads 1": (),
    "sensitivity --dry-run --threads 1": (),
    "remaining readings.csv": (),
    "sweep --threads 1": (),
    "optimise --evaluations 10 --threads 1": (),
}

SPEEDS = {"loop": (2400, 2500)}
"""Speeds that studies try; 50 and 60 rpm where nothing is said."""

OPTIMISE = "[optimise]\n[optimise.parameters]\n'load.speed_rpm' = {{low = {0}, high = {1}}}\n"
STUDY = 'format_version = 1\ncase = "{case}"\n[grid]\n"load.speed_rpm" = [{0}, {1}]\n'
READINGS = "time_hours,quantity,value,error\n10,elongation_percent,0.3,0.05\n"

NO_CHAIN = "needs a chain that wraps the sprocket"
REASONS = {
    **{("loads", kind): NO_CHAIN for kind in ("strand", "gears", "table")},
    **{("maintain", kind): NO_CHAIN for kind in ("strand", "gears", "table")},
    **{("remaining --hours 10 --elongation 0.3", kind): NO_CHAIN for kind in ("strand", "gears", "table")},
    **{("profile", kind): "nothing to write" for kind in ("gears", "table")},
    ("export", "table"): "must have a sprocket or gears to draw",
    **{
        (command, kind): "give --sprocket, one of "
        for command in ("profile", "animate")
        for kind in ("drive", "loop", "cassette")
    },
    **{
        (
            "remaining --hours 10 --depth-mm 0.0005 --reading-error-mm 0.0001",
            kind,
        ): "is read on the teeth of one sprocket"
        for kind in ("drive", "loop", "cassette")
    },
    **{
        ("remaining readings.csv", kind): "readings of a chain need one that wraps the sprocket"
        for kind in ("strand", "gears", "table")
    },
}
"""Why a command has no answer for a kind of case: exit code 2, and these words."""


LONG = {
    ("optimise --evaluations 10 --threads 1", "drive"),
    *((command, kind) for command in COMMANDS for kind in ("loop", "cassette") if "--threads" in command),
}
"""Cells that take too long for every change; `.ci/slow` runs them."""


@pytest.mark.parametrize(
    ("command", "kind"),
    [
        pytest.param(command, kind, marks=pytest.mark.slow if (command, kind) in LONG else ())
        for command in COMMANDS
        for kind in KINDS
    ],
)
def test_a_command_answers_or_names_its_reason(cli, tmp_path, monkeypatch, command, kind):
    monkeypatch.chdir(tmp_path)
    name, *options = command.split()
    case, settings = KINDS[kind]
    chosen = [word for setting in settings for word in ("--set", setting)]
    source, speeds = CASES / case, SPEEDS.get(kind, (50, 60))
    if name in ("optimise", "sweep"):
        source = shutil.copytree(CASES, tmp_path / "cases") / case
        source.write_text(source.read_text("utf-8") + OPTIMISE.format(*speeds), "utf-8")
    if name == "sweep":
        (tmp_path / "study.toml").write_text(STUDY.format(*speeds, case=source))
        source = tmp_path / "study.toml"
    (tmp_path / "readings.csv").write_text(READINGS)
    done = cli(name, source, *options, *COMMANDS[command], *chosen)
    reason = REASONS.get((command, kind))
    if reason is None:
        assert done.code == 0, done.err
    else:
        assert done.code == 2 and reason in done.err, done.err
