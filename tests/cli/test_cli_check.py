"""``wearsim check``."""

import json


def test_complete_case(cli, drive):
    path = drive()
    brief, done = cli("check", path), cli("check", path, "--explain")
    assert done.code == brief.code == 0
    assert brief.out.splitlines() == [
        f"{path}: ok",
        "  assumes  2 assumptions and 14 defaults: --explain shows them",
    ]
    lines = done.out.splitlines()
    assert lines[0] == f"{path}: ok"
    assert len(lines) == 1 + 2 + 14
    assert "  assumes  run.horizon_hours = 1e+06 (default: until a limit is met)" in lines
    assert done.err == ""


def test_all_faults_of_all_cases(cli, drive):
    bad, other = drive("bad", teeth=3, speed_rpm='"2 Hz"'), drive("other", power_kW=-3)
    done = cli("check", bad, drive("good"), other)
    assert done.code == 2
    assert done.out == ""
    places = [line.split(": ")[:2] for line in done.err.splitlines()]
    assert places == [
        [f"{bad}:6", "sprocket.teeth"],
        [f"{bad}:12", "load.speed_rpm"],
        [f"{other}:11", "load.power_kW"],
    ]


def test_infeasible_geometry_is_bad_input(cli, drive):
    done = cli("check", drive(evolute_offset_mm=2))
    assert done.code == 2
    assert "sprocket.evolute_offset_mm: exit clearance" in done.err


def test_json(cli, drive):
    done = cli("check", "--json", drive("one"), drive("two"))
    objects = [json.loads(line) for line in done.out.splitlines()]
    assert [content["case"] for content in objects] == ["one", "two"]
    assert list(objects[0]) == ["schema_version", "wearsim_version", "case", "assumptions", "warnings"]
    assert any("sprocket.face_width_mm = 16.17" in text for text in objects[0]["assumptions"])


def test_override(cli, drive):
    path = drive()
    assert cli("check", path, "--set", "sprocket.teeth=21").code == 0
    done = cli("check", path, "--set", "sprocket.teeth=3")
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith("--set sprocket.teeth: must be ")
