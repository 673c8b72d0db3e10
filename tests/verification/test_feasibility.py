"""Limits of an evolute drive: each names itself and a value that satisfies it.

Expected: the value in a message is accepted; 0.98 of the proposed offset is not. The drives
are random with a fixed seed, the parameters those of common chains and wheels.
"""

import re
from typing import Any

import numpy as np
import pytest

import wearsim
from wearsim.geometry.feasibility import evolute_limits
from wearsim.geometry.forms.evolute import Strand


def drive(
    pitch: float, roller: float, teeth: int, end: float, start: float, offset: float | None
) -> dict[str, Any]:
    sprocket = {
        "teeth": teeth,
        "profile": "evolute",
        "face_width_mm": 0.5 * pitch,
        "contact_end_mm": end,
        "contact_start_mm": start,
    }
    if offset is not None:
        sprocket["evolute_offset_mm"] = offset
    return {
        "format_version": 1,
        "chain": {"pitch_mm": pitch, "roller_diameter_mm": roller, "inner_width_mm": 0.6 * pitch},
        "sprocket": sprocket,
        "load": {"tension_N": 100, "speed_rpm": 100},
        "wear": {"condition": "hardened, oiled"},
    }


def random_drives() -> list[tuple[float, float, int, float, float]]:
    """Pitch 6 to 120 mm, roller 0.45 to 0.65 of it, 18 to 70 teeth, contact ratio to 1.15."""
    random = np.random.default_rng(20240607)
    drives = []
    for _ in range(50):
        pitch = float(random.uniform(6.0, 120.0))
        roller = float(random.uniform(0.45, 0.65)) * pitch
        end = float(random.uniform(0.1, 0.2)) * pitch
        ratio = float(random.uniform(1.02, 1.15))
        drives.append((pitch, roller, int(random.integers(18, 70)), end, end + ratio * pitch))
    return drives


def proposal(message: str, key: str) -> float:
    found = re.findall(rf"{key} = ([0-9.]+)", message)
    assert found, message
    return float(found[-1])


@pytest.mark.wide
@pytest.mark.parametrize("parameters", random_drives())
def test_proposed_offset_is_accepted_and_less_is_refused(
    parameters: tuple[float, float, int, float, float],
) -> None:
    centrode = parameters[0] * parameters[2] / (2.0 * np.pi)
    with pytest.raises(wearsim.CaseError, match="exit clearance") as refusal:
        wearsim.load_case(drive(*parameters, offset=1e-2 * centrode / 20.0))
    proposed = proposal(str(refusal.value), "at least evolute_offset_mm")
    wearsim.load_case(drive(*parameters, offset=proposed))
    with pytest.raises(wearsim.CaseError, match="exit clearance"):
        wearsim.load_case(drive(*parameters, offset=0.98 * proposed))


@pytest.mark.parametrize("ratio", [0.5, 0.99, 1.0, 2.0, 3.0])
def test_contact_ratio_proposes_a_start(ratio: float) -> None:
    tables = drive(25.4, 15.88, 20, 4.0, 4.0 + ratio * 25.4, 5.6)
    with pytest.raises(wearsim.CaseError, match="contact ratio") as refusal:
        wearsim.load_case(tables)
    message = str(refusal.value)
    assert "sprocket.contact_start_mm" in message
    tables["sprocket"]["contact_start_mm"] = proposal(message, "contact_start_mm")
    wearsim.load_case(tables)


def test_contact_end_before_the_pitch_point_line_proposes_a_value() -> None:
    strand = Strand(25.4 * 20 / (2.0 * np.pi), 7.94, 5.5)
    ((_, message),) = evolute_limits(strand, -1.0, 26.0, 25.4)
    assert message.startswith("contact_end must be above 0")
    proposed = float(message.rsplit(": ", 1)[1].split()[0])
    assert evolute_limits(strand, proposed, proposed + 1.05 * 25.4, 25.4) == []


@pytest.mark.parametrize(("offset", "limit"), [(15.0, "neck thickness"), (90.0, "centrode radius")])
def test_too_large_offset_names_one_that_will_do(offset: float, limit: str) -> None:
    """15 mm is beyond what the tooth can take, 90 mm beyond the centrode of 80.85 mm."""
    tables = drive(25.4, 15.88, 20, 4.0, 30.67, offset)
    with pytest.raises(wearsim.CaseError, match=limit) as refusal:
        wearsim.load_case(tables)
    tables["sprocket"]["evolute_offset_mm"] = proposal(str(refusal.value), "evolute_offset_mm")
    wearsim.load_case(tables)


@pytest.mark.parametrize(
    ("teeth", "limit"), [(6, "exit clearance"), (9, "neck thickness"), (12, "neck thickness")]
)
def test_too_few_teeth_propose_a_number(teeth: int, limit: str) -> None:
    tables = drive(25.4, 15.88, teeth, 4.0, 30.67, None)
    with pytest.raises(wearsim.CaseError, match=limit) as refusal:
        wearsim.load_case(tables)
    tables["sprocket"]["teeth"] = int(proposal(str(refusal.value), "teeth"))
    wearsim.load_case(tables)


def test_roller_wider_than_the_gap_is_refused() -> None:
    with pytest.raises(wearsim.CaseError, match=r"roller must be smaller than the pitch"):
        wearsim.load_case(drive(25.4, 26.0, 20, 4.0, 30.67, None))
