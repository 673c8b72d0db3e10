"""Every fault of an input file in one pass: place, key, what is wrong, what to do."""

import re

import pytest

from wearsim.drive.load_case import load_case
from wearsim.errors import CaseError

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


@pytest.fixture
def faults(tmp_path):
    """Faults of a case text, the path of the file cut to its name."""
    path = tmp_path / "drive.toml"

    def found(text, *overrides):
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        with pytest.raises(CaseError) as caught:
            load_case(path, overrides)
        return str(caught.value).replace(f"{tmp_path}/", "").splitlines()

    return found


def changed(*pairs):
    text = MINIMAL
    for old, new in pairs:
        assert old in text
        text = text.replace(old, new)
    return text


NOT_NUMBERS = {
    "true": "must be a number",
    "[1]": "must be a number",
    "{ a = 1 }": "must be a number",
    "2024-01-01": "must be a number",
    "nan": "must be a finite number (got nan)",
    "-inf": "must be a finite number (got -inf)",
    "1e400": "must be a finite number (got inf)",
    "1" + "0" * 400: "must be a finite number (got 1000",
    '"1e400 kW"': "must be a finite number",
    '"5"': "give a number without quotes, or with a unit such as '1 kW' (got '5')",
    '"5 mm"': "the unit must be convertible to kW (got '5 mm')",
    '"25 degC"': "the unit must be convertible to kW",
    '"3,5 kW"': "must be one number and its unit",
    '"much"': "must be one number and its unit",
    "0": "must be greater than 0 (got 0)",
    '"-5 kW"': "must be greater than 0 (got '-5 kW')",
}


@pytest.mark.parametrize("value", NOT_NUMBERS)
def test_numbers_are_strict(faults, value):
    (line,) = faults(changed(("power_kW = 3", f"power_kW = {value}")))
    assert line.startswith("drive.toml:8: load.power_kW: ")
    assert NOT_NUMBERS[value] in line


@pytest.mark.parametrize("value", ["20.0", "true", '"20"', "[20]", "nan", "1" + "0" * 400])
def test_whole_numbers_are_strict(faults, value):
    (line,) = faults(changed(("teeth = 20", f"teeth = {value}")))
    assert line.startswith("drive.toml:5: sprocket.teeth: must be ")


@pytest.mark.parametrize("value", ["2", "true", "1.0", '"1"'])
def test_other_format_versions(faults, value):
    got = value.replace('"', "'")
    assert faults(changed(("format_version = 1", f"format_version = {value}"))) == [
        f"drive.toml:1: format_version: must be 1 (got {got})"
    ]


def test_speed_in_hertz_is_refused(faults):
    (line,) = faults(changed(("speed_rpm = 100", 'speed_rpm = "2 Hz"')))
    assert line.startswith("drive.toml:9: load.speed_rpm: write a speed in rpm or rad/s")


def test_all_faults_of_all_tables_in_the_order_of_their_lines(faults):
    text = changed(
        ("format_version = 1\n", ""),
        ("teeth = 20", 'teeth = 20\npitch_mm = 3 # misplaced\nprofil = "evolute"'),
        ("speed_rpm = 100", "speed_rp = 100"),
        ("hardened, oiled", "hardened, oild"),
    )
    text += '[stop]\nmin_tip_land_mm = "x"\n[run]\nmethod = "advanced"\n[unheard]\na = 1\n'
    assert [line.partition(": ")[0::2] for line in faults(text)] == [
        ("drive.toml:5", "sprocket.pitch_mm: unknown key; did you mean 'chain.pitch_mm'?"),
        ("drive.toml:6", "sprocket.profil: unknown key; did you mean 'profile'?"),
        ("drive.toml:9", "load.speed_rpm: this key is required and missing"),
        ("drive.toml:10", "load.speed_rp: unknown key; did you mean 'speed_rpm'?"),
        (
            "drive.toml:12",
            "wear.condition: no such wear condition; did you mean 'hardened, oiled' or "
            "'hardened, dry' or 'hardened, greased'? (wearsim list wear-conditions shows them all) "
            "(got 'hardened, oild')",
        ),
        (
            "drive.toml:14",
            "stop.min_tip_land_mm: must be one number and its unit, such as '1.5 mm' (got 'x')",
        ),
        (
            "drive.toml:16",
            "run.method: must be 'advance' or 'per_cycle' (got 'advanced'); did you mean 'advance'?",
        ),
        ("drive.toml:18", "unheard: unknown table"),
        ("drive.toml", "format_version: this key is required and missing"),
    ]


def test_faults_across_tables_come_in_the_same_pass_as_wrong_keys(faults):
    text = changed(("speed_rpm = 100", "speed_rp = 100"), ("oiled", "olied"))
    text += '[mechanism]\ntable_file = "x.csv"\n[stop]\nmin_tip_land_mm = 500\n'
    places = [line.split(": ")[:2] for line in faults(text)]
    assert places == [
        ["drive.toml:8", "load.speed_rpm"],
        ["drive.toml:9", "load.speed_rp"],
        ["drive.toml:11", "wear.condition"],
        ["drive.toml:13", "mechanism.table_file"],
        ["drive.toml:15", "stop.min_tip_land_mm"],
    ]


def test_no_fault_follows_from_another(faults):
    """A chain that is not known must not lead to a sprocket that does not fit it."""
    text = changed(("16B-1", "16X"), ("teeth = 20", "teeth = 20\nface_width_mm = 30"))
    assert [line.split(": ")[1] for line in faults(text)] == ["chain.designation"]


FATIGUE_FAULTS = {
    "treatment = 'nitrided'\nhardness_HRC = 60": {"fatigue.sprocket.contact_limit_MPa": "needs this key"},
    "treatment = 'quenched_and_tempered'\nhardness_HB = 300\nhardness_HRC = 30": {
        "fatigue.sprocket.hardness_HB": "exactly one of hardness_HB and hardness_HRC (got both)"
    },
    "treatment = 'nitrided'": {
        "fatigue.sprocket.hardness_HB": "(got none)",
        "fatigue.sprocket.contact_limit_MPa": "needs this key",
    },
    "treatment = 'carburized'\nhardness_HRC = 60": {
        "fatigue.sprocket.treatment": "did you mean 'carburised'"
    },
}


@pytest.mark.parametrize("table", FATIGUE_FAULTS)
def test_faults_of_fatigue_hide_no_others(faults, table):
    text = MINIMAL + f"[stop]\nmin_tip_land_mm = 500\n[fatigue.sprocket]\n{table}\n"
    found = {line.split(": ")[1]: line for line in faults(text)}
    expected = {"stop.min_tip_land_mm": "below", **FATIGUE_FAULTS[table]}
    assert set(found) == set(expected)
    assert all(words in found[key] for key, words in expected.items())


@pytest.mark.parametrize(
    ("table", "key", "words"),
    [
        ("[fatigue]\nload_factor = 1.2", "fatigue.sprocket", "this table is required and missing"),
        (
            "[fatigue.sprocket]\ntreatment = 'carburised'\nhardness_HRC = 60\n"
            "[fatigue.pinion]\ntreatment = 'carburised'\nhardness_HRC = 60",
            "fatigue.pinion",
            "unknown table",
        ),
    ],
)
def test_tables_of_fatigue(faults, table, key, words):
    (line,) = faults(MINIMAL + table + "\n")
    assert line.split(": ")[1] == key
    assert words in line


def test_at_most_twenty_faults_and_a_count(faults):
    lines = faults(MINIMAL + "[run]\n" + "".join(f"zz{i} = 1\n" for i in range(25)))
    assert [line.split(":")[1] for line in lines[:-1]] == [str(13 + i) for i in range(20)]
    assert lines[-1] == "drive.toml: and 5 more"


def test_empty_file_names_every_required_part(faults):
    lines = faults("")
    missing = {line.split(": ")[1] for line in lines}
    assert missing == {"format_version", "chain", "sprocket", "load", "wear"}
    assert all("required and missing" in line for line in lines)


def test_keys_where_tables_belong(faults):
    text = 'format_version = 1\nchain = 5\nsprocket = "x"\nload = []\nwear = 2020-01-01\nrun = true\n'
    assert [line.split(" (got")[0] for line in faults(text)] == [
        f"drive.toml:{number}: {name}: must be a table"
        for number, name in enumerate(("chain", "sprocket", "load", "wear", "run"), start=2)
    ]


def test_arrays_of_tables(faults):
    text = changed(("[load]", "[[load]]"))
    assert faults(text)[0].startswith("drive.toml:7: load: must be a table (got [")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (MINIMAL + 'condition = "x"\n', "drive.toml:12: not valid TOML: Cannot overwrite"),
        (changed(("teeth = 20", "teeth =")), "drive.toml:5: not valid TOML: Invalid value"),
        (changed(("[load]", "[load")), "drive.toml:7: not valid TOML"),
        (changed(("teeth = 20", "teeth = 1" + "0" * 5000)), "drive.toml: not readable TOML"),
        (changed(("teeth = 20", "teeth = " + "[" * 5000)), "drive.toml: not readable TOML"),
        ('title = "é"'.encode("latin-1"), "drive.toml: must be UTF-8 text"),
        (MINIMAL.encode("utf-16"), "drive.toml: must be UTF-8 text"),
    ],
)
def test_what_is_no_toml(faults, text, expected):
    (line,) = faults(text)
    assert line.startswith(expected)


def test_byte_order_mark_and_windows_line_ends_are_no_fault(tmp_path, faults):
    path = tmp_path / "windows.toml"
    path.write_bytes(b"\xef\xbb\xbf" + MINIMAL.replace("\n", "\r\n").encode())
    assert load_case(path).drive.chain.designation == "16B-1"
    text = b"\xef\xbb\xbf" + changed(("teeth = 20", "teeth = 3")).replace("\n", "\r\n").encode()
    assert faults(text)[0].startswith("drive.toml:5: sprocket.teeth")


@pytest.mark.parametrize(("name", "reason"), [("none.toml", "No such file"), (".", "directory")])
def test_no_file(tmp_path, name, reason):
    with pytest.raises(CaseError, match=f"must be a readable file: .*{reason}"):
        load_case(tmp_path / name)


CONFLICTS = [
    (("[chain]", "[chain]\npitch_mm = 25.4"), "3", "chain.pitch_mm", "remove one of the two"),
    (('designation = "16B-1"', "pitch_mm = 25.4"), "3", "chain.roller_diameter_mm", "(missing: rol"),
    (
        ('designation = "16B-1"', "pitch_mm = 9\nroller_diameter_mm = 9\ninner_width_mm = 9"),
        "4",
        "chain.roller_diameter_mm",
        "must be smaller than the pitch of 9 mm",
    ),
    (("power_kW = 3", "power_kW = 3\ntorque_N_m = 5"), "9", "load.torque_N_m", "exactly one of"),
    (("power_kW = 3\n", ""), "8", "load.tension_N", "exactly one of"),
    (("power_kW = 3", "tension_N = 60e3"), "8", "load.tension_N", "tensile strength 60000 N"),
    (("[wear]", "[wear]\nhardness_MPa = 9"), "11", "wear.hardness_MPa", "law = 'archard'"),
    (("[wear]", '[wear]\nlaw = "power"'), "12", "wear.condition", "law = 'archard'"),
    (
        ("[wear]", "[wear]\nspecific_wear_rate_mm2_per_N = 1e-10"),
        "12",
        "wear.condition",
        "remove it or specific_wear_rate_mm2_per_N",
    ),
    (("[wear]", "[run]\ncycles_per_update = 2\n[wear]"), "11", "run.cycles_per_update", "per_cycle"),
    (
        ("[wear]", "[material.roller]\nname = 'steel'\npoissons_ratio = 0.3\n[wear]"),
        "12",
        "material.roller.poissons_ratio",
        "remove one of the two",
    ),
    (("[wear]", "[material.roller]\nname = 'steal'\n[wear]"), "11", "material.roller.name", "'steel'"),
    (("teeth = 20", "teeth = 20\nface_width_mm = 18"), "6", "sprocket.face_width_mm", "17.02 mm"),
    (("teeth = 20", "teeth = 20\ncontact_start_mm = 20"), "6", "sprocket.contact_start_mm", "ratio"),
    (("teeth = 20", "teeth = 20\nevolute_offset_mm = 2"), "6", "sprocket.evolute_offset_mm", "exit"),
    (("teeth = 20", "teeth = 20\npoints_file = 'a'"), "6", "sprocket.points_file", "'points'"),
    (("teeth = 20", "teeth = 20\nengaged_every = 0"), "6", "sprocket.engaged_every", "at least|great"),
    (("[wear]", "[mechanism]\nkind = 'prescribed'\n[wear]"), "11", "mechanism.table_file", "needs"),
    (("[wear]", "[stop]\nmin_tip_land_mm = 60\n[wear]"), "11", "stop.min_tip_land_mm", "below"),
    (("[wear]", "[run]\nlife_tolerance = 1\n[wear]"), "11", "run.life_tolerance", "less"),
]


@pytest.mark.parametrize(("change", "line", "key", "words"), CONFLICTS)
def test_checks_across_keys(faults, change, line, key, words):
    found = [entry for entry in faults(changed(change)) if entry.split(": ")[1] == key]
    assert [entry.split(": ")[0] for entry in found] == [f"drive.toml:{line}"]
    assert any(word in found[0] for word in words.split("|"))


@pytest.mark.parametrize(
    ("law", "missing"),
    [
        ("archard", {"specific_wear_rate_mm2_per_N"}),
        ("power", {"coefficient", "pressure_exponent"}),
        (
            "drozdov",
            {
                "coefficient",
                "pressure_exponent",
                "hardness_MPa",
                "reference_speed_mm_per_s",
                "speed_exponent",
            },
        ),
    ],
)
def test_every_law_names_what_it_lacks(faults, law, missing):
    lines = faults(changed(('condition = "hardened, oiled"', f'law = "{law}"')))
    assert {line.split(": ")[1] for line in lines} == {f"wear.{key}" for key in missing}
    assert all(line.startswith("drive.toml:11: ") for line in lines)


class TestOverrides:
    def test_value_is_toml_else_a_string(self, tmp_path):
        path = tmp_path / "drive.toml"
        path.write_text(MINIMAL)
        case = load_case(
            path, ["sprocket.teeth=25", "chain.designation = 12B-1", 'load.power_kW="2 kW"', "title=a b"]
        )
        assert case.inputs["sprocket"]["teeth"] == 25
        assert case.drive.chain.pitch == 19.05
        assert case.inputs["load"]["power_kW"] == 2.0
        assert case.title == "a b"

    def test_faults_point_at_the_override(self, faults):
        lines = faults(
            changed(("profile", "profil")), "sprocket.teeth=3", "load.power_kw=3", "chain.designation=16X"
        )
        places = [line.split(": ")[0] for line in lines]
        assert places[:2] == ["drive.toml:5", "drive.toml:6"]
        assert set(places[2:]) == {"--set sprocket.teeth", "--set load.power_kw", "--set chain.designation"}

    def test_override_of_a_whole_table(self, faults):
        (line,) = faults(MINIMAL, "chain={pitch_mm=25.4}")
        assert line.startswith("--set chain.roller_diameter_mm: ")

    def test_later_check_points_at_the_override(self, faults):
        (line,) = faults(MINIMAL, "sprocket.evolute_offset_mm=2")
        assert line.startswith("--set sprocket.evolute_offset_mm: exit clearance")

    @pytest.mark.parametrize("item", ["teeth", "=3", ""])
    def test_form(self, faults, item):
        assert "must have the form table.key=VALUE" in faults(MINIMAL, item)[0]

    def test_key_is_no_table(self, faults):
        (line,) = faults(MINIMAL, "chain.designation.x=1")
        assert line == "--set chain.designation.x: 'designation' is a key, not a table"


def test_mapping_is_left_as_it_was():
    tables = {
        "format_version": 1,
        "chain": {"designation": "16B-1"},
        "sprocket": {"teeth": 20, "profile": "evolute"},
        "load": {"power_kW": "3 kW", "speed_rpm": 100},
        "wear": {"condition": "hardened, oiled"},
    }
    load_case(tables, ["sprocket.teeth=21"])
    assert tables["sprocket"]["teeth"] == 20
    assert tables["load"]["power_kW"] == "3 kW"


@pytest.mark.parametrize(
    ("setting", "hint"),
    [
        ("load.tenson_N=3", "'tension_N'"),
        ("lod.tension_N=3", "'load'"),
        ("power_kW=3", "'load.power_kW' or 'duty.power_kW'"),
        ("drive.centre=800", "'centre_distance_mm'"),
    ],
)
def test_misspelt_override_names_the_key_that_is_meant(faults, setting, hint):
    (found,) = faults(MINIMAL, setting)
    assert found.endswith(f"; did you mean {hint}?")


def test_a_key_that_begins_another_one_is_taken_for_it(faults):
    """`share` is the share of time, though `power_share` is more like it letter by letter."""
    text = MINIMAL.split("[load]")[0] + "[[duty]]\nshare = 1.0\ntension_N = 300\nspeed_rpm = 100\n"
    assert any("duty.1.share: unknown key; did you mean 'share_of_time'?" in one for one in faults(text))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("power_kW = 3", "tension_N = 2,5", ":8: not valid TOML: .*: write decimals with a point, 2.5$"),
        (
            "power_kW = 3",
            'tension_N = "250 kg"',
            "the unit must be one of force, such as N or kN .got '250 kg'",
        ),
        ("evolute", "Evolvente", "'Evolvente'.; involutes are teeth of gears .*, not of sprockets$"),
        ("evolute", "evolut", "did you mean 'evolute'"),
        ("[wear]", "[drive]\nlinks = 90\n[wear]", "remove it, or set mechanism.kind = 'wrap'$"),
        (
            "[wear]",
            '[uncertainty]\n"load.power_kW" = {distribution = "lognormal", sigma = 0.5}\n[wear]',
            "uncertainty.load.power_kW.sigma: unknown key; did you mean 'sigma_ln'",
        ),
    ],
)
def test_common_slips_are_told_what_to_write(faults, old, new, said):
    found = faults(changed((old, new)))
    assert any(re.search(said, line) for line in found), found


def test_rate_of_another_unit_is_warned_of(tmp_path):
    """1e-7 mm3/(N m) is 1e-10 mm2/N; lubricated teeth wear at up to 1.5e-9, dry ones at up to 1e-7."""
    path = tmp_path / "drive.toml"

    def warnings(rate, more=""):
        path.write_text(
            changed(('condition = "hardened, oiled"', f"specific_wear_rate_mm2_per_N = {rate}")) + more
        )
        return load_case(path).warnings

    (warning,) = warnings("1e-7")
    assert "1e-07 mm^3/(N*m) is 1e-10 mm2/N, so check the unit" in warning
    assert not warnings('"1e-7 mm^3/(N*m)"') + warnings("1.5e-8")
    assert not warnings("1e-7", '[lubrication]\nlubricant = "dry"\n')
