"""The drives on which the published rules are compared, and the row of docs/practice.md that each makes."""

import csv
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

import wearsim
from wearsim.chain.joint_wear import JointState, extrapolation
from wearsim.chain.practice_drive import PracticeDrive
from wearsim.chain.practice_rules import geometric_mean, opinions
from wearsim.mechanisms.wrap.drive import WrapDrive

WORDS = {"drive", "chain", "series"}
WHOLE = {"no", "teeth", "mate_teeth", "links"}

Row = Mapping[str, float | str]


def read_drives() -> list[Row]:
    """Rows of drives.csv, their numbers as numbers."""
    text = Path(__file__).with_name("drives.csv").read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return [
        {
            key: cell if key in WORDS else int(cell) if key in WHOLE else float(cell)
            for key, cell in row.items()
        }
        for row in csv.DictReader(lines)
    ]


DRIVES = read_drives()


def practice_drive(row: Row, **changes: float | str) -> PracticeDrive:
    """A row as the rules take it."""
    given = {
        "pitch": row["pitch_mm"],
        "teeth": row["teeth"],
        "ratio": row["mate_teeth"] / row["teeth"],
        "speed": row["speed_rpm"],
        "links": row["links"],
        "pull": row["pull_N"],
        "bearing_area": row["bearing_area_mm2"],
        "pin_diameter": row["pin_diameter_mm"],
        "series": row["series"],
    }
    return PracticeDrive(**{**given, **changes})


def engine_case(row: Row, **changes: object) -> wearsim.Case:
    """A row as a case, clean and with oil, the chain to 3 %, with other keys of [drive] or [stop]."""
    case = wearsim.load_case(
        {
            "format_version": 1,
            "chain": {"designation": row["chain"]},
            "sprocket": {"teeth": row["teeth"], "profile": "iso606", "role": "driver", "nodes": 51},
            "drive": {"mate_teeth": row["mate_teeth"], "links": row["links"]},
            "mechanism": {"kind": "wrap"},
            "load": {"power_kW": practice_drive(row).power, "speed_rpm": row["speed_rpm"]},
            "wear": {"condition": "hardened, oiled"},
            "stop": {"elongation_percent": 3},
        }
    )
    return case.with_(changes) if changes else case


def engine_hours(case: wearsim.Case) -> float:
    """Hours of the chain as wearsim computes them."""
    assert isinstance(case.drive, WrapDrive)
    return case.drive.contact(case).cycles_per_mate / case.cycles_per_hour


def row_state(row: Row) -> JointState:
    """Where the joints of a row run."""
    return JointState(practice_drive(row).pressure, row["speed_rpm"], row["pitch_mm"])


def engine_band(case: wearsim.Case) -> tuple[float, float]:
    """Ends of the band of these hours."""
    band, hours = case.drive.wear_band("chain", case.wear), engine_hours(case)
    return hours / band.high, hours / band.low


@pytest.fixture(params=DRIVES, ids=lambda row: f"{row['no']} {row['chain']} {row['speed_rpm']:.0f} rpm")
def row(request: pytest.FixtureRequest) -> Row:
    """Each drive."""
    return request.param


@pytest.fixture
def drive() -> Callable[..., PracticeDrive]:
    """Return the maker of the packaging conveyor's drive, or another row's, with changes."""
    return lambda no=1, **changes: practice_drive(DRIVES[no - 1], **changes)


@pytest.fixture
def on_page(request: pytest.FixtureRequest) -> Callable[[Row], None]:
    """Return the recorder of a drive for the page."""

    def record(row: Row) -> None:
        if request.config.getoption("practice_page"):
            drive = practice_drive(row)
            found = opinions(drive)
            cells = {key: row[key] for key in ("no", "drive", "chain", "teeth", "mate_teeth", "speed_rpm")}
            cells |= {"speed_m_per_s": drive.chain_speed, "pressure_MPa": drive.pressure}
            cells |= {"hours": {one.rule.name: one.hours for one in found}}
            case = engine_case(row)
            cells |= {"mean": geometric_mean(found), "engine": engine_hours(case), "band": engine_band(case)}
            cells |= {"outside": extrapolation(case.drive.joint.law, row_state(row))}
            request.node.user_properties.append(("practised", cells))

    return record
