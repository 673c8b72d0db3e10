"""Changing any key of a gear pair's file changes the result, or raises an error that names it."""

import copy
import functools
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from jsonschema import Draft202012Validator
from pydantic import BaseModel

import wearsim
from wearsim.drive.batch_lives import CaseLife
from wearsim.lubrication.keys import LubricantOption
from wearsim.mechanisms.gear_pair.keys import GearTables

pytestmark = pytest.mark.wide

DISTRIBUTION = (
    *("distribution", "sigma_ln", "median", "low", "high", "standard_deviation", "mean", "mode", "shape"),
    "scale",
)
"""Keys of the table of a key that scatters."""

WITHOUT_EFFECT = {
    **{
        f"lubrication.{key}": "only wearsim lubricate (tests/cli/test_cli_lubricate.py)"
        for key in (
            "minutes_per_application",
            "price_per_application",
            "labour_cost_per_hour",
            "consumption_ml_per_hour",
            "price_per_litre",
            *(f"option.{name}" for name in LubricantOption.model_fields),
        )
    },
    "format_version": "1 only",
    "title": "only shown",
    "mechanism.kind": "one value",
    **{
        f"film.{key}": "only the film ratio (tests/verification/test_film_ratio.py)"
        for key in ("viscosity_mPa_s", "pressure_viscosity_per_GPa", "roughness_um")
    },
    **dict.fromkeys(
        (f"uncertainty.{key}" for key in DISTRIBUTION),
        "only how sure a life is (tests/cli/test_cli_uncertainty.py)",
    ),
    **{
        f"optimise.{key}": "only wearsim optimise (tests/cli/test_cli_optimise.py)"
        for key in (
            "objectives",
            "parameters",
            *(
                f"limits.{name}.{end}"
                for name in ("life_hours", "mass_kg", "peak_pressure_MPa")
                for end in ("low", "high")
            ),
        )
    },
}

GEARS: dict[str, Any] = {
    "format_version": 1,
    "title": "gears",
    "gear": {
        "pinion_teeth": 16,
        "wheel_teeth": 24,
        "module_mm": 4.5,
        "pinion_shift": 0.1817,
        "wheel_shift": 0.1715,
        "face_width_mm": 14,
        "nodes": 61,
    },
    "load": {"torque_N_m": 200, "speed_rpm": 100},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-10},
    "stop": {"critical_depth_mm": 0.005},
    "run": {"horizon_hours": 1e6},
}
STEEL = {"treatment": "carburised", "hardness_HRC": 60.0}
POWER = {"law": "power", "coefficient": 1e-13, "pressure_exponent": 2.0}
DROZDOV = {
    "law": "drozdov",
    "coefficient": 1e-8,
    "pressure_exponent": 2.0,
    "hardness_MPa": 6000,
    "reference_speed_mm_per_s": 100,
    "speed_exponent": 0.2,
}


def with_keys(tables: dict[str, Any], *settings: tuple[str, Any]) -> dict[str, Any]:
    found = copy.deepcopy(tables)
    for key, value in settings:
        *above, last = key.split(".")
        place = found
        for table in above:
            place = place.setdefault(table, {})
        place[last] = value
    return found


def edited(*settings: tuple[str, Any], **tables: dict[str, Any]) -> dict[str, Any]:
    """The base with whole tables replaced and single keys set."""
    return with_keys({**GEARS, **tables}, *settings)


CONVEX = {
    "profile": "convex_concave",
    "pinion_teeth": 17,
    "wheel_teeth": 34,
    "module_mm": 4.5,
    "face_width_mm": 45,
    "addendum_arc_radius_mm": 10.0,
    "nodes": 61,
}
STRESS = {
    "profile": "prescribed_stress",
    "pinion_teeth": 36,
    "wheel_teeth": 54,
    "module_mm": 3.0,
    "face_width_mm": 76,
    "contact_stress_MPa": [460.0, 450.0, 460.0],
    "stress_pitch_point_distance_mm": [-9.0, 0.0, 9.0],
    "first_pitch_point_distance_mm": -7.0,
    "last_pitch_point_distance_mm": 7.0,
    "nodes": 61,
}
AGEING: dict[str, Any] = {"lasts_hours": 4.0, "fades_over_hours": 2.0, "dry_factor": 20.0}
LUBRICATED = {**AGEING, "interval_hours": 8.0, "completeness": 0.9, "contamination_factor": 1.5}
WAYS = {"interval_sliding_m": 200.0, "lasts_sliding_m": 100.0, "fades_over_sliding_m": 50.0}
PHASES = [
    {"hours": 5.0, "contaminations": 7, "contamination_factor": 3.0, "relubrications": 2},
    {"hours": 5.0, "relubrications": 3},
]
BASES = {
    "convex": edited(gear=CONVEX),
    "stress": edited(gear=STRESS, load={"torque_N_m": 240, "speed_rpm": 100}),
    "archard": edited(),
    "power": edited(wear=POWER),
    "drozdov": edited(wear=DROZDOV),
    "rigid": edited(("mechanism.load_sharing", "rigid")),
    "running in": edited(("wear.running_in_factor", 3.0), ("wear.running_in_distance_mm", 3000.0)),
    "lubricated": edited(lubrication=LUBRICATED),
    "abraded": edited(
        lubrication={**LUBRICATED, "abrasive_hardness_HV": 1100.0, "surface_hardness_HV": 700.0}
    ),
    "by way": edited(lubrication={**WAYS, "dry_factor": 20.0}),
    "programme": edited(lubrication={**AGEING, "phase": PHASES}),
    "at times": edited(lubrication={**AGEING, "at_hours": [4.5, 5.0]}),
    "by rate": edited(lubrication={**AGEING, "when_rate_exceeds": 4.0}),
    "slowing": edited(("wear.cycles_exponent", 0.8), ("wear.reference_hours", 100.0)),
    "severe": edited(("wear.pv_limit_MPa_mm_per_s", 1e5), ("wear.severe_factor", 5.0)),
    "t gamma": edited(wear={"law": "t_gamma", "coefficient": 1e-3, "friction_coefficient": 0.002}),
    "fatigue": edited(fatigue={"pinion": STEEL, "wheel": STEEL}),
    "per cycle": edited(
        ("run.method", "per_cycle"),
        ("run.cycles_per_update", 100),
        ("wear.specific_wear_rate_mm2_per_N", 1e-9),
    ),
}
"""A life of each law, sharing and method."""


CHANGES: dict[str, list[tuple[Any, ...]]] = {
    "gear.profile": [
        ("archard", "convex_concave", "gear.addendum_arc_radius_mm"),
        ("stress", "involute", "gear.contact_stress_MPa"),
        ("convex", "prescribed_stress", "gear.contact_stress_MPa"),
    ],
    "gear.pitch_point_angle_deg": [("convex", 21.0), ("archard", 21.0, "gear.pitch_point_angle_deg")],
    "gear.addendum_arc_radius_mm": [("convex", 11.0), ("convex", 2.0, "gear")],
    "gear.dedendum_arc_radius_mm": [("convex", 9.0), ("stress", 9.0, "gear.dedendum_arc_radius_mm")],
    "gear.addendum_ratio": [
        ("convex", 0.95),
        ("convex", 0.5, "gear"),
        ("archard", 0.9, "gear.addendum_ratio"),
    ],
    "gear.contact_stress_MPa": [
        ("stress", [465.0, 455.0, 465.0]),
        ("stress", 455.0, "gear.stress_pitch_point_distance_mm"),
        ("stress", [300.0, 300.0, 300.0], "gear"),
    ],
    "gear.stress_pitch_point_distance_mm": [
        ("stress", [-8.0, 0.0, 10.0]),
        ("stress", [-5.0, 0.0, 9.0], "gear.stress_pitch_point_distance_mm"),
        ("stress", [0.0, -8.0, 9.0], "gear.stress_pitch_point_distance_mm"),
    ],
    "gear.design_torque_N_m": [("stress", 235.0), ("archard", 200.0, "gear.design_torque_N_m")],
    "gear.first_pitch_point_distance_mm": [
        ("stress", -7.5),
        ("stress", 1.0, "gear.first_pitch_point_distance_mm"),
        ("stress", -1.0, "gear"),
    ],
    "gear.last_pitch_point_distance_mm": [
        ("stress", 7.5),
        ("stress", -7.5, "gear.last_pitch_point_distance_mm"),
    ],
    "gear.pinion_teeth": [
        ("convex", 18),
        ("stress", 35),
        ("archard", 17),
        ("archard", 4, "gear.pinion_teeth"),
    ],
    "gear.wheel_teeth": [("archard", 25)],
    "gear.module_mm": [("archard", 4.6)],
    "gear.pressure_angle_deg": [("archard", 20.5), ("archard", 40.0, "gear.pressure_angle_deg")],
    "gear.pinion_shift": [("archard", 0.2), ("archard", -1.9, "gear")],
    "gear.wheel_shift": [("archard", 0.2)],
    "gear.pinion_tip_radius_mm": [("archard", 41.2), ("archard", 60.0, "gear")],
    "gear.wheel_tip_radius_mm": [("archard", 59.2), ("archard", 80.0, "gear")],
    "gear.face_width_mm": [("archard", 15.0)],
    "gear.nodes": [("archard", 81)],
    "material.pinion.name": [("archard", "bronze")],
    "material.pinion.youngs_modulus_MPa": [("power", 2e5)],
    "material.pinion.poissons_ratio": [("power", 0.28)],
    "material.wheel.name": [("archard", "bronze")],
    "material.wheel.youngs_modulus_MPa": [("power", 2e5)],
    "material.wheel.poissons_ratio": [("power", 0.28)],
    "mechanism.load_sharing": [("archard", "rigid")],
    "mechanism.pair_stiffness_N_per_mm_um": [
        ("archard", 10.0),
        ("rigid", 10.0, "mechanism.pair_stiffness_N_per_mm_um"),
    ],
    "load.torque_N_m": [("archard", 210.0)],
    "load.speed_rpm": [("archard", 110.0)],
    "wear.constants": [("archard", {"k": 1.0}, "wear.constants")],
    "wear.law": [("archard", "power", "wear.specific_wear_rate_mm2_per_N")],
    "wear.condition": [("archard", "hardened, oiled", "wear.condition")],
    "wear.tooth_hardness": [("archard", "hardened", "wear.tooth_hardness")],
    "wear.specific_wear_rate_mm2_per_N": [("archard", 2e-10)],
    "wear.coefficient": [("power", 2e-13)],
    "wear.pressure_exponent": [("power", 1.8), ("power", 0.9, "wear.pressure_exponent")],
    "wear.hardness_MPa": [("drozdov", 5000)],
    "wear.reference_speed_mm_per_s": [("drozdov", 200)],
    "wear.speed_exponent": [("drozdov", 0.3)],
    "wear.case_depth_mm": [("archard", 0.01, "wear.case_depth_mm")],
    "wear.core_factor": [("archard", 2.0, "wear.core_factor")],
    "wear.roller_wear_ratio": [("archard", 0.5, "wear.roller_wear_ratio")],
    "wear.running_in_factor": [("running in", 2.0), ("archard", 2.0, "wear.running_in_distance_mm")],
    "wear.running_in_distance_mm": [("running in", 5000.0)],
    "wear.friction_coefficient": [("t gamma", 0.0024), ("archard", 0.1, "wear.friction_coefficient")],
    "wear.cycles_exponent": [("slowing", 0.7), ("archard", 0.7, "wear.reference_hours")],
    "wear.reference_hours": [("slowing", 90.0), ("archard", 90.0, "wear.cycles_exponent")],
    "wear.pv_limit_MPa_mm_per_s": [("severe", 8e4), ("archard", 1e5, "wear.severe_factor")],
    "wear.severe_factor": [("severe", 4.0), ("archard", 4.0, "wear.pv_limit_MPa_mm_per_s")],
    "wear.band_factor": [("archard", 2.0)],
    "wear.wheel_wear_ratio": [("archard", 3.0), ("archard", 0.0, "wear.wheel_wear_ratio")],
    "fatigue.load_factor": [("fatigue", 1.2), ("fatigue", 0.9, "fatigue.load_factor")],
    "stop.critical_depth_mm": [("archard", 0.006)],
    "stop.wheel_critical_depth_mm": [("archard", 0.001)],
    "run.method": [("per cycle", "advance", "run.cycles_per_update")],
    "run.cycles_per_update": [("per cycle", 50), ("archard", 2, "run.cycles_per_update")],
    "run.life_tolerance": [("archard", 1e-5)],
    "run.horizon_hours": [("archard", 1.0)],
}


CHANGES |= {
    f"fatigue.{gear}.{key}": changes
    for gear in ("pinion", "wheel")
    for key, changes in {
        "treatment": [
            ("fatigue", "surface_hardened"),
            ("fatigue", "nitrided", f"fatigue.{gear}.contact_limit_MPa"),
        ],
        "hardness_HB": [("fatigue", 590.0, f"fatigue.{gear}.hardness_HB")],
        "hardness_HRC": [("fatigue", 58.0), ("fatigue", 90.0, f"fatigue.{gear}.hardness_HRC")],
        "contact_limit_MPa": [("fatigue", 1500.0)],
        "contact_safety": [("fatigue", 1.3)],
    }.items()
}


def numbers(result: wearsim.WearResult) -> list[float]:
    lives = [result.life, result.life_low, result.life_high, *result.parts.values()]
    return [
        *(value for life in lives for value in vars(life).values()),
        result.numerical_error,
        *np.concatenate([*result.flank_columns.values(), *result.history_columns.values()]),
    ]


def test_every_key_is_covered_and_no_other(leaves: Callable[[type[BaseModel]], list[str]]) -> None:
    assert sorted([*CHANGES, *WITHOUT_EFFECT]) == sorted(leaves(GearTables))


CHANGES |= {
    f"lubrication.{key}": changes
    for key, changes in {
        "interval_hours": [("lubricated", 7.0), ("lubricated", 0.0, "lubrication.interval_hours")],
        "interval_sliding_m": [("by way", 250.0)],
        "at_hours": [("at times", [4.8]), ("lubricated", [2.0, 1.0], "lubrication.at_hours")],
        "when_rate_exceeds": [("by rate", 8.0)],
        "lasts_hours": [("lubricated", 3.0)],
        "lasts_sliding_m": [("by way", 90.0)],
        "fades_over_hours": [("lubricated", 1.0)],
        "fades_over_sliding_m": [("by way", 40.0)],
        "dry_factor": [("lubricated", 12.0)],
        "lasts_band_factor": [("lubricated", 3.0)],
        "dry_band_factor": [("lubricated", 5.0)],
        "contamination_band_factor": [("lubricated", 4.0)],
        "completeness": [("lubricated", 0.5)],
        "contamination_factor": [("lubricated", 2.0)],
        "ageing_factor": [("lubricated", 3.0)],
        "abrasive_hardness_HV": [("abraded", 500.0)],
        "surface_hardness_HV": [("abraded", 1000.0)],
        "phase.abrasive_hardness_HV": [
            (
                "programme",
                [{**PHASES[0], "abrasive_hardness_HV": 9.0}],
                "lubrication.phase.1.abrasive_hardness_HV",
            )
        ],
        "contamination_removed": [("programme", 0.2)],
        "phase.hours": [("programme", [{"hours": 7.0}])],
        "phase.contamination_factor": [("programme", [{**PHASES[0], "contamination_factor": 4.0}])],
        "phase.ageing_factor": [("programme", [{**PHASES[0], "ageing_factor": 9.0}])],
        "phase.relubrications": [("programme", [{**PHASES[0], "relubrications": 5}])],
        "phase.contaminations": [("programme", [{**PHASES[0], "contaminations": 0}])],
        "lubricant": [("lubricated", "drip", "lubrication.lubricant")],
        "environment": [("lubricated", "dust", "lubrication.environment")],
        **{
            key: [("programme", 3.0, f"lubrication.{key}")]
            for key in ("interval_km", "lasts_km", "fades_over_km")
        },
        "at_km": [("programme", [3.0], "lubrication.at_km")],
        "phase.environment": [
            ("programme", [{"hours": 7.0, "environment": "dust"}], "lubrication.phase.1.environment")
        ],
        "phase.km": [("programme", [{"km": 7.0}], "lubrication.phase.1.km")],
    }.items()
}

ALL = [(key, *change) for key, changes in CHANGES.items() for change in changes]


@functools.cache
def numbers_of_base(base: str) -> list[Any]:
    return numbers(wearsim.simulate(wearsim.load_case(BASES[base])))


@pytest.mark.parametrize("change", ALL, ids=lambda change: "-".join(map(str, change[:3])))
def test_a_changed_key_changes_the_result_or_is_named(change: tuple[Any, ...]) -> None:
    key, base, value, *named = change
    if isinstance(value, list) and "phase." in key:
        # A list of tables is given whole.
        key = "lubrication.phase"
    tables = with_keys(BASES[base], (key, value))
    if named:
        with pytest.raises(wearsim.CaseError) as error:
            wearsim.load_case(tables)
        assert named[0] in [fault.key for fault in error.value.faults]
        return
    before = numbers_of_base(base)
    after = numbers(wearsim.simulate(wearsim.load_case(tables)))
    assert before != after


def test_shipped_case_fits_the_schema_and_a_chain_does_not() -> None:
    path = Path(__file__).parents[2] / "cases" / "fzg-c14-16t-mild.toml"
    tables = tomllib.loads(path.read_text(encoding="utf-8"))
    validator = Draft202012Validator(GearTables.model_json_schema())
    assert validator.is_valid(tables)
    assert not validator.is_valid({**tables, "chain": {"designation": "16B-1"}})


def test_a_chain_in_a_gear_file_is_named() -> None:
    with pytest.raises(wearsim.CaseError, match="chain: unknown table"):
        wearsim.load_case({**GEARS, "chain": {"designation": "16B-1"}})


def test_a_result_of_gears_saves_and_loads_itself(tmp_path: Any) -> None:
    result = wearsim.simulate(wearsim.load_case(GEARS))
    result.save(tmp_path / "run")
    again = wearsim.WearResult.load(tmp_path / "run")
    assert again.life == result.life
    np.testing.assert_allclose(
        again.flank_columns["wheel_depth_mm"], result.flank_columns["wheel_depth_mm"], rtol=1e-9
    )


def test_many_lives_of_gears_are_those_alone() -> None:
    cases = [wearsim.load_case(edited(("load.torque_N_m", torque))) for torque in (150.0, 200.0)]
    found = list(wearsim.simulate_many(cases))
    for one, case in zip(found, cases, strict=True):
        assert isinstance(one, CaseLife)
        assert one.life == wearsim.simulate(case).life
