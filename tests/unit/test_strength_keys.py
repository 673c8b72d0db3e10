"""Changing any key of a strength case changes what it shows, or raises an error that names it."""

import copy
import typing
from functools import cache
from pathlib import Path

import pytest
from pydantic import BaseModel

from wearsim.errors import CaseError
from wearsim.handbook.strength.figure import strength_figure
from wearsim.handbook.strength.keys import StrengthTables
from wearsim.handbook.strength.sheet import strength_sheet
from wearsim.input.document import load_calculation
from wearsim.quantities import quantities

FOLDER = Path(__file__).parents[2] / "cases" / "sizing"

BASES = {
    name: load_calculation(FOLDER / f"strength-{name}.toml", StrengthTables).model_dump(exclude_unset=True)
    for name in ("a-tempered", "b-carburised")
}
BASES["years"] = copy.deepcopy(BASES["a-tempered"])
del BASES["years"]["drive"]["life_hours"]
BASES["years"]["drive"]["life_years"] = 2.0
BASES["nitrided"] = copy.deepcopy(BASES["b-carburised"])
for _gear in ("pinion", "wheel"):
    BASES["nitrided"][_gear] = {
        "treatment": "nitrided",
        "hardness_HRC": 60.0,
        "core_hardness_HRC": 30.0,
        "contact_limit_MPa": 1050.0,
    }
BASES["grade"] = copy.deepcopy(BASES["a-tempered"])
del BASES["grade"]["load"]["accuracy_grade"]
BASES["grade"]["load"]["initial_transverse_load_factor"] = 1.18

GEAR = {
    "treatment": ("a-tempered", "through_hardened"),
    "hardness_HB": ("a-tempered", [240, 250]),
    "hardness_HRC": ("b-carburised", 58),
    "core_hardness_HRC": ("nitrided", 32),
    "yield_strength_MPa": ("a-tempered", "700 MPa"),
    "youngs_modulus_MPa": ("a-tempered", 2e5),
    "poissons_ratio": ("a-tempered", 0.28),
    "meshings_per_revolution": ("a-tempered", 2),
    "contact_limit_MPa": ("nitrided", 1000),
    "contact_base_cycles": ("a-tempered", 5e7),
    "contact_safety": ("a-tempered", 1.2),
    "greatest_contact_life_factor": ("a-tempered", 1.01),
    "greatest_contact_MPa": ("b-carburised", 2000),
    "roughness_factor": ("a-tempered", 0.95),
    "speed_factor": ("a-tempered", 1.05),
    "bending_limit_MPa": ("a-tempered", 400),
    "bending_base_cycles": ("a-tempered", 3e6),
    "bending_exponent": ("a-tempered", 9),
    "bending_safety": ("a-tempered", 2),
    "greatest_bending_life_factor": ("a-tempered", 2),
    "greatest_bending_MPa": ("a-tempered", 1000),
    "fillet_factor": ("a-tempered", 1.05),
    "reversal_factor": ("a-tempered", 0.8),
    "form_factor": ("a-tempered", 4),
}
CHANGES = {
    "title": ("a-tempered", "another"),
    "drive.pinion_speed_rpm": ("a-tempered", 300),
    "drive.gear_ratio": ("a-tempered", 3),
    "drive.life_hours": ("a-tempered", 5000),
    "drive.life_years": ("years", 3),
    "drive.year_share": ("years", 0.5),
    "drive.day_share": ("years", 0.5),
    "drive.regime": ("a-tempered", "III"),
    "load_spectrum": ("b-carburised", [{"relative_torque": 1.0, "share_of_time": 1.0}]),
    "load_spectrum.relative_torque": ("b-carburised", 0.9),
    "load_spectrum.share_of_time": ("b-carburised", 0.4000005),
    "load_spectrum.overload_cycles": ("b-carburised", 500),
    **{f"{gear}.{key}": change for gear in ("pinion", "wheel") for key, change in GEAR.items()},
    "fatigue.base_cycles": ("a-tempered", "source"),
    "fatigue.long_life": ("b-carburised", "gost"),
    "overload.overload_ratio": ("a-tempered", 2),
    "overload.overload_frequency_factor": ("a-tempered", 1.1),
    "overload.static_safety": ("a-tempered", 1.5),
    "load.pinion_torque_N_m": ("a-tempered", "0.25 kN*m"),
    "load.module_mm": ("a-tempered", 5),
    "load.pinion_teeth": ("a-tempered", 22),
    "load.face_width_mm": ("a-tempered", 70),
    "load.pressure_angle_deg": ("a-tempered", 22),
    "load.application_factor": ("a-tempered", 1.1),
    "load.initial_face_load_factor": ("a-tempered", 1.3),
    "load.running_in_share": ("a-tempered", 0.5),
    "load.accuracy_grade": ("a-tempered", 7),
    "load.initial_transverse_load_factor": ("grade", 1.1),
    "load.contact_dynamic_factor": ("a-tempered", 1.1),
    "load.bending_dynamic_factor": ("a-tempered", 1.2),
    "load.formula": ("a-tempered", "printed"),
}

CONFLICTS = {
    "drive.life_hours": ("years", 100),
    "drive.regime": ("b-carburised", "I"),
    "drive.day_share": ("a-tempered", 0.5),
    "load_spectrum.share_of_time": ("b-carburised", 0.5),
    "load_spectrum.overload_cycles": ("b-carburised", 5e4),
    "pinion.hardness_HRC": ("a-tempered", 28),
    "pinion.core_hardness_HRC": ("b-carburised", 30),
    "wheel.yield_strength_MPa": ("b-carburised", 800),
    "wheel.bending_limit_MPa": ("nitrided", 700),
    "wheel.greatest_contact_MPa": ("a-tempered", 1500),
    "load.initial_transverse_load_factor": ("a-tempered", 1.1),
}
NAMED = {
    "drive.life_hours": "life_years",
    "load_spectrum.share_of_time": "load_spectrum",
    "load_spectrum.overload_cycles": "load_spectrum.4.overload_cycles: must be less than 50000",
    "pinion.hardness_HRC": "hardness_HB",
    "wheel.bending_limit_MPa": "core_hardness_HRC",
    "wheel.greatest_contact_MPa": "yield_strength_MPa",
    "load.initial_transverse_load_factor": "accuracy_grade",
}
"""What the message says where it stands at another key."""


def keys(model, lead=""):
    for name, field in model.model_fields.items():
        kinds = (field.annotation, *typing.get_args(field.annotation))
        tables = [kind for kind in kinds if isinstance(kind, type) and issubclass(kind, BaseModel)]
        if not tables or field.annotation is not tables[0]:
            yield lead + name
        if tables:
            yield from keys(tables[0], f"{lead}{name}.")


@cache
def of_base(name):
    return shown(BASES[name])


def shown(tables):
    found = load_calculation(tables, StrengthTables)
    sheet = strength_sheet(found, found.strength())
    return sheet.text, dict(sheet.content), sheet.warnings


def changed(base, key, value):
    tables = copy.deepcopy(BASES[base])
    *path, last = key.split(".")
    place = tables
    for name in path:
        place = place.setdefault(name, {})
    if isinstance(place, list):
        place = next(step for step in place if last in step)
    place[last] = value
    return tables


def test_every_key_is_changed_here():
    assert set(CHANGES) == set(keys(StrengthTables)) - {"format_version", "load"}


@pytest.mark.parametrize("key", CHANGES)
def test_change_is_seen(key):
    base, value = CHANGES[key]
    assert shown(changed(base, key, value)) != of_base(base)


@pytest.mark.parametrize("key", CONFLICTS)
def test_what_does_not_fit_is_named(key):
    base, value = CONFLICTS[key]
    with pytest.raises(CaseError) as caught:
        shown(changed(base, key, value))
    assert NAMED.get(key, key) in str(caught.value)


def test_without_load_the_allowable_stresses_are_left():
    tables = copy.deepcopy(BASES["a-tempered"])
    del tables["load"]
    text, content, warnings = shown(tables)
    assert "609.1" in text
    assert "acting" not in text
    assert content["gears"][0]["allowable_contact_MPa"] == pytest.approx(609.0915590772, rel=1e-9)
    assert "contact_margin" not in content["gears"][0]
    assert warnings == ()


def lines(tables):
    """Lines of both panels of the picture by their labels."""
    pair = load_calculation(tables, StrengthTables).strength()
    return [
        {line.get_label(): line.get_xydata() for line in panel.get_lines()}
        for panel in strength_figure("title", pair).axes
    ]


def test_picture():
    """Crosses stand where a life is found, on the stress that acts; nothing acts without a load."""
    contact, bending = lines(BASES["a-tempered"])
    gears = of_base("a-tempered")[1]["gears"]
    for gear in gears:
        cross = contact[f"life, {gear['gear']}"]
        assert cross.tolist() == [[gear["contact_life_hours"], gear["contact_stress_MPa"]]]
        assert bending[f"acting, {gear['gear']}"][0, 1] == gear["bending_stress_MPa"]
        assert f"life, {gear['gear']}" not in bending
    alone = {name: table for name, table in BASES["a-tempered"].items() if name != "load"}
    assert not any("acting" in label for panel in lines(alone) for label in panel)


@pytest.mark.parametrize("base", BASES)
def test_names_are_quantities(base):
    _, content, _ = of_base(base)
    names = {*content, *content["gears"][0], *(key.rpartition(".")[2] for key in CHANGES)}
    assert names - set(quantities()) == {"load_spectrum"}


@pytest.mark.parametrize(
    ("base", "key", "value", "words"),
    [
        ("a-tempered", "pinion.hardness_HB", 400, "pinion.hardness_HB: table 2.3 holds for at most"),
        ("b-carburised", "wheel.hardness_HRC", 50, "wheel.hardness_HRC: table 2.3 holds for 56 to 63"),
        ("a-tempered", "wheel.bending_safety", 1.2, "wheel.bending_safety: the source uses 1.4 to"),
        ("b-carburised", "title", "as it is", "overload_frequency_factor: 1.2 applies to single"),
        ("a-tempered", "load.pinion_teeth", 16, "16 teeth without profile shift are undercut"),
        ("a-tempered", "load.pinion_torque_N_m", 400, "pinion: the contact stress of 721.9 MPa exce"),
        ("a-tempered", "load.face_width_mm", 30, "wheel: the bending stress of 320.4 MPa exceeds"),
        ("a-tempered", "overload.overload_ratio", 20, "pinion: the bending stress at overload"),
        (
            "a-tempered",
            "wheel",
            {"treatment": "quenched_and_tempered", "hardness_HB": 250},
            "cannot be checked",
        ),
    ],
)
def test_warnings(base, key, value, words):
    assert any(words in text for text in shown(changed(base, key, value))[2])


def test_no_warning_without_reason():
    assert shown(BASES["a-tempered"])[2] == ()
    enough = changed("a-tempered", "load.pinion_teeth", 17)
    enough["load"]["module_mm"] = 5.0
    assert shown(enough)[2] == ()


@pytest.mark.parametrize("value", [[302, 269], [0, 269], [269], ["a", 3], True, "hard"])
def test_a_band_of_hardness_has_two_ends(value):
    with pytest.raises(CaseError, match=r"pinion.hardness_HB: must be a"):
        shown(changed("a-tempered", "pinion.hardness_HB", value))
