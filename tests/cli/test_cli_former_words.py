"""Words that input files had before are read, the numbers stay the same, and the answer says so."""

import json
from pathlib import Path

import pytest

CASES = Path(__file__).parents[2] / "cases"

LIVES = {
    "pr254-27t-greased": {"exploitation_factor": "joint_application_factor"},
    "convex-concave-17t-mild": {
        "pole_angle_deg": "pitch_point_angle_deg",
        "head_arc_radius_mm": "addendum_arc_radius_mm",
    },
    "constant-stress-36t-mild": {
        "first_pole_distance_mm": "first_pitch_point_distance_mm",
        "last_pole_distance_mm": "last_pitch_point_distance_mm",
    },
}
HANDBOOKS = {
    ("strength", "strength-a-tempered"): {"'improved'": "'quenched_and_tempered'"},
    ("strength", "strength-b-carburised"): {"cyclogram": "load_spectrum"},
    ("convex-concave", "convex-concave-17-34"): {
        "pole_angle_deg": "pitch_point_angle_deg",
        "head_arc_radius_mm": "addendum_arc_radius_mm",
    },
    ("synthesise", "synthesise-constant-stress"): {
        "first_pole_distance_mm": "first_pitch_point_distance_mm",
        "last_pole_distance_mm": "last_pitch_point_distance_mm",
    },
}


@pytest.fixture
def formerly(tmp_path):
    """Function from a shipped case and its words to the case as it was written before."""

    def write(case, words):
        text = case.read_text(encoding="utf-8")
        for old, new in words.items():
            old, new = (word.replace("'", '"') for word in (old, new))
            assert new in text
            text = text.replace(new, old)
        path = tmp_path / case.name
        path.write_text(text, encoding="utf-8")
        return path

    return write


def numbers(found):
    return {name: value for name, value in found.items() if name not in ("assumptions", "notes")}


@pytest.mark.parametrize(("case", "words"), LIVES.items(), ids=LIVES)
def test_lives_stay_and_say_so(cli, formerly, case, words):
    path, coarse = CASES / f"{case}.toml", ("--set", "run.horizon_hours=10", "--json")
    found, expected = (json.loads(cli("life", one, *coarse).out) for one in (formerly(path, words), path))
    assert numbers(found) == numbers(expected)
    for old, new in words.items():
        (note,) = [text for text in found["assumptions"] if f".{old} is read as" in text]
        assert note.endswith(f"is read as {new}: write that")
        assert not any("is read as" in text for text in expected["assumptions"])


@pytest.mark.parametrize(("case", "words"), HANDBOOKS.items(), ids=[name for _, name in HANDBOOKS])
def test_handbooks_stay_and_say_so(cli, formerly, case, words):
    command, name = case
    path = CASES / "sizing" / f"{name}.toml"
    old_path = formerly(path, words)
    found, expected = (json.loads(cli(command, one, "--json").out) for one in (old_path, path))
    assert numbers(found) == numbers(expected)
    assert "notes" not in expected
    shown = cli(command, old_path).err
    for old, new in words.items():
        notes = [text for text in found["notes"] if f"{old} is read as {new}: write that" in text]
        assert notes
        assert all(f"{old_path}: note: {text}\n" in shown for text in notes)


@pytest.mark.parametrize(
    ("table", "old", "new", "value"),
    [
        ("stress", "pole_distance_mm", "pitch_point_distance_mm", "[-20.0, 20.0]"),
        ("convex_concave", "foot_arc_radius_mm", "dedendum_arc_radius_mm", "12"),
    ],
)
def test_other_keys(cli, table, old, new, value):
    case = {"stress": "synthesise-constant-stress", "convex_concave": "convex-concave-17-34"}[table]
    command = case.rpartition("-")[0].rpartition("-")[0]
    more = ("--set", "stress.contact_stress_MPa=[454.0, 460.0]") if table == "stress" else ()
    path = CASES / "sizing" / f"{case}.toml"
    found, expected = (
        json.loads(cli(command, path, *more, "--set", f"{table}.{key}={value}", "--json").out)
        for key in (old, new)
    )
    assert "error" not in expected
    assert numbers(found) == numbers(expected)
    assert f"--set {table}.{old} is read as {table}.{new}: write that" in found["notes"]


def test_stress_of_a_life_at_distances(cli):
    path = CASES / "constant-stress-36t-mild.toml"
    settings = ("--set", "gear.contact_stress_MPa=[454, 460]", "--set", "run.horizon_hours=10", "--json")
    key = "gear.stress_pole_distance_mm"
    found = json.loads(cli("life", path, *settings, "--set", f"{key}=[-20, 20]").out)
    assert f"--set {key} is read as gear.stress_pitch_point_distance_mm: write that" in found["assumptions"]


def test_setting_with_the_former_word_counts(cli):
    path = CASES / "pr254-27t-greased.toml"
    found, expected = (
        cli("check", path, "--set", f"drive.{key}=1.4").out
        for key in ("exploitation_factor", "joint_application_factor")
    )
    assert "drive.exploitation_factor is read as" in " ".join(found.split())
    assert "joint application factor 1.4" in " ".join(expected.split())


@pytest.mark.parametrize("command", ["life", "check"])
def test_former_and_present_word_together_are_a_fault(cli, tmp_path, command):
    path = tmp_path / "pair.toml"
    text = (CASES / "convex-concave-17t-mild.toml").read_text(encoding="utf-8")
    path.write_text(text.replace("[gear]\n", "[gear]\npole_angle_deg = 20\n"), encoding="utf-8")
    line = 1 + path.read_text().splitlines().index("pitch_point_angle_deg = 20")
    done = cli(command, path)
    assert done.code == 2
    assert (
        f"{path}:{line}: gear.pitch_point_angle_deg: pole_angle_deg is what it was called before: remove "
        "one of both\n"
    ) in done.err


def test_both_words_in_a_handbook_are_a_fault(cli, tmp_path):
    path = tmp_path / "pair.toml"
    text = (CASES / "sizing" / "convex-concave-17-34.toml").read_text(encoding="utf-8")
    path.write_text(text.replace("addendum_arc", "head_arc_radius_mm = 9\naddendum_arc"), encoding="utf-8")
    done = cli("convex-concave", path)
    assert done.code == 2
    assert "head_arc_radius_mm is what it was called before" in done.err


def test_fault_stands_at_the_line_of_the_former_word(cli, formerly):
    path = formerly(CASES / "convex-concave-17t-mild.toml", LIVES["convex-concave-17t-mild"])
    lines = path.read_text(encoding="utf-8").replace("pole_angle_deg = 20", "pole_angle_deg = 90")
    path.write_text(lines, encoding="utf-8")
    line = 1 + lines.splitlines().index("pole_angle_deg = 90")
    done = cli("check", path)
    assert f"{path}:{line}: gear.pitch_point_angle_deg: must be" in done.err


def test_what_scatters_may_have_the_former_word(cli, formerly):
    words = LIVES["convex-concave-17t-mild"]
    path = formerly(CASES / "convex-concave-17t-mild.toml", words)
    with path.open("a", encoding="utf-8") as file:
        file.write(
            '\n[uncertainty]\n"gear.pole_angle_deg" = {distribution = "uniform", low = 20, high = 21}\n'
        )
    done = cli("check", path)
    assert done.code == 0, done.err
    assert "gear.pole_angle_deg is read as gear.pitch_point_angle_deg" in " ".join(done.out.split())


def test_schema_shows_no_former_word(cli):
    for of in ("case", "gear", "strength", "convex-concave", "synthesise"):
        text = cli("schema", *(() if of == "case" else ("--of", of))).out
        for word in ("improved", "yclogram", "exploitation", "pole_", "head_arc", "foot_arc"):
            assert word not in text
