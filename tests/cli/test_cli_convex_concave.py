"""``wearsim convex-concave``: text, JSON, files, faults, and every key of the input."""

import json
import math
import re
import tomllib
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from wearsim.files import check_folder
from wearsim.handbook.convex_concave.keys import ConvexConcaveTables
from wearsim.handbook.convex_concave.sheet import convex_concave_sheet
from wearsim.input.document import load_calculation
from wearsim.quantities import quantities

ROOT = Path(__file__).parents[2]
CASE = ROOT / "cases" / "sizing" / "convex-concave-17-34.toml"
FILES = [
    ".wearsim",
    "convex_concave.png",
    "convex_concave.svg",
    "flanks.csv",
    "pinion.dxf",
    "pinion.stl",
    "rack.csv",
    "result.json",
    "rollers.csv",
    "wheel.dxf",
    "wheel.stl",
]


def sheet(**changed):
    tables = tomllib.loads(CASE.read_text())
    for key, value in changed.items():
        table, _, name = key.rpartition("__")
        (tables[table] if table else tables)[name] = value
    read = load_calculation(tables, ConvexConcaveTables)
    return convex_concave_sheet(read.title, read.layout())


def test_text(cli):
    done = cli("handbook", "convex-concave", CASE)
    assert done.code == 0
    words = re.sub(r"\s+", " ", done.out)
    for part in (
        "teeth 17 34",
        "tip radius, mm 42.7500 81.0000",
        "pressure angle at the tip, deg 39.3188 39.7872",
        "tip thickness, mm 1.0242",
        "a pitch point 20.0000 0.0000 4.6770 -10.0853 7.2794 8.7215 8.7215",
        "b pitch point 20.0000 0.0000 -16.4111 5.6950",
        "ratio 1.0988 (0.5565 before the pitch point, 0.5423 after it); involute 1.5977",
        "radius 8.722 mm at the pitch point, as for the involute pair; best 35.5 mm at l = 6.616 mm",
        "(2) rho_1b < 0 holds (arc radius 10 mm, limit at the pitch point 17.97 mm)",
        "(5) rho_2b > 0 holds (for any arc)",
        "arc of 16.1837 mm about (14.9012, -6.2686) mm, deviation at most 0.0176 mm",
        "pinion 7.776 dedendum 20.3320 39.7185 86.8741 86.8737",
        "pinion 8 addendum 20.8222 39.9752 87.6094 87.6144",
    ):
        assert part in words, part
    assert max(map(len, done.out.splitlines())) <= 100
    assert done.out in (ROOT / "docs" / "convex-concave.md").read_text()
    assert done.err.count("lies below the tips of the pinion: a gauge cannot reach it") == 2


def names(value):
    if isinstance(value, dict):
        for name, below in value.items():
            yield name
            yield from names(below)
    elif isinstance(value, list):
        for below in value:
            yield from names(below)


def test_json(cli):
    done = cli("-q", "handbook", "convex-concave", CASE, "--json")
    content = json.loads(done.out)
    assert (done.code, done.err) == (0, "")
    assert (content["schema_version"], content["case"]) == (1, "convex-concave-17-34")
    assert content["contact_ratio"] == pytest.approx(1.0987962846, abs=5e-11)
    assert content["contacts"][0]["reduced_radius_mm"] == pytest.approx(8.7215136548, abs=5e-11)
    assert [one["holds"] for one in content["sign_conditions"]] == [True] * 4
    assert content["sign_conditions"][1]["arc_limit_mm"] is None
    assert set(names(content)) - set(quantities()) == set()


def test_files(cli, tmp_path):
    out = tmp_path / "pair"
    assert cli("handbook", "convex-concave", CASE, "--out", out).code == 0
    assert sorted(path.name for path in out.iterdir()) == FILES
    tables = {name: pd.read_csv(out / f"{name}.csv") for name in ("flanks", "rack", "rollers")}
    assert {column for table in tables.values() for column in table} - set(quantities()) == set()
    flanks = tables["flanks"]
    assert list(flanks.gear.unique()) == ["pinion", "wheel"]
    assert np.hypot(flanks.x_mm, flanks.y_mm).to_numpy() == pytest.approx(flanks.radius_mm)
    # Zone a is the pinion's head and the wheel's foot.
    assert {tuple(row) for row in flanks[["gear", "part", "zone"]].to_numpy()} == {
        ("pinion", "head", "a"),
        ("wheel", "foot", "a"),
        ("pinion", "foot", "b"),
        ("wheel", "head", "b"),
    }
    for _, half in flanks.groupby(["gear", "part"]):
        pitch_point = half[np.isclose(half.pressure_angle_deg, 20.0)]
        assert pitch_point.reduced_radius_mm.to_numpy() == pytest.approx([8.7215136548])
    # Feet are longer than what the mate's tip reaches.
    assert flanks[flanks.part == "foot"].reduced_radius_mm.isna().any()
    assert flanks[flanks.part == "head"].reduced_radius_mm.notna().all()
    assert tables["rack"].y_mm.iloc[[0, -1]].to_numpy() == pytest.approx([-4.5, 4.5])
    assert tables["rollers"].over_pins_mm[3] == pytest.approx(86.87407122, abs=5e-9)
    again = cli("handbook", "convex-concave", CASE, "--out", out)
    assert again.code == 2 and "must not exist yet" in again.err
    check_folder(out, force=True)


def heights(made, folder):
    """Of the corners of the wheel's solid."""
    made.files["wheel.stl"](folder / "wheel.stl")
    data = (folder / "wheel.stl").read_bytes()[84:]
    records = np.frombuffer(data, np.dtype([("v", "<f4", 12), ("a", "<u2")]))
    return set(records["v"][:, 3:].reshape(-1, 3)[:, 2])


def test_solid_has_the_face_width(tmp_path):
    assert heights(sheet(gears__face_width_mm=7), tmp_path) == {0.0, 7.0}


def test_zones_of_equal_gears():
    """Pinion and wheel alike: the same flank is in zone a on one and in zone b on the other."""
    flanks = sheet(convex_concave__wheel_teeth=17).tables()["flanks"]
    zones = flanks.groupby(["gear", "part"]).zone.unique().map(list).to_dict()
    assert zones[("pinion", "head")] == zones[("wheel", "foot")] == ["a"]
    assert zones[("pinion", "foot")] == zones[("wheel", "head")] == ["b"]


def test_backlash_is_in_the_flanks():
    flanks = sheet(convex_concave__backlash_mm=0.4).tables()["flanks"]
    pitch_point = flanks[np.isclose(flanks.radius_mm, 38.25)]
    assert np.arctan2(pitch_point.x_mm, pitch_point.y_mm).to_numpy() * 38.25 == pytest.approx(0.1)


FEW_TEETH = {
    "convex_concave__pinion_teeth": 11,
    "convex_concave__wheel_teeth": 12,
    "convex_concave__addendum_ratio": 0.7,
}


def found(folder, **changed):
    """Everything that a change may show in: the JSON, the flanks and a solid."""
    made = sheet(**{**FEW_TEETH, **changed})
    made.files["pinion.stl"](folder / "pinion.stl")
    solid = (folder / "pinion.stl").read_bytes()
    return json.dumps(made.content), made.tables()["flanks"].to_csv(), solid


CHANGED = {
    "title": "Another",
    "convex_concave__module_mm": "4.6 mm",
    "convex_concave__pinion_teeth": 12,
    "convex_concave__wheel_teeth": 13,
    "convex_concave__pitch_point_angle_deg": 21.0,
    "convex_concave__addendum_arc_radius_mm": 10.5,
    "convex_concave__dedendum_arc_radius_mm": 9.5,
    "convex_concave__addendum_ratio": 0.75,
    "convex_concave__backlash_mm": 0.05,
    "gears__face_width_mm": 46,
    "gears__root_form": "radial",
    "gears__root_clearance_ratio": 0.05,
    "gears__roller_diameters_mm": [7.7],
}


def test_every_key_is_changed():
    keys = {"title"}
    for name, field in ConvexConcaveTables.model_fields.items():
        if name not in ("title", "format_version"):
            keys |= {f"{name}__{key}" for key in field.annotation.model_fields}
    assert keys == set(CHANGED)
    assert {key.rpartition("__")[2] for key in keys} <= set(quantities())


@pytest.fixture(scope="module")
def unchanged(tmp_path_factory):
    return found(tmp_path_factory.mktemp("unchanged"))


@pytest.mark.parametrize("key", CHANGED)
def test_every_key_shows(unchanged, tmp_path, key):
    assert found(tmp_path, **{key: CHANGED[key]}) != unchanged


def test_defaults(tmp_path):
    plain = sheet(gears={})
    (pinion, wheel) = plain.content["rollers"]
    assert (pinion["gear"], wheel["gear"]) == ("pinion", "wheel")
    assert pinion["roller_mm"] == wheel["roller_mm"] == pytest.approx(1.728 * 4.5)
    assert heights(plain, tmp_path) == {0.0, 45.0}


@pytest.mark.parametrize(
    ("setting", "code", "message"),
    [
        ("convex_concave.module_mm=0", 2, "must be greater than 0"),
        ("convex_concave.pitch_point_angle_deg=45", 2, "must be less than 45"),
        ("convex_concave.pinion_teeth=4", 2, "must be greater than or equal to 5"),
        ("convex_concave.backlash_mm=-1", 2, "must be greater than or equal to 0"),
        ("convex_concave.arc=1", 2, "unknown key"),
        ("gears.root_form=filet", 2, "did you mean 'fillet'?"),
        ("gears.roller_diameters_mm=[]", 2, "must hold at least 1 value"),
        ("gears.root_clearance_ratio=-0.1", 2, "must be greater than or equal to 0"),
        ("gears.roller_diameters_mm=[2]", 3, "roller_diameters_mm: must be from 2.9711 to"),
        ("gears.root_clearance_ratio=0.25", 3, "root_clearance_ratio: must be at most 0.061 for"),
        ("convex_concave.addendum_arc_radius_mm=2", 3, "raise the radius of the arc"),
        ("convex_concave.addendum_ratio=1.4", 3, "tooth: its thickness at the tip must be above 0"),
    ],
)
def test_bad_input(cli, setting, code, message):
    done = cli("handbook", "convex-concave", CASE, "--set", setting)
    assert (done.code, done.out) == (code, "")
    assert message in done.err
    assert "Traceback" not in done.err


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (["convex_concave.addendum_ratio=0.8"], "the contact ratio is 0.9"),
        (
            ["convex_concave.dedendum_arc_radius_mm=20", "convex_concave.addendum_ratio=0.5"],
            "(2) rho_1b < 0 does not hold up to the end of contact: the dedendum is convex beyond 20 deg",
        ),
        (["gears.root_clearance_ratio=0"], "mm into the root of the pinion: raise"),
        (
            ["gears.roller_diameters_mm=[3.2]", "gears.root_clearance_ratio=0"],
            "the roller of 3.2 mm meets the root of the pinion",
        ),
    ],
)
def test_warnings(cli, settings, message):
    done = cli("handbook", "convex-concave", CASE, *(part for one in settings for part in ("--set", one)))
    assert done.code == 0
    assert message in done.err


def test_involute_out_of_contact_is_no_number():
    """Involute teeth of this height are undercut early: their path is the shorter one."""
    content = sheet(
        convex_concave__pinion_teeth=7,
        convex_concave__pitch_point_angle_deg=14.0,
        convex_concave__addendum_arc_radius_mm=7.0,
    ).content
    (end,) = [c for c in content["contacts"] if (c["zone"], c["place"]) == ("b", "end")]
    assert end["path_coordinate_mm"] < -3.5 * 4.5 * math.sin(math.radians(14.0))
    assert end["involute_reduced_radius_mm"] is None


def test_schema(cli):
    done = cli("schema", "--of", "convex-concave")
    schema = json.loads(done.out)
    table = schema["$defs"]["ConvexConcaveTable"]["properties"]
    assert table["pitch_point_angle_deg"]["description"] == "pressure angle at the pitch point"
