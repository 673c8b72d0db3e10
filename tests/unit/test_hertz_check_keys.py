"""Every key of a hertz-check file changes its sheet."""

import copy

import numpy as np
import pytest

from wearsim.errors import CaseError
from wearsim.handbook.hertz_check.hertz_fem import FemContact
from wearsim.handbook.hertz_check.keys import HertzCheckTables
from wearsim.handbook.hertz_check.published import load_hertz_check
from wearsim.handbook.hertz_check.sheet import hertz_check_sheet

BASE = {
    "format_version": 1,
    "title": "pair",
    "contact": {"torque_N_m": 240, "gear_ratio": 1.5, "face_width_mm": 76, "pinion_pitch_diameter_mm": 108},
    "teeth": {"pinion_teeth": 36, "wheel_teeth": 54, "module_mm": 3},
    "combinations": {},
    "published": {
        "hertz": {"contact_stress_MPa": 464},
        "finite_elements": {"contact_stress_MPa": 418},
        "difference": {},
    },
    "finite_elements": {},
}

CHANGES = {
    "title": "another",
    "contact.torque_N_m": 250,
    "contact.gear_ratio": 2,
    "contact.face_width_mm": "8 cm",
    "contact.pinion_pitch_diameter_mm": 110,
    "contact.working_pressure_angle_deg": 21,
    "contact.load_factor": 1.1,
    "contact.youngs_modulus_MPa": 2.06e5,
    "contact.wheel_youngs_modulus_MPa": 1.1e5,
    "contact.poissons_ratio": 0.29,
    "teeth.pinion_teeth": 35,
    "teeth.wheel_teeth": 55,
    "teeth.module_mm": 3.1,
    "combinations.torque_N_m": [600, 240],
    "combinations.gear_ratio": [5, 1.5],
    "combinations.face_width_mm": 82,
    "published.hertz.contact_stress_MPa": 454,
    "published.hertz.surface_von_mises_MPa": 190,
    "published.hertz.depth_von_mises_MPa": 260,
    "published.finite_elements.contact_stress_MPa": 420,
    "published.finite_elements.surface_von_mises_MPa": 216,
    "published.finite_elements.depth_von_mises_MPa": 228,
    "published.difference.contact_difference_percent": 9.9,
    "published.difference.surface_difference_percent": 14.1,
    "published.difference.depth_difference_percent": 12.3,
    "finite_elements.elements_per_half_width": [8],
    "finite_elements.axis_file": "axis.csv",
}


def stub(elements):
    places = np.linspace(0.0, 0.1, 2 * elements)
    return FemContact(elements, 10 * elements, 0.0, places, places + 1.0, places, places + 1.0)


def content(tables):
    loaded, axis = load_hertz_check(tables)
    meshes = [stub(elements) for elements in loaded.finite_elements.elements_per_half_width]
    return hertz_check_sheet(loaded.title, loaded.check(), meshes, axis).content


def with_value(key, value):
    *tables, last = key.split(".")
    changed = copy.deepcopy(BASE)
    place = changed
    for table in tables:
        place = place[table]
    place[last] = value
    return changed


@pytest.fixture(autouse=True)
def axis_file(tmp_path, monkeypatch):
    (tmp_path / "axis.csv").write_text("below_surface_mm,von_mises_MPa\n0,180\n0.06,250\n")
    monkeypatch.chdir(tmp_path)


def test_every_key_is_here_and_no_other(leaves):
    assert {*CHANGES, "format_version"} == set(leaves(HertzCheckTables))


@pytest.mark.parametrize(("key", "value"), CHANGES.items())
def test_key_changes_the_sheet(key, value):
    assert content(with_value(key, value)) != content(BASE)


def test_other_versions_are_refused():
    with pytest.raises(CaseError, match="format_version"):
        content(with_value("format_version", 2))


def test_defaults_are_the_sources():
    contact = load_hertz_check(BASE)[0].contact
    assert (contact.working_pressure_angle_deg, contact.youngs_modulus_MPa) == (20.0, 2.1e5)
    assert contact.poissons_ratio == 0.3
