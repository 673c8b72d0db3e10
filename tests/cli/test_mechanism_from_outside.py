"""A fifth mechanism, registered by a program of one's own: a flat pin on a turning disc.

Archard's law gives the depth of its face without any solver: h = k p s, with the pressure p = F/(b l) and
the way of a turn s = 2 pi R. Life, CSV files, page and comparison come from wearsim as it stands.
"""

import json
import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner

import wearsim
from wearsim.case.keys import RunTable, Table, WearTable
from wearsim.case.model import Case, Drive
from wearsim.case.table_inputs import run_input, take_defaults, wear_input
from wearsim.cli.main import wearsim_command
from wearsim.contact.engagement import ContactKind, FlankContact
from wearsim.geometry.profile_points import Profile
from wearsim.input.document import checked
from wearsim.input.faults import CaseRecord
from wearsim.input.mechanism_registry import MECHANISMS, MechanismEntry
from wearsim.input.table import CalculationTables
from wearsim.input.units import Positive
from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import CONTACT
from wearsim.quantities import Quantity, quantities

MODULUS = 115_000.0


class KindTable(Table):
    kind: Literal["pin_on_disc"]


class PinTable(Table):
    length_mm: Positive
    face_width_mm: Positive
    load_N: Positive
    track_radius_mm: Positive
    speed_rpm: Positive


class PinStopTable(Table):
    critical_depth_mm: Positive


class PinTables(CalculationTables):
    mechanism: KindTable
    pin: PinTable
    wear: WearTable
    stop: PinStopTable
    run: RunTable = RunTable()


@kernel(CONTACT)
def flat_contact(x, y, normal_x, normal_y, curvature, depth, constants, columns, load, slip, speed, relative):
    for j in range(depth.size):
        load[j], slip[j], speed[j], relative[j] = constants[0], constants[1], constants[2], constants[3]


@dataclass(frozen=True, eq=False)
class PinMechanism:
    drive: "PinDrive"
    points: int = 21

    @property
    def contact(self):
        drive = self.drive
        arc = np.linspace(0.0, drive.length, self.points)
        # The curvature whose Hertz pressure is that of the flat face, pi p^2/(w E).
        relative = math.pi * drive.pressure**2 / (drive.line_load * MODULUS)
        constants = [drive.line_load, drive.way, drive.way * drive.speed / 60.0, relative]
        return FlankContact(
            kind=ContactKind.LOCAL,
            kernel=flat_contact,
            constants=np.array(constants),
            columns=np.zeros((1, 1)),
            profile=Profile(-arc, np.zeros(arc.size)),
            arc_length=arc,
            mate_radius=1.0 / relative,
            modulus=MODULUS,
            slip_curvature_exponent=0.0,
            offset_form=False,
        )

    def other_grids(self):
        half = self.contact.coarsened()
        return half, half.coarsened()

    def refined(self, level):
        return None

    def mate_columns(self, depth):
        return {}

    def worn_contact_ratio(self, x, y):
        return math.nan

    def assumptions(self):
        return ["the flat face of the pin stays flat, its pressure the same everywhere"]


@dataclass(frozen=True, eq=False)
class PinDrive(Drive):
    length: float
    line_load: float
    way: float
    speed: float

    @property
    def pressure(self):
        return self.line_load / self.length

    def mechanism(self, case):
        return PinMechanism(self)


def read(document):
    tables, faults = checked(document, PinTables), document.faults
    record = CaseRecord(tables, document.folder, faults)
    take_defaults(record, tables)
    wear, run, pin = wear_input(record, tables.wear), run_input(record, tables.run), tables.pin
    faults.check()
    return Case(
        name=document.name,
        title=tables.title or "Pin on a disc",
        inputs=record.inputs,
        files=(),
        input_files={},
        drive=PinDrive(
            pin.length_mm, pin.load_N / pin.face_width_mm, math.tau * pin.track_radius_mm, pin.speed_rpm
        ),
        modulus=MODULUS,
        speed_rpm=pin.speed_rpm,
        engaged_every=1,
        turns_per_cycle=1,
        wear=wear,
        critical_depth=tables.stop.critical_depth_mm,
        more_limits={},
        run=run,
        fatigue=None,
        assumptions=tuple(record.assumptions),
        warnings=tuple(record.warnings),
    )


INPUT = """
format_version = 1

[mechanism]
kind = "pin_on_disc"

[pin]
length_mm = 10.0
face_width_mm = 4.0
load_N = 80.0
track_radius_mm = 30.0
speed_rpm = 60.0

[wear]
specific_wear_rate_mm2_per_N = 1e-9

[stop]
critical_depth_mm = 0.2
"""

LIFE = 0.2 / (1e-9 * 80.0 / (4.0 * 10.0) * math.tau * 30.0) / 3600.0
"""h/(k p 2 pi R) cycles at 3600 an hour: 147.4 h."""


@pytest.fixture
def case(monkeypatch, tmp_path):
    """The line by which a program adds its mechanism, its new quantities, and an input file."""
    entry = MechanismEntry(tables=f"{__name__}:PinTables", read=f"{__name__}:read")
    monkeypatch.setitem(MECHANISMS, "pin_on_disc", entry)
    for name, unit, meaning in (
        ("length_mm", "mm", "of the pin's face along its way"),
        ("load_N", "N", "on the pin"),
        ("track_radius_mm", "mm", "of the pin's track on the disc"),
    ):
        monkeypatch.setitem(quantities(), name, Quantity(name, "", unit, meaning))
    path = tmp_path / "pin.toml"
    path.write_text(INPUT, encoding="utf-8")
    return path


def run(*arguments):
    found = CliRunner().invoke(wearsim_command, [str(argument) for argument in arguments])
    assert found.exit_code == 0, found.output
    return found.stdout


def test_its_life_is_the_closed_form(case):
    assert wearsim.simulate(wearsim.load_case(case)).life.hours == pytest.approx(LIFE, rel=1e-6)
    (many,) = wearsim.simulate_many([wearsim.load_case(case)])
    assert many.life.hours == pytest.approx(LIFE, rel=1e-6)
    assert json.loads(run("life", case, "--json"))["life_hours"] == pytest.approx(LIFE, rel=1e-6)
    twice = json.loads(run("life", case, "--json", "--set", "pin.load_N=160"))
    assert twice["life_hours"] == pytest.approx(LIFE / 2.0, rel=1e-6)


def test_its_input_is_checked_like_any_other(case):
    assert "pin.toml: ok" in run("check", case)
    wrong = CliRunner().invoke(wearsim_command, ["life", str(case), "--set", "pin.lenght_mm=3"])
    assert wrong.exit_code == 2
    assert "pin.lenght_mm" in wrong.output
    assert "length_mm" in wrong.output.replace("lenght", "")


@pytest.mark.wide
def test_its_histories_pages_and_studies(case, tmp_path):
    out = tmp_path / "run"
    text = run("life", case, "--out", out)
    assert "147" in text
    history = pd.read_csv(out / "history.csv")
    # Archard: the depth grows evenly, to the limit.
    assert history["max_depth_mm"].iloc[-1] == pytest.approx(0.2, rel=1e-6)
    expected = 0.2 * history["time_hours"] / LIFE
    np.testing.assert_allclose(history["max_depth_mm"], expected, rtol=1e-6, atol=1e-9)
    flank = pd.read_csv(out / "flank.csv")
    assert flank["pressure_MPa"].to_numpy() == pytest.approx(2.0, rel=1e-6)
    run("report", out, "--out", tmp_path / "page")
    page = (tmp_path / "page" / "index.html").read_text(encoding="utf-8")
    assert "Pin on a disc" in page
    run("compare", out, case, "--out", tmp_path / "both")
    samples = json.loads(run("uncertainty", case, "--json", "--samples", 64))
    assert samples["p50_hours"] == pytest.approx(LIFE, rel=0.1)
