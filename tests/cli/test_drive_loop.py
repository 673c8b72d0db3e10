"""Drives of more than two sprockets: positions, idlers, take-ups, shares of power, cassettes."""

import json
import math
import re
import tomllib

import pytest

import wearsim
from wearsim.drive import life
from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_drive
from wearsim.errors import ConvergenceError


def checked(cli, tmp_path, text):
    path = tmp_path / "drive.toml"
    path.write_text(text)
    done = cli("check", path, "--json")
    assert done.code == 0, done.err + done.out
    return json.loads(done.out)["layout"]


def test_layout_and_forces_balance(cli, tmp_path, loop):
    found = checked(cli, tmp_path, loop)
    power = {one["name"]: one["power_kW"] for one in found["sprockets"]}
    heat = 1e-3 * found["friction_heat_W"]
    assert power["motor"] == pytest.approx(-power["pump"] - power["fan"] + heat, rel=1e-6)
    assert found["efficiency"] == pytest.approx(-(power["pump"] + power["fan"]) / power["motor"], rel=1e-9)
    assert power["tensioner"] == 0.0
    spans = {one["from"]: one["tension_N"] for one in found["spans"]}
    # 1.3 kW at 17 * 12.7 mm * 5/s; the pump takes 70 % of what the idler's joints leave.
    assert spans["fan"] - spans["motor"] == pytest.approx(1.3e6 / (17 * 12.7 * 5), rel=1e-9)
    taken = spans["fan"] - spans["tensioner"]
    assert spans["pump"] - spans["tensioner"] == pytest.approx(0.7 * taken, rel=1e-9)
    # The spring pulls with its 80 N along its guide.
    idler = next(one for one in found["sprockets"] if one["name"] == "tensioner")
    angle = math.radians(idler["shaft_direction_deg"] - -37.5)
    assert idler["shaft_load_N"] * math.cos(angle) == pytest.approx(-80.0, rel=1e-9)
    assert sum(one["wrap_deg"] * (-1 if one is idler else 1) for one in found["sprockets"]) == (
        pytest.approx(360.0)
    )


CHANGES = [
    ('name = "fan"', 'name = "blower"', "names"),
    ("position_mm = [306, 0]", "position_mm = [304, 0]", "spans"),
    ("tensioner_force_N = 80", "tensioner_force_N = 90", "spans"),
    ("guide_deg = -37.5", "guide_deg = -45", "places"),
    ("power_share = 0.7", "power_share = 0.8", "spans"),
    ("links = 92", "links = 92\njoint_friction = 0.2", "heat"),
]


@pytest.mark.wide
@pytest.mark.parametrize(("before", "after", "what"), CHANGES)
def test_every_key_changes_something(cli, tmp_path, before, after, what, loop):
    changed = loop.replace(before, after).replace(
        "power_share = 0.3", "power_share = 0.2" if "0.8" in after else "power_share = 0.3"
    )
    looks = {
        "names": lambda found: [one["name"] for one in found["sprockets"]],
        "spans": lambda found: [one["tension_N"] for one in found["spans"]],
        "places": lambda found: [one["x_mm"] for one in found["sprockets"]],
        "heat": lambda found: found["friction_heat_W"],
    }
    first, then = (looks[what](checked(cli, tmp_path, text)) for text in (loop, changed))
    assert first != then


def test_torques_in_place_of_shares(cli, tmp_path, loop):
    """The chain has the same power; what the joints of the idler lose is shared as the torques are."""
    torques = [1e3 * 1.3 * share / (math.pi * 10.0 * 17 / teeth) for share, teeth in ((0.7, 20), (0.3, 25))]
    text = loop.replace("power_share = 0.7", f"torque_N_m = {torques[0]}")
    text = text.replace("power_share = 0.3", f"torque_N_m = {torques[1]}")
    by_share, by_torque = (checked(cli, tmp_path, one)["spans"] for one in (loop, text))
    for one, other in zip(by_share, by_torque, strict=True):
        assert one["tension_N"] == pytest.approx(other["tension_N"], rel=1e-9)


TWO_BLOCKS = """\
[[duty]]
share_of_time = 0.5
power_kW = 1.3
speed_rpm = 300
[[duty]]
share_of_time = 0.5
power_kW = 1.3
speed_rpm = 300
power_share = {pump = 0.1, fan = 0.9}
"""


def test_a_drive_whose_blocks_share_power_has_a_sheet(cli, tmp_path, loop):
    path, sheet = tmp_path / "duty.toml", tmp_path / "sheet.html"
    path.write_text(loop.replace("[load]\npower_kW = 1.3\nspeed_rpm = 300\n", "") + TWO_BLOCKS)
    done = cli("report", path, "--out", sheet, "--set", "run.horizon_hours=20")
    assert done.code == 0, done.err
    assert "tensioner" in sheet.read_text("utf-8")


def test_a_block_of_the_duty_shares_power_in_its_own_way(tmp_path, loop):
    path = tmp_path / "duty.toml"
    path.write_text(loop.replace("[load]\npower_kW = 1.3\nspeed_rpm = 300\n", "") + TWO_BLOCKS)
    pump = next(one for one in load_drive(path).sprockets if one.name == "pump").drive
    taken = [block.tension - block.slack for block in pump.blocks]
    assert taken[1] == pytest.approx(taken[0] / 7.0, rel=1e-9)
    assert [block.share for block in pump.blocks] == [0.5, 0.5]


SQUARE = """\
format_version = 1
[chain]
designation = "08B-1"
[drive]
joint_friction = 0
[wear]
condition = "hardened, oiled"
"""


def square(shares, level, blocks):
    """Two drivers and two driven sprockets of 19 teeth by turns at the corners of a square of 400 mm."""
    places = {"A": [0, 0], "X": [400, 0], "B": [400, 400], "Y": [0, 400]}
    wheels = [
        f"[[sprocket]]\nname = {name!r}\nteeth = 19\nprofile = 'iso606'\nnodes = 41\nposition_mm = {place}\n"
        f"role = {'driver' if name in 'AB' else 'driven'!r}\npower_share = {shares[name]}\n"
        for name, place in places.items()
    ]
    taker = "take_up = {guide_deg = 90}\n"
    duty = [
        f"[[duty]]\nshare_of_time = {1 / len(blocks)}\npower_kW = 1\nspeed_rpm = 300\n" + extra
        for extra in blocks
    ]
    return SQUARE.replace("[wear]", f"{level}\n[wear]") + "".join([*wheels, taker, *duty])


@pytest.mark.parametrize(
    ("slack", "a", "x", "y"), [(60.0, 0.5, 0.8, 0.2), (300.0, 0.5, 0.8, 0.2), (80.0, 0.2, 0.5, 0.5)]
)
def test_the_loosest_span_is_that_of_each_block(slack, a, x, y):
    """Its own shares tell which span of a block has the slack tension; by hand from wheel to wheel."""
    own = {"A": a, "X": 0.35, "B": 1.0 - a, "Y": 0.65}
    text = square(own, f"slack_tension_N = {slack}", ["", f"power_share = {{X = {x}, Y = {y}}}\n"])
    blocks = load_drive(tomllib.loads(text)).driver.drive.blocks
    pull = 1e6 / (300.0 / 60.0 * 19 * 12.7)
    for block, (taken_x, taken_y) in zip(blocks, [(0.35, 0.65), (x, y)], strict=True):
        spans = [0.0]  # A to X, X to B, B to Y, Y to A, over that of A to X
        for change in (taken_x, a - 1.0, taken_y):
            spans.append(spans[-1] + change * pull)
        expected = [slack + span - min(spans) for span in spans]
        assert list(block.spans) == pytest.approx(expected, rel=1e-9)


def test_the_sag_is_that_of_the_loosest_span_of_each_block():
    """2 % of 400 mm on a flat span: w a/(8 s)."""
    own = {"A": 0.5, "X": 0.2, "B": 0.5, "Y": 0.8}
    text = square(own, "sag_percent = 2", ["", "power_share = {X = 0.8, Y = 0.2}\n"])
    blocks = load_drive(tomllib.loads(text)).driver.drive.blocks
    # Weight of the chain by its centrifugal tension q v^2, at 19 pitches of 12.7 mm five times a second.
    weight = 9.81 * blocks[0].centrifugal / (300.0 / 60.0 * 19 * 0.0127) ** 2
    for block, loosest in zip(blocks, (2, 0), strict=True):
        assert block.spans.index(min(block.spans)) == loosest
        assert block.spans[loosest] == pytest.approx(weight * 0.4 / (8.0 * 0.02), rel=0.03)


@pytest.mark.wide
def test_all_sprockets_live_with_the_same_chain(tmp_path, loop):
    path = tmp_path / "drive.toml"
    path.write_text(loop)
    found = drive_life(load_drive(path))
    chains = [result.parts["chain"].hours for result in found.results.values()]
    assert chains == pytest.approx([chains[0]] * 4, rel=1e-9)
    # One loop of the chain: k pi d2/p sum (p_in + p_out)/z, by hand from the spans (E1).
    drive = found.drive.driver.drive
    forces = drive.forces(drive.heaviest)
    z = (17, 13, 20, 25)
    arriving = [*forces.tensions[-1:], *forces.tensions[:-1]]
    turned = sum(
        (one + other + 2.0 * forces.centrifugal) / teeth
        for one, other, teeth in zip(arriving, forces.tensions, z, strict=True)
    )
    growth = 1e-9 * math.pi * 4.45 / 12.7 * turned / 50.3
    loops_per_hour = 60.0 * 300.0 * 17.0 / 92.0
    assert chains[0] == pytest.approx(0.03 / growth / loops_per_hour, rel=1e-6)
    # The idler carries least and lives longest; each sprocket has a life of its own.
    lives = {name: life.hours_run for name, life in found.sprockets.items()}
    assert max(lives, key=lives.__getitem__) == "tensioner"
    assert len(set(lives.values())) == 4


@pytest.mark.wide
def test_cogs_share_the_time_and_the_chain(tmp_path, cassette):
    path = tmp_path / "drive.toml"
    path.write_text(cassette)
    drive = load_drive(path)
    assert [one.name for one in drive.sprockets] == ["ring", "cassette 13T", "cassette 17T"]
    found = drive_life(drive)
    chains = [result.parts["chain"].hours for result in found.results.values()]
    assert chains == pytest.approx([chains[0]] * 3, rel=1e-9)
    # A chain on one cog all the time, for either: growth adds up by shares of time.
    alone = []
    for teeth in (13, 17):
        tables = {
            "format_version": 1,
            "chain": {"designation": "08B-1"},
            "sprocket": {"teeth": teeth, "profile": "iso606", "nodes": 61, "role": "driven"},
            "drive": {"links": 110, "mate_teeth": 38},
            "load": {"power_kW": 0.8, "speed_rpm": 100 * 38 / teeth},
            "joint": {"specific_wear_rate_mm2_per_N": 1e-9},
            "wear": {"specific_wear_rate_mm2_per_N": 1e-9},
            "mechanism": {"phases": 2},
            "run": {"life_tolerance": 0.1},
        }
        alone.append(wearsim.load_case(tables))
    hours = [case.drive.contact(case).cycles_per_mate / case.cycles_per_hour for case in alone]
    # Slack tensions of the two layouts differ by a little.
    assert chains[0] == pytest.approx(1.0 / (0.25 / hours[0] + 0.75 / hours[1]), rel=1e-3)
    # A cog that runs a quarter of the time lives about four times as long as one that runs all of it.
    life = wearsim.simulate(alone[0]).parts["sprocket"].hours
    assert found.sprockets["cassette 13T"].hours == pytest.approx(4.0 * life, rel=0.15)


@pytest.mark.parametrize(
    ("before", "after", "line", "message"),
    [
        ("position_mm = [62, 155]", "position_mm = [20, 155]", 10, "does not touch wheel 'tensioner'"),
        ("links = 92", "links = 120", 10, "120 links must fit within its travel"),
        ("power_share = 0.3", "power_share = 0.2", 32, "the power must balance"),
        ("outside = true", "outside = true\npower_share = 0.1", 18, "an idler transmits no power"),
        (
            "power_share = 0.3",
            "power_share = 0.3\ntake_up = {guide_deg = 0}",
            33,
            "one sprocket takes up the slack, 'tensioner' does already",
        ),
        ("position_mm = [306, 0]", "position_mm = [40, 40]", 4, "must not overlap"),
        ("[-25, 30]", "[30, -25]", 18, "two ends of the travel"),
        ("power_kW = 1.3", "tension_N = 1300", 36, "each span has its own tension"),
        ("links = 92", "links = 92\nmate_teeth = 20", 35, "the other [[sprocket]] gives this"),
        (
            "links = 92",
            "centre_distance_mm = 300",
            34,
            "this follows from the sprockets and their position_mm",
        ),
        ("links = 92", "links = 92\nslack_tension_N = 80", 35, "the force of the take_up already gives this"),
        ("tensioner_force_N = 80", "tensioner_force_N = 80000", 36, "the pull must stay below the chain's"),
        ("guide_deg = -37.5", "guide_deg = 142.5", 10, "every span must be in tension"),
        ("tensioner_force_N = 80", "tensioner_force_N = 0.1", 18, "'motor': the rollers must hold the chain"),
    ],
)
def test_what_is_wrong_is_named_with_its_line(cli, tmp_path, before, after, line, message, loop):
    path = tmp_path / "drive.toml"
    assert before in loop
    path.write_text(loop.replace(before, after))
    done = cli("check", path)
    assert done.code == 2, done.out
    assert message in done.err
    assert done.err.count(message) == 1
    at = next(one for one in done.err.splitlines() if message in one)
    assert f"drive.toml:{line}: " in at


def test_a_wrong_chain_makes_no_faults_of_the_loop(cli, tmp_path, loop):
    """What fits depends on the pitch, so links are not looked at before the chain is right."""
    path = tmp_path / "drive.toml"
    path.write_text(loop.replace('"08B-1"', '"08X-1"'))
    done = cli("check", path)
    assert done.code == 2
    (line,) = done.err.splitlines()
    assert f"{path}:3: chain.designation: no such chain" in line


IN_THE_WAY = """
[[sprocket]]
name = "presser"
role = "idler"
teeth = 20
profile = "iso606"
nodes = 61
position_mm = [250, 2]
outside = true
"""


def test_a_span_through_a_wheel_is_named(cli, tmp_path, two_sprockets):
    """An idler presses the upper strand down to the lower one, 42.59 mm from it.

    Pitch radius 12.7/2/sin(9 deg) = 40.592 mm, so the strands do not cross; the tips stand at
    12.7/2 (0.6 + cot(9 deg)) = 43.902 mm.
    """
    path = tmp_path / "drive.toml"
    placed = two_sprockets.replace("links = 110\n", "slack_tension_N = 50\n").replace(
        "teeth = 17", "teeth = 20"
    )
    for x in (0, 500):
        placed = placed.replace("nodes = 61\n[", f"nodes = 61\nposition_mm = [{x}, 0]\n[", 1)
    path.write_text(placed.replace("\n[drive]", f"{IN_THE_WAY}[drive]"))
    done = cli("check", path)
    assert done.code == 2
    assert "drive.toml:4: sprocket.1: " in done.err
    assert (
        "the span 'driver 1' to 'roll' must clear wheel 'presser', runs 42.5921 mm from its centre and needs "
        "43.9023 mm"
    ) in done.err


def test_without_a_take_up_the_links_decide(cli, tmp_path, loop):
    fixed = loop.replace("take_up = {tensioner_force_N = 80, guide_deg = -37.5, travel_mm = [-25, 30]}\n", "")
    path = tmp_path / "drive.toml"
    path.write_text(fixed)
    done = cli("check", path)
    assert done.code == 2
    assert "a whole number of links must fit: the wheels as placed need 91." in done.err
    path.write_text(fixed.replace("[306, 0]", "[307.9, 0]").replace("links = 92", "links = 92"))
    done = cli("check", path)
    assert done.code in (0, 2)
    text = fixed.replace("links = 92", "links = 92\nsag_percent = 3")
    path.write_text(text)
    assert "without a take_up the number of links sets the sag" in cli("check", path).err


def test_one_chain_runs_on_all_cogs(cassette):
    """2 a/p + (z1 + z2)/2 + ((z2 - z1)/(2 pi))^2 p/a = 90.85 with 17 teeth, mostly run; 89.00 with 13."""
    tables = tomllib.loads(cassette.replace("links = 110", "centre_distance_mm = 400"))
    drive = load_drive(tables)
    assert [one.drive.layout.links for one in drive.sprockets] == [92, 92, 92]
    del tables["drive"]
    jockey = {"role": "idler", "teeth": 11, "profile": "iso606", "nodes": 61, "position_mm": [350, -90]}
    jockey["take_up"] = {"tensioner_force_N": 20, "travel_mm": [-60, 60]}
    ring, cogs = tables["sprocket"]
    tables["sprocket"] = [{**ring, "position_mm": [0, 0]}, jockey, {**cogs, "position_mm": [400, 0]}]
    links = [one.drive.layout.links for one in load_drive(tables).sprockets]
    assert len(links) == 4 and len(set(links)) == 1


def test_check_names_the_cogs_of_an_assumption_once(cli, tmp_path, cassette):
    """Their tips and shares differ, and nothing else that is said of them."""
    path = tmp_path / "drive.toml"
    path.write_text(cassette)
    found = json.loads(cli("check", path, "--json").out)["assumptions"]
    assert "cassette: the chain runs on this cog 25 to 75 % of the time and elongates on all cogs" in found
    assert sum("sprocket.tip_diameter_mm" in text for text in found) == 2
    assert not [text for text in found if "13T" in text or "17T" in text]


def test_cassettes_are_checked(cli, tmp_path, cassette):
    path = tmp_path / "drive.toml"
    for before, after, message in (
        ("share_of_time = 0.75", "share_of_time = 0.7", "share_of_time of all cogs must sum to 1 (got 0.95)"),
        ('name = "cassette"', 'name = "cassette"\nteeth = 17', "each cog gives its own"),
        ("teeth = 17, share", "teeth = 13, share", "cogs must have different numbers of teeth"),
        ('name = "ring"', 'name = "cassette 13T"', "need different names (got 'cassette 13T' twice)"),
        ("teeth = 38\n", "cog = [{teeth = 20, share_of_time = 1.0}, {teeth = 18}]\n", "share_of_time"),
        ("phases = 2", 'kind = "strand"', "the chain of a drive wraps its sprockets"),
    ):
        path.write_text(cassette.replace(before, after))
        done = cli("check", path)
        assert done.code == 2
        assert message in done.err


@pytest.fixture
def idler_fails(monkeypatch, tmp_path, loop):
    """A drive whose idler is not found; its path."""
    run = life.simulate

    def simulate(case, progress):
        if case.drive.gaps == 13:
            raise ConvergenceError("the rollers are not found: use more nodes")
        return run(case, progress)

    monkeypatch.setattr(life, "simulate", simulate)
    path = tmp_path / "drive.toml"
    path.write_text(loop.replace("[run]\n", "[run]\nhorizon_hours = 20\n"))
    return path


def test_a_failed_part_is_told_beside_the_lives_of_the_others(cli, idler_fails):
    done = cli("life", idler_fails)
    assert done.code == 5
    assert "tensioner  failed: the rollers are not found" in " ".join(done.out.split("\n"))
    assert "Chain " in done.out and "motor" in done.out
    assert f"{idler_fails}: 'tensioner': the rollers are not found: use more nodes" in done.err
    found = json.loads(cli("life", idler_fails, "--json").out)
    lives = {one["name"]: one for one in found["sprockets"]}
    assert list(lives) == ["motor", "tensioner", "pump", "fan"]
    assert lives.pop("tensioner") == {
        "name": "tensioner",
        "error": "the rollers are not found: use more nodes",
    }
    assert all(one["life_hours_at_least"] == 20.0 for one in lives.values())
    assert any(text.startswith("tensioner: failed") for text in found["warnings"])


def test_a_failed_part_stands_on_the_sheet(cli, idler_fails, tmp_path):
    done = cli("report", idler_fails, "--out", tmp_path / "sheet.html")
    assert done.code == 5, done.err
    text = (tmp_path / "sheet.html").read_text("utf-8")
    assert "its run failed: the rollers are not found" in text and "no life is known of tensioner" in text
    # Links of the layout lead to the flanks of their sprockets: that of the pump is the third.
    assert 'id="flank-3"' in text and 'id="flank-2"' not in text


def test_a_loop_that_nothing_takes_up_is_rated_by_half_the_elongation(cli, loop, tmp_path):
    """1.5 % in place of 3 %: by default, and as the limit that a user's own is held against."""
    text = re.sub(r"take_up = .*\n", "", loop).replace("[306, 0]", "[311.7, 0]").replace("1.3", "0.3")
    path = tmp_path / "fixed.toml"
    path.write_text(text)
    for settings, value, ok in (((), 1.5, True), (("--set", "stop.elongation_percent=1.7"), 1.7, False)):
        found = json.loads(cli("check", path, "--json", *settings).out)
        (rule,) = [one for one in found["rating"] if one["name"] == "elongation at the end"]
        assert (rule["value"], rule["limit"], rule["ok"]) == (value, 1.5, ok)
        assert rule["source"].startswith("1.5 % without a take-up")


@pytest.mark.wide
def test_a_failed_part_stands_in_the_folder_and_the_comparison(cli, idler_fails, tmp_path):
    done = cli("life", idler_fails, "--out", tmp_path / "run", "--explain")
    assert done.code == 5 and "failed: the rollers are not found" in " ".join(done.out.split())
    assert json.loads((tmp_path / "run" / "drive.json").read_text())["sprockets"][1]["error"]
    again = cli("compare", tmp_path / "run")
    assert again.code == 5 and again.out == cli("compare", idler_fails).out
    assert "no life is known of tensioner" in again.out
    other = tmp_path / "other.toml"
    other.write_text(idler_fails.read_text())
    compared = cli("compare", idler_fails, other)
    assert compared.code == 5 and compared.out.count("no life is known of tensioner") == 2


@pytest.mark.parametrize("command", ["maintain", "lubricate"])
def test_what_needs_all_lives_fails_with_that_part(cli, idler_fails, command):
    extra = ["--set", "lubrication.lasts_hours=5", "--set", "lubrication.dry_factor=2"]
    done = cli(command, idler_fails, *(extra if command == "lubricate" else []))
    assert done.code == 3 and "'tensioner': the rollers are not found" in done.err
