"""Gaps from files in a case: those of other sprockets are refused, worn ones doubted.

Expected: the pitch radius p / (2 sin(180/z)), the seats of the standards' own arcs, and the loads
of the exact form.
"""

import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest

import wearsim
from wearsim.catalogue.catalogues import chains
from wearsim.errors import CaseError
from wearsim.geometry.forms.ansi_b29 import ansi_b29_gap
from wearsim.geometry.forms.gost591 import gost591_gap
from wearsim.geometry.forms.iso606 import gap_form, iso606_gap
from wearsim.geometry.gap import Gap
from wearsim.geometry.gap_points import lowest_centre
from wearsim.mechanisms.wrap.drive import WrapDrive
from wearsim.mechanisms.wrap.tooth_loads import tooth_loads

PITCH, ROLLER = 12.7, 8.51
CASE: dict[str, Any] = {
    "format_version": 1,
    "chain": {"designation": "08B-1"},
    "sprocket": {"teeth": 19, "profile": "iso606"},
    "drive": {"mate_teeth": 57, "links": 120},
    "mechanism": {"kind": "wrap"},
    "load": {"power_kW": 3, "speed_rpm": 1000},
    "wear": {"condition": "hardened, oiled"},
}
Form = Callable[[float, float, int, Any], Gap]
FORMS: dict[str, Form] = {
    "iso606 min": lambda p, d, z, seat: iso606_gap(p, d, z, "min", seat),
    "iso606 max": lambda p, d, z, seat: iso606_gap(p, d, z, "max", seat),
    "ansi_b29": ansi_b29_gap,
    "gost591": lambda p, d, z, seat: gost591_gap(p, d, z, False, seat),
    "gost591 displaced": lambda p, d, z, seat: gost591_gap(p, d, z, True, seat),
}
SEATS = ["pitch_circle", "root_diameter"]


def between_forms(form: str) -> dict[str, float]:
    """The three numbers of a form of ISO 606 as the standard gives them, d1 = 8.51 mm, z = 19."""
    least = form == "min"
    return {
        "seat_radius_mm": 0.505 * 8.51 + (0.0 if least else 0.069 * math.cbrt(8.51)),
        "flank_radius_mm": 0.12 * 8.51 * (19 + 2) if least else 0.008 * 8.51 * (19**2 + 180),
        "seating_angle_deg": (140.0 if least else 120.0) - 90.0 / 19,
    }


def iso606(**sprocket: object) -> wearsim.Case:
    return wearsim.load_case({**CASE, "sprocket": {**CASE["sprocket"], **sprocket}})


@pytest.mark.parametrize("form", ["min", "max"])
def test_limits_of_iso_606_are_its_forms(form: str) -> None:
    """Exactly; and a millionth beyond a limit it is refused, with both limits."""
    exact, given = iso606(form=form).drive, iso606(**between_forms(form)).drive
    assert isinstance(exact, WrapDrive)
    assert isinstance(given, WrapDrive)
    assert np.array_equal(given.outline.x, exact.outline.x)
    assert np.array_equal(given.outline.y, exact.outline.y)
    for key, value in between_forms(form).items():
        low, high = sorted((between_forms("min")[key], between_forms("max")[key]))
        beyond = value * (1.0 + (5e-6 if value == high else -5e-6))
        with pytest.raises(CaseError, match=f"{low:.7g} and {high:.7g} for rollers of 8.51 mm"):
            iso606(**{**between_forms(form), key: beyond})


def test_a_number_left_out_is_that_of_the_minimum_form() -> None:
    case = iso606(seat_radius_mm=4.35)
    wanted = {**between_forms("min"), "seat_radius_mm": 4.35}
    assert {key: case.inputs["sprocket"][key] for key in wanted} == pytest.approx(wanted)
    assert "sprocket.flank_radius_mm = 21.4452 (minimum form of ISO 606)" in case.assumptions
    assert "form" not in case.inputs["sprocket"]


def points_of(gap: Gap, count: int = 121) -> np.ndarray:
    outline = gap.outline(count)
    return np.column_stack([outline.x, outline.y])


def case_with(
    file: Path, points: np.ndarray, chain: dict[str, Any] = CASE["chain"], **sprocket: object
) -> wearsim.Case:
    """Points in mm, written as a CSV or as the polyline of a drawing."""
    if file.suffix == ".dxf":
        draw(file, points, units=4)
        keys = {"profile": "dxf", "dxf_file": str(file)}
    else:
        np.savetxt(file, points, delimiter=",", header="x_mm,y_mm", comments="")
        keys = {"profile": "points", "points_file": str(file)}
    return wearsim.load_case(CASE | {"chain": chain, "sprocket": {"teeth": 19} | keys | sprocket})


def draw(file: Path, points: np.ndarray, units: int) -> None:
    drawing = ezdxf.new(units=units)
    drawing.modelspace().add_lwpolyline(points)
    drawing.saveas(file)


def pitch_radius(teeth: float) -> float:
    return 0.5 * PITCH / math.sin(math.pi / teeth)


@pytest.mark.parametrize("higher", [0, -1])
def test_either_tip_of_a_measured_gap_may_lie_higher(tmp_path: Path, higher: int) -> None:
    """A whole gap has a tip at both ends: which of them noise puts farther out says nothing of the order."""
    points = points_of(iso606_gap(PITCH, ROLLER, 19, "min"))
    points[higher] *= 1.0 + 2e-5
    case_with(tmp_path / "gap.csv", points, points_noise_mm=1e-3)


@pytest.mark.wide
@pytest.mark.parametrize("kind", ["csv", "dxf"])
@pytest.mark.parametrize("teeth", [18, 20])
@pytest.mark.parametrize("form", ["min", "max"])
def test_gap_of_a_tooth_more_or_less_is_refused(tmp_path: Path, kind: str, teeth: int, form: Any) -> None:
    points = points_of(iso606_gap(PITCH, ROLLER, teeth, form))
    seat = pitch_radius(teeth) - (gap_form(form, ROLLER, teeth).seat_radius - 0.5 * ROLLER)
    with pytest.raises(wearsim.CaseError) as raised:
        case_with(tmp_path / f"gap.{kind}", points)
    (fault,) = raised.value.faults
    assert f"pitch circle of radius {pitch_radius(19):.5g} mm" in fault.message
    assert "check sprocket.teeth = 19, the chain" in fault.message
    found = re.search(r"seats it ([0-9.]+) mm", fault.message)
    assert found
    assert float(found[1]) == pytest.approx(seat, abs=1e-3)


@pytest.mark.wide
@pytest.mark.parametrize("seat", SEATS)
@pytest.mark.parametrize("form", FORMS)
def test_points_of_standard_forms_are_taken(tmp_path: Path, form: str, seat: str) -> None:
    gap = FORMS[form](PITCH, ROLLER, 19, seat)
    assert not case_with(tmp_path / "gap.csv", points_of(gap)).warnings


@pytest.mark.wide
@pytest.mark.parametrize("seat", SEATS)
@pytest.mark.parametrize("form", ["iso606 max", "gost591 displaced"])
def test_drawings_of_standard_forms_are_taken(tmp_path: Path, form: str, seat: str) -> None:
    gap = FORMS[form](PITCH, ROLLER, 19, seat)
    assert not case_with(tmp_path / "gap.dxf", points_of(gap)).warnings


@pytest.mark.wide
def test_no_standard_seats_the_roller_higher_than_the_pitch_circle_or_lower_than_iso_max() -> None:
    """ISO's maximum form: 0.005 d1 + 0.069 cbrt(d1), of which the check names the extremes."""
    sizes = {(chain.pitch, chain.roller_diameter) for chain in chains().values()}
    for pitch, roller in [*sorted(sizes)[::5], max(sizes)]:
        deepest = 0.005 * roller + 0.069 * math.cbrt(roller)
        assert deepest < min(0.022 * pitch, 0.65)
        for teeth in (9, 150):
            for name, form in FORMS.items():
                if name.startswith("gost") and not 1.4 < pitch / roller <= 2.0:
                    continue
                for seat in SEATS:
                    gap = form(pitch, roller, teeth, seat)
                    outline = gap.outline(301)
                    below = gap.pitch_radius - lowest_centre(outline.x, outline.y, 0.5 * roller)[1]
                    assert -1e-4 < below < deepest + 1e-4, (pitch, teeth, name, seat)


@pytest.mark.parametrize("kind", ["csv", "dxf"])
def test_worn_gap_is_taken_with_a_warning(tmp_path: Path, kind: str) -> None:
    """0.4 mm lower than ri - d1/2 = 0.0426 mm; new ones to 0.183 mm."""
    lower = points_of(iso606_gap(PITCH, ROLLER, 19)) - np.array([0.0, 0.4])
    (warning,) = case_with(tmp_path / f"gap.{kind}", lower).warnings
    assert "0.26 mm lower than a new sprocket of 19 teeth would (38.396 to 38.58 mm)" in warning


@pytest.mark.parametrize("shift", [-1.2, 1.0])
def test_shifted_gap_is_refused(tmp_path: Path, shift: float) -> None:
    moved = points_of(iso606_gap(PITCH, ROLLER, 19)) + np.array([0.0, shift])
    with pytest.raises(wearsim.CaseError, match=r"must seat a roller of 8\.51 mm near the pitch"):
        case_with(tmp_path / "gap.csv", moved)


@pytest.mark.parametrize(("gaps", "accepted"), [(38, True), (37, False)])
def test_gaps_that_lie_nearer_than_a_pitch(tmp_path: Path, gaps: int, accepted: bool) -> None:
    """Every second of 38 carries a roller: pitch circle of 19 teeth; that of 37 is 18.5 teeth's."""
    between = 2.0 * pitch_radius(gaps / 2) * math.sin(math.pi / gaps)
    chain = {
        "pitch_mm": PITCH,
        "roller_diameter_mm": 5.0,
        "inner_width_mm": 7.75,
        "pin_diameter_mm": 3.0,
        "bearing_area_mm2": 50,
        "mass_kg_per_m": 0.7,
    }
    points = points_of(iso606_gap(between, 5.0, gaps, "max"))
    file = tmp_path / "gap.csv"
    if accepted:
        case = case_with(file, points, chain, teeth=38, engaged_every=2)
        assert not any("seats a roller" in text for text in case.warnings)
    else:
        with pytest.raises(wearsim.CaseError, match=r"check sprocket\.teeth = 38"):
            case_with(file, points, chain, teeth=38, engaged_every=2)


def test_drawing_in_metres_is_refused_at_once(tmp_path: Path) -> None:
    """Metres are what ezdxf takes where no unit is asked for: the wheel is 80 m wide."""
    file = tmp_path / "gap.dxf"
    draw(file, points_of(iso606_gap(PITCH, ROLLER, 19), 31), units=6)
    sprocket = {"teeth": 19, "profile": "dxf", "dxf_file": str(file)}
    with pytest.raises(wearsim.CaseError, match=r"bottom of the gap .* lies 342\d\d mm .*\$INSUNITS"):
        wearsim.load_case(CASE | {"sprocket": sprocket})


def test_few_vertices_are_doubted_and_fewer_refused(tmp_path: Path) -> None:
    gap = iso606_gap(PITCH, ROLLER, 19)
    (warning,) = case_with(tmp_path / "gap.dxf", points_of(gap, 41)).warnings
    assert "gap.dxf gives the gap by 41 points" in warning
    with pytest.raises(wearsim.CaseError, match=r"gap.dxf: gap points: at least 24 .* got 21 x"):
        case_with(tmp_path / "gap.dxf", points_of(gap, 21))


@pytest.mark.wide
@pytest.mark.parametrize("count", [61, 201])
@pytest.mark.parametrize("form", ["min", "max"])
def test_loads_of_a_polyline_are_those_of_the_form(tmp_path: Path, form: Any, count: int) -> None:
    exact = tooth_loads(wearsim.load_case(CASE, [f'sprocket.form="{form}"'])).loads
    points = points_of(iso606_gap(PITCH, ROLLER, 19, form), count)
    drawn = tooth_loads(case_with(tmp_path / "gap.dxf", points)).loads
    tight = float(exact.tension[0])
    np.testing.assert_allclose(drawn.force, exact.force, atol=1e-3 * tight, rtol=0.0)
