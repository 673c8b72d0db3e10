"""``wearsim init``: a commented case that works."""

import tomllib
from itertools import pairwise
from pathlib import Path

import pytest
from click.testing import CliRunner

from wearsim.chain.joint_pressure import joint_application_factor
from wearsim.chain.power_rating import application_factor
from wearsim.chain.service_conditions import plain_word
from wearsim.cli.main import wearsim_command
from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_drive
from wearsim.mechanisms.wrap.drive import supply_in_words

pytestmark = pytest.mark.wide

STRAND = Path(__file__).with_name("strand_start.toml")
EXAMPLE = {
    "--chain": "12B-1",
    "--driver": "21",
    "--driven": "57",
    "--power": "3 kW",
    "--rpm": "120",
    "--centre": "800",
    "--lubrication": "drip",
    "--hours-per-day": "16",
    "--shock": "moderate",
}


def words(options):
    return [word for pair in options.items() for word in pair]


@pytest.fixture
def start(cli, tmp_path):
    """Function that writes a whole drive and loads it."""

    def write(**options):
        path = tmp_path / "drive.toml"
        given = {f"--{name.replace('_', '-')}": value for name, value in options.items()}
        done = cli("init", *words(given), "--out", path, "--force")
        assert (done.code, done.out, done.err) == (0, "", "")
        return load_drive(path)

    return write


@pytest.fixture
def asked(monkeypatch):
    """Function that answers the questions of a terminal."""
    monkeypatch.setattr("wearsim.cli.init.at_terminal", lambda: True)

    def answer(*lines, options=()):
        return CliRunner().invoke(wearsim_command, ["init", *options], input="\n".join([*lines, ""]))

    return answer


def test_a_drive_is_what_is_known_of_it(cli, tmp_path):
    path = tmp_path / "drive.toml"
    done = cli("init", *words(EXAMPLE), "--out", path)
    assert (done.code, done.out, done.err) == (0, "", "")
    drive = load_drive(path)
    assert drive.title == "12B-1, 21 to 57 teeth"
    assert [one.case.inputs["sprocket"]["teeth"] for one in drive.sprockets] == [21, 57]
    assert [one.case.inputs["sprocket"]["profile"] for one in drive.sprockets] == ["iso606", "iso606"]
    assert [one.case.inputs["sprocket"]["nodes"] for one in drive.sprockets] == [201, 201]
    case = drive.driver.case
    assert case.inputs["chain"]["designation"] == "12B-1"
    assert case.inputs["load"] == {"power_kW": 3.0, "speed_rpm": 120.0}
    assert case.inputs["drive"]["centre_distance_mm"] == 800.0
    assert case.inputs["wear"]["condition"] == "hardened, oiled"
    assert case.inputs["service"] == {"hours_per_day": 16.0}
    assert case.drive.service_factor == application_factor("smooth", "moderate shocks") == 1.4
    factor = joint_application_factor("moderate shocks", "drip", "two")
    assert case.drive.joint_application_factor == factor == pytest.approx(1.35 * 1.25)
    assert case.inputs["run"]["horizon_hours"] == min(100.0 * 365.25 * 16.0, 70_000.0)
    assert f"{case.drive.layout.links} links" in path.read_text()
    assert "after 100 years of service" in path.read_text()
    checked = cli("check", path)
    assert checked.code == 0
    # This drive is overloaded; nothing else is doubtful.
    warnings = [line for line in checked.out.splitlines() if line.startswith("  warning")]
    assert all("outside a rating" in line for line in warnings)


@pytest.mark.parametrize(
    ("options", "table", "key", "value"),
    [
        ({"chain": "#40"}, "chain", "designation", "ANSI 40"),
        ({"driver": "23"}, "sprocket", "teeth", 23),
        ({"driven": "38"}, "drive", "mate_teeth", 38),
        ({"rpm": "77"}, "load", "speed_rpm", 77.0),
        ({"rpm": "1.5 rev/s"}, "load", "speed_rpm", 90.0),
        ({"power": "1.25"}, "load", "power_kW", 1.25),
        ({"power": "1250 W"}, "load", "power_kW", 1.25),
        ({"power": "4 hp"}, "load", "power_kW", pytest.approx(4 * 0.745699872)),
        ({"centre": "1 m"}, "drive", "centre_distance_mm", 1000.0),
        ({"links": "140"}, "drive", "links", 140),
        ({"hours_per_day": "7.25"}, "service", "hours_per_day", 7.25),
        ({"hours_per_day": "90 min"}, "service", "hours_per_day", 1.5),
        ({"shock": "heavy"}, "drive", "service_factor", 1.8),
        ({"shock": "smooth"}, "drive", "service_factor", 1.0),
        ({"lubrication": "dry"}, "wear", "condition", "hardened, dry"),
        ({"lubrication": "dry"}, "lubrication", "lubricant", "dry"),
        ({"environment": "dust"}, "lubrication", "environment", "dust"),
        ({"tooth_hardness": "normalised"}, "wear", "condition", "normalised, oiled"),
    ],
)
def test_every_option_counts(start, options, table, key, value):
    assert start(**options).driver.case.inputs[table][key] == value


@pytest.mark.parametrize(
    ("word", "state", "condition"),
    [
        ("drip", "drip", "hardened, oiled"),
        ("oil-bath", "continuous", "hardened, oiled"),
        ("Oil bath", "continuous", "hardened, oiled"),
        ("forced", "continuous", "hardened, oiled"),
        ("continuous", "continuous", "hardened, oiled"),
        ("periodic", "periodic", "hardened, greased"),
        ("manual", "periodic", "hardened, greased"),
        ("grease", "periodic", "hardened, greased"),
        ("dry", "periodic", "hardened, dry"),
    ],
)
def test_lubrication_is_wear_and_a_factor(start, word, state, condition):
    drive = start(lubrication=word, shock="heavy").driver.case
    assert drive.inputs["wear"]["condition"] == condition
    assert supply_in_words(drive) == (plain_word(word), "clean")
    assert drive.lubrication.steady
    factor = joint_application_factor("heavy shocks", state, "one")
    assert drive.drive.joint_application_factor == pytest.approx(factor)


def test_supply_of_lubricant_leaves_the_hours(cli, tmp_path):
    """The same drive without [lubrication] lasts as long; it only cannot be held against its speed."""
    case = tomllib.loads(cli("init", *words(EXAMPLE | {"--lubrication": "dry", "--rpm": "400"})).out)
    case |= {"mechanism": {"phases": 1}, "run": {"life_tolerance": 0.1, "horizon_hours": 50}}
    for one in case["sprocket"]:
        one["nodes"] = 41
    without = {key: table for key, table in case.items() if key != "lubrication"}
    without["wear"] = {"condition": "hardened, dry"}
    found, silent = (drive_life(load_drive(tables)).complete() for tables in (case, without))
    assert found.parts == silent.parts
    assert found.warnings[0].startswith("lubrication 'dry', where 'oil bath' is recommended")
    assert any("outside a rating" in text for text in found.warnings[1:])


@pytest.mark.parametrize(
    ("hours", "shifts"), [("8", "one"), ("8.5", "two"), ("16", "two"), ("16.5", "three"), ("24", "three")]
)
def test_hours_are_shifts(start, hours, shifts):
    assert start(hours_per_day=hours).driver.case.drive.joint_application_factor == pytest.approx(
        joint_application_factor(shifts=shifts)
    )


@pytest.mark.parametrize(
    ("chain", "form"),
    [("16B-1", "iso606"), ("ANSI 40", "ansi_b29"), ("08A-1", "ansi_b29"), ("ПР-25,4-60", "gost591")],
)
def test_teeth_are_of_the_standard_of_the_chain(start, chain, form):
    drive = start(chain=chain)
    assert [one.case.inputs["sprocket"]["profile"] for one in drive.sprockets] == [form, form]
    assert drive.title == f"{chain}, 19 to 25 teeth"


@pytest.mark.parametrize("chain", ["05B-1", "08B-2", "12B-1", "ANSI 40", "16B-3", "ПР-38,1-127", "40B-1"])
@pytest.mark.parametrize("use", [{}, {"shock": "heavy", "hours_per_day": "24", "lubrication": "dry"}])
def test_a_drive_of_unknown_power_is_within_its_ratings(start, chain, use):
    case = start(chain=chain, **use).driver.case
    assert [finding for finding in case.drive.ratings(case) if not finding.ok] == []


def test_without_a_length_about_40_pitches(start):
    layout = start(chain="08B-1", driver="19", driven="57").driver.case.drive.layout
    assert layout.centre_distance / 12.7 == pytest.approx(40.0, abs=1.0)


@pytest.mark.parametrize("length", [{}, {"centre": "1003.7"}, {"links": "122"}])
@pytest.mark.parametrize("lubrication", ["oil-bath", "greased", "dry"])
@pytest.mark.parametrize("shock", ["smooth", "moderate", "heavy"])
def test_lines_are_short_and_explained(cli, length, lubrication, shock):
    options = EXAMPLE | {f"--{name}": value for name, value in length.items()}
    options |= {"--lubrication": lubrication, "--shock": shock, "--hours-per-day": "24", "--power": "4.5 hp"}
    if "links" in length:
        del options["--centre"]
    lines = cli("init", *words(options)).out.splitlines()
    assert max(map(len, lines)) <= 100
    for before, line in pairwise(lines):
        if " = " in line and not line.startswith("#"):
            assert "  # " in line or before.startswith("# "), line


def test_a_factor_beyond_the_handbooks_is_said(cli):
    said = "# It is above 3; handbooks advise another drive."
    dry = ("--lubrication", "dry", "--shock", "heavy")
    assert said in cli("init", *dry, "--hours-per-day", "16").out
    assert said not in cli("init", *dry, "--hours-per-day", "8").out


def test_commented_keys_of_a_drive_are_the_defaults(start, tmp_path):
    """With every comment of a key taken away both sprockets are what they were."""
    drive = start(**{name.removeprefix("--").replace("-", "_"): value for name, value in EXAMPLE.items()})
    lines = (tmp_path / "drive.toml").read_text().splitlines()
    keys = [line.removeprefix("# ") if line.startswith("# ") and " = " in line else line for line in lines]
    assert len([line for line in lines if line not in keys]) == 7
    (tmp_path / "bare.toml").write_text("\n".join(keys))
    bare = load_drive(tmp_path / "bare.toml")
    for before, after in zip(drive.sprockets, bare.sprockets, strict=True):
        assert after.name == before.name
        for table in ("sprocket", "drive", "stop", "run", "wear", "load"):
            assert after.case.inputs[table] == before.case.inputs[table]
    assert bare.driver.case.inputs["service"]["start_date"] == "2027-01-04"


@pytest.mark.parametrize("chain", ["#25", "ANSI 35", "41", "081", "084", "80H", "72B", "2ПР-25,4-114"])
def test_chains_that_had_no_mass(cli, tmp_path, chain):
    """A drive of each passes check, and takes the mass that its maker gives."""
    path = tmp_path / "drive.toml"
    name = "ANSI 41" if chain == "41" else chain
    assert cli("init", "--chain", name, "--driver", "24", "--driven", "24", "--out", path).code == 0
    assert cli("check", path).code == 0
    mass = load_drive(path).driver.case.drive.chain.mass_per_length
    heavier = 1.12e6 * mass
    given = path.read_text("utf-8").replace("[chain]", f"[chain]\nmass_kg_per_m = {heavier}", 1)
    path.write_text(given, "utf-8")
    assert load_drive(path).driver.case.drive.chain.mass_per_length == pytest.approx(1.12 * mass, rel=1e-9)


@pytest.mark.parametrize(
    ("option", "value", "message"),
    [
        ("--chain", "12C", "no such chain in the catalogue; did you mean '12B'"),
        ("--driver", "4", "must be a whole number from 5 to 1000 (got '4')"),
        ("--driver", "x", "must be a whole number"),
        ("--driven", "19.5", "must be a whole number"),
        ("--driven", "1001", "must be a whole number from 5 to 1000"),
        ("--power", "3 kg", "the unit must be convertible to kW (got '3 kg')"),
        ("--power", "lots", "must be one number and its unit, such as '1.5 kW' (got 'lots')"),
        ("--power", "3 kW*9**9**9**9", "unknown unit 'kW*9**9**9**9'"),
        (
            "--power",
            f"3 {1000 * 'k'}W",
            f"in at most 100 characters, has 1003: shorten it (got '3 {54 * 'k'}...)",
        ),
        ("--power", "0", "must be a number above 0 (got '0')"),
        ("--power", "nan", "must be a number above 0"),
        ("--power", "9000", "must stay below the chain's tensile strength 60000 N"),
        ("--rpm", "2 Hz", "write a speed in rpm or rad/s"),
        ("--rpm", "-120", "must be a number above 0 (got '-120')"),
        ("--rpm", "1e-9", "must be greater than or equal to 0.000001"),
        ("--centre", "50", "must not overlap"),
        ("--centre", "80 kg", "the unit must be convertible to mm"),
        ("--links", "9", "must be a whole number from 10 to 100000"),
        ("--lubrication", "dripp", "(got 'dripp'); did you mean 'drip'?"),
        ("--hours-per-day", "25", "must be a number above 0 and at most 24 (got '25')"),
        ("--shock", "some", "must be one of smooth, moderate, heavy (got 'some')"),
    ],
)
def test_what_cannot_be_known_of_a_drive(cli, tmp_path, option, value, message):
    path = tmp_path / "drive.toml"
    done = cli("init", option, value, "--out", path)
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith(f"{option}: ")
    assert message in done.err
    assert done.err.count("\n") == 1
    assert not path.exists()


def test_all_faults_at_once(cli):
    wrong = dict.fromkeys(EXAMPLE, "?")
    done = cli("init", *words(wrong))
    assert done.code == 2
    assert sorted(line.partition(":")[0] for line in done.err.splitlines()) == sorted(EXAMPLE)
    assert cli("init", "--links", "120", "--centre", "800").err.startswith(
        "--centre: links already gives this"
    )


def test_answers_of_a_terminal_are_options(asked, cli):
    order = ("chain", "driver", "driven", "rpm", "centre", "lubrication", "environment")
    order += ("tooth-hardness", "hours-per-day", "shock", "power")
    done = asked(*(EXAMPLE.get(f"--{name}", "") for name in order))
    assert done.exit_code == 0
    assert done.output.endswith(cli("init", *words(EXAMPLE)).out)
    for words_of_it in ("Speed of the driver in rpm [150]: ", "Running hours per day [8]: ", "Power in kW ["):
        assert words_of_it in done.output


def test_a_terminal_may_answer_nothing(asked, cli, monkeypatch):
    done = asked(*[""] * 11)
    assert done.exit_code == 0
    monkeypatch.setattr("wearsim.cli.init.at_terminal", lambda: False)
    assert done.output.endswith(cli("init").out)


def test_a_terminal_is_asked_again_for_what_cannot_be(asked, tmp_path):
    path = tmp_path / "asked.toml"
    answers = ("12C", "12B-1", "21", "57", "", "50", *[""] * 6, "900")
    done = asked(*answers, options=("--out", str(path)))
    assert done.exit_code == 0
    assert "Error: no such chain in the catalogue; did you mean '12B'" in done.output
    assert "--centre: drive layout: the sprockets must not overlap" in done.output
    assert done.output.count("Centre distance in mm") == 2
    assert load_drive(path).driver.case.inputs["drive"]["centre_distance_mm"] == 900.0


def test_a_terminal_that_knows_something_is_not_asked(asked):
    done = asked(options=("--driven", "38"))
    assert (done.exit_code, "[19]" in done.output) == (0, False)
    assert "\nteeth = 38 " in done.output


def test_nothing_is_asked_where_the_file_is_in_the_way(asked, tmp_path):
    path = tmp_path / "drive.toml"
    path.write_text("mine")
    done = asked(options=("--out", str(path)))
    assert "must not exist yet" in str(done.exception)
    assert (done.output, path.read_text()) == ("", "mine")


def test_options_of_a_drive_and_of_one_sprocket_exclude_each_other(cli):
    done = cli("init", "--teeth", "20", "--power", "3", "--shock", "heavy")
    assert done.code == 2
    assert [line.partition(": ")[0] for line in done.err.splitlines()] == ["--shock", "--power"]
    assert "--driver and --driven in place of --teeth" in done.err
    done = cli("init", "--kind", "drive", "--teeth", "20")
    assert done.code == 2
    assert done.err.startswith("--teeth: ")


def test_strand_is_what_it_was(cli):
    """Pinned: the case of one sprocket by its teeth alone, as before there were whole drives."""
    before = STRAND.read_text(encoding="utf-8")
    assert cli("init", "--kind", "strand").out == before
    assert cli("init", "--teeth", "20").out == before


def test_drive_lives(cli, start, tmp_path):
    start(chain="08B-1", driver="17", driven="20", power="1.3 kW", rpm="300", links="110")
    settings = ("sprocket.1.nodes=101", "sprocket.2.nodes=101", "run.horizon_hours=40000")
    set_all = [word for setting in settings for word in ("--set", setting)]
    done = cli("life", tmp_path / "drive.toml", "--set", "run.life_tolerance=0.1", *set_all)
    assert done.code == 0
    assert done.out.startswith("08B-1, 17 to 20 teeth\n")
    assert "\n  First      replace the chain at " in done.out


@pytest.mark.parametrize(
    ("chain", "teeth"),
    [("16B-1", 20), ("08B-1", 17), ("ANSI 40", 25), ("ПР-38,1-127", 18), ("72B-1", 60), ("05B-1", 40)],
)
def test_output_passes_check_and_lives(cli, tmp_path, chain, teeth):
    path = tmp_path / "drive.toml"
    done = cli("init", "--chain", chain, "--teeth", teeth, "--out", path)
    assert (done.code, done.out, done.err) == (0, "", "")
    text = path.read_text(encoding="utf-8")
    assert tomllib.loads(text)["sprocket"]["teeth"] == teeth
    assert tomllib.loads(text)["chain"]["designation"] == chain
    assert cli("check", path).code == 0
    assert cli("life", path).code == 0


def test_designation_is_written_as_in_the_catalogue(cli):
    text = cli("init", "--chain", "#40", "--kind", "wrap").out
    assert tomllib.loads(text)["chain"]["designation"] == "ANSI 40"
    assert tomllib.loads(text)["sprocket"]["profile"] == "ansi_b29"


def test_commented_keys_are_the_defaults(cli, tmp_path):
    """With every comment of a key taken away the case is still good, and its flank the same."""
    path, bare = tmp_path / "drive.toml", tmp_path / "bare.toml"
    cli("init", "--kind", "strand", "--out", path)
    lines = path.read_text().splitlines()
    keys = [line.removeprefix("# ") if line.startswith("# ") and " = " in line else line for line in lines]
    assert len([line for line in lines if line.startswith("# ") and " = " in line]) >= 6
    bare.write_text("\n".join(keys))
    assert cli("check", bare).code == 0
    assert cli("profile", bare).out == cli("profile", path).out


def test_stdout_by_default(cli, tmp_path):
    done = cli("init")
    assert done.code == 0
    path = tmp_path / "drive.toml"
    path.write_text(done.out)
    assert cli("check", path).code == 0


@pytest.mark.parametrize(
    ("options", "start", "words"),
    [
        (("--chain", "16Bx"), "--chain: no such chain", "did you mean '16B"),
        (("--teeth", "4"), "--teeth: must be ", "(got 4)"),
        (("--teeth", "7"), "--teeth: ", "try a shorter contact range"),
        (("--chain", "08B-1", "--teeth", "13"), "--teeth: ", "teeth = 14 will do"),
        (("--teeth", "many"), "Usage: ", "'--teeth'"),
    ],
)
def test_what_cannot_be(cli, options, start, words):
    done = cli("init", *options)
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith(start)
    assert words in done.err


def test_file_in_the_way(cli, tmp_path):
    path = tmp_path / "drive.toml"
    path.write_text("mine")
    done = cli("init", "--out", path)
    assert done.code == 2
    assert "--force" in done.err
    assert path.read_text() == "mine"
    assert cli("init", "--out", path, "--force").code == 0
    assert "format_version = 1" in path.read_text()


@pytest.mark.parametrize(
    ("chain", "form"), [("16B-1", "iso606"), ("ANSI 40", "ansi_b29"), ("ПР-25,4-60", "gost591")]
)
def test_wrap_case_is_one_of_the_chains_standard_and_loads(cli, tmp_path, chain, form):
    path = tmp_path / "wrap.toml"
    options = ("--kind", "wrap", "--chain", chain, "--teeth", "21", "--out", path)
    assert cli("init", *options).code == 0
    case = tomllib.loads(path.read_text(encoding="utf-8"))
    assert (case["mechanism"]["kind"], case["sprocket"]["profile"]) == ("wrap", form)
    assert cli("check", path).code == 0
    assert cli("loads", path).code == 0


@pytest.mark.parametrize("chain", ["06B-1", "08B-2", "12B-1", "40", "16B-3"])
@pytest.mark.parametrize("teeth", ["17", "25"])
def test_a_wrap_to_start_from_is_within_its_ratings(cli, tmp_path, chain, teeth):
    path = tmp_path / "drive.toml"
    cli("init", "--kind", "wrap", "--chain", chain, "--teeth", teeth, "--out", path)
    assert "OUTSIDE" not in cli("check", path).out
