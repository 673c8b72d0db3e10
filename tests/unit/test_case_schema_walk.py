"""Changing any key of the input file changes the result, or raises an error that names it."""

import ezdxf
import numpy as np
import pandas as pd
import pytest

import wearsim
from wearsim.case.keys import CaseTables
from wearsim.drive.load_case import load_case
from wearsim.errors import CaseError
from wearsim.lubrication.keys import LubricantOption
from wearsim.report.flank_view import profile_table

pytestmark = pytest.mark.wide

DISTRIBUTION = (
    *("distribution", "sigma_ln", "median", "low", "high", "standard_deviation", "mean", "mode", "shape"),
    "scale",
)
"""Keys of the table of a key that scatters."""

WITHOUT_EFFECT = {
    "title": "only shown above the answer",
    "drive.service_factor": "only the rating that check prints (test_cli_check_rating.py)",
    "drive.joint_application_factor": "only the rating that check prints (test_cli_check_rating.py)",
    "duty.power_share": "only drives of several driven sprockets (tests/cli/test_drive_loop.py)",
    "drive.joint_friction": "only heat and efficiency of a whole drive (tests/cli/test_drive_loop.py)",
    "maintenance.currency": "only wearsim maintain (tests/verification/test_year_plan.py)",
    "maintenance.chain_price": "only wearsim maintain (tests/unit/test_maintain.py)",
    "maintenance.sprocket_price": "only wearsim maintain (tests/unit/test_maintain.py)",
    "maintenance.downtime_hours": "only wearsim maintain (tests/unit/test_maintain.py)",
    "maintenance.downtime_cost_per_hour": "only wearsim maintain (tests/unit/test_maintain.py)",
    "maintenance.turn_sprocket": "only wearsim maintain (tests/unit/test_maintain.py)",
    "maintenance.replace_at_percent": "only wearsim maintain (tests/unit/test_maintain.py)",
    **{
        f"film.{key}": "only the film ratio, printed by check (tests/verification/test_film_ratio.py)"
        for key in ("viscosity_mPa_s", "pressure_viscosity_per_GPa", "roughness_um")
    },
    "service.km_per_hour": "only how hours are shown (tests/cli/test_cli_maintain.py)",
    "service.tonnes_per_hour": "only how hours are shown (tests/cli/test_cli_maintain.py)",
    "service.hours_per_day": "only how hours are shown (tests/cli/test_cli_maintain.py)",
    "service.start_date": "only how hours are shown (tests/cli/test_cli_maintain.py)",
    "lubrication.minutes_per_application": "only wearsim lubricate (tests/cli/test_cli_lubricate.py)",
    "lubrication.price_per_application": "only wearsim lubricate (tests/cli/test_cli_lubricate.py)",
    "lubrication.labour_cost_per_hour": "only wearsim lubricate (tests/cli/test_cli_lubricate.py)",
    "lubrication.consumption_ml_per_hour": "only wearsim lubricate (tests/cli/test_cli_lubricate.py)",
    "lubrication.price_per_litre": "only wearsim lubricate (tests/cli/test_cli_lubricate.py)",
    **{
        f"lubrication.option.{key}": "only wearsim lubricate (tests/cli/test_cli_lubricate.py)"
        for key in LubricantOption.model_fields
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
    "sprocket.back_flank": "the back flank carries no load; it only limits the tooth",
    **{
        f"sprocket.{key}_mm": "only the exported wheel (tests/cli/test_cli_export_bore.py)"
        for key in ("bore", "keyway_width", "keyway_depth", "hub_diameter", "hub_length")
    },
}

STRAND = {
    "format_version": 1,
    "title": "strand",
    "chain": {"designation": "16B-1"},
    "sprocket": {
        "teeth": 20,
        "profile": "evolute",
        "face_width_mm": 17.0,
        "evolute_offset_mm": 5.5,
        "contact_start_mm": 30.67,
        "contact_end_mm": 4.0,
        "nodes": 61,
    },
    "load": {"tension_N": 5000, "speed_rpm": 100},
    "wear": {"condition": "hardened, oiled"},
    "stop": {"critical_depth_mm": 0.05},
}


def edited(base, **tables):
    """The base with whole tables replaced, or dropped where None."""
    return {name: value for name, value in {**base, **tables}.items() if value is not None}


WRAP = {
    "format_version": 1,
    "title": "wrap",
    "chain": {"designation": "08B-1"},
    "sprocket": {"teeth": 13, "profile": "iso606", "nodes": 101},
    "drive": {"mate_teeth": 20, "links": 60, "slack_tension_N": 30},
    "mechanism": {"phases": 2, "friction_roller_tooth": 0.1, "friction_roller_bush": 0.1},
    "joint": {"specific_wear_rate_mm2_per_N": 1e-9},
    "load": {"tension_N": 800, "speed_rpm": 200},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-9},
    "stop": {"critical_depth_mm": 0.05},
    "run": {"horizon_hours": 100, "life_tolerance": 0.1},
}
LAYERS = {"case_depth_mm": 0.02, "core_factor": 4.0, "running_in_factor": 2.0, "running_in_distance_mm": 20.0}
OWN_CHAIN = {
    "pitch_mm": 12.7,
    "roller_diameter_mm": 8.51,
    "inner_width_mm": 7.75,
    "pin_diameter_mm": 4.45,
    "bearing_area_mm2": 50.3,
    "mass_kg_per_m": 0.7,
}

AGEING = {"lubricant": "manual", "lasts_hours": 12.0, "fades_over_hours": 8.0}
LUBRICATED = {
    **AGEING,
    "interval_hours": 30.0,
    "dry_factor": 20.0,
    "completeness": 0.9,
    "contamination_factor": 1.5,
}
QUARTZ = {"abrasive_hardness_HV": 1100.0, "surface_hardness_HV": 700.0}
PHASES = [
    {"hours": 20.0, "contaminations": 7, "contamination_factor": 3.0, "relubrications": 2},
    {"km": 200.0, "relubrications": 3},
]

JOINT_LAW = {
    "specific_wear_rate_mm2_per_N": 1e-9,
    "law": "pressure_speed",
    "pressure_exponent": 2.0,
    "speed_exponent": 0.7,
    "pitch_exponent": 0.3,
    "reference_pressure_MPa": 20.0,
    "reference_speed_rpm": 400.0,
    "reference_pitch_mm": 25.4,
}

BASES = {
    "strand": STRAND,
    "wrap": WRAP,
    "joint law": edited(WRAP, joint=JOINT_LAW),
    "joint state": edited(WRAP, joint={"condition": "normalised, greased"}),
    "short chain": edited(WRAP, stop={"critical_depth_mm": 0.05, "elongation_percent": 0.01}),
    "own wrap": edited(
        WRAP, chain=OWN_CHAIN, drive={"mate_teeth": 20, "links": 60}, load={"power_kW": 0.4, "speed_rpm": 200}
    ),
    "distance": edited(WRAP, drive={"mate_teeth": 20, "centre_distance_mm": 270, "slack_tension_N": 30}),
    "layers": edited(STRAND, wear={"specific_wear_rate_mm2_per_N": 1e-10, **LAYERS}),
    "wrap layers": edited(WRAP, wear={**WRAP["wear"], **LAYERS, "case_depth_mm": 0.002}),
    "gost": edited(WRAP, sprocket={"teeth": 13, "profile": "gost591", "nodes": 101}),
    "between forms": edited(
        WRAP,
        sprocket={
            "teeth": 13,
            "profile": "iso606",
            "seat_radius_mm": 4.35,
            "flank_radius_mm": 18.0,
            "seating_angle_deg": 125.0,
            "nodes": 101,
        },
    ),
    "max form": edited(WRAP, sprocket={"teeth": 13, "profile": "iso606", "form": "max", "nodes": 101}),
    "drawing": edited(
        WRAP,
        sprocket={"teeth": 13, "profile": "dxf", "dxf_file": "gap.dxf", "dxf_layer": "first", "nodes": 101},
    ),
    "open drawing": edited(
        WRAP,
        sprocket={
            "teeth": 13,
            "profile": "dxf",
            "dxf_file": "open.dxf",
            "dxf_join_tolerance_mm": 0.021,
            "nodes": 101,
        },
    ),
    "catalogue": edited(STRAND, sprocket={"teeth": 20, "profile": "evolute", "nodes": 61}),
    "crawler": edited(
        STRAND,
        chain={"pitch_mm": 203.2, "roller_diameter_mm": 66.0, "inner_width_mm": 90.0},
        sprocket={
            "teeth": 27,
            "engaged_every": 2,
            "profile": "evolute",
            "evolute_offset_mm": 42.9,
            "contact_start_mm": 212.2,
            "contact_end_mm": 8.0,
            "nodes": 61,
        },
    ),
    "own chain": edited(
        STRAND, chain={"pitch_mm": 25.4, "roller_diameter_mm": 15.88, "inner_width_mm": 17.02}
    ),
    "lubricated": edited(STRAND, wear=None, stop=None, lubrication=LUBRICATED, service={"km_per_hour": 10}),
    "abraded": edited(STRAND, wear=None, stop=None, lubrication={**LUBRICATED, **QUARTZ}),
    "abraded programme": edited(
        STRAND,
        wear=None,
        stop=None,
        service={"km_per_hour": 10},
        lubrication={
            **AGEING,
            "surface_hardness_HV": 700.0,
            "phase": [{**PHASES[0], "abrasive_hardness_HV": 1100.0}, PHASES[1]],
        },
    ),
    "by km": edited(
        STRAND,
        wear=None,
        stop=None,
        service={"km_per_hour": 10},
        lubrication={"lubricant": "manual", "interval_km": 300.0, "lasts_km": 120.0, "fades_over_km": 80.0},
    ),
    "by way": edited(
        STRAND,
        wear=None,
        stop=None,
        lubrication={
            "lubricant": "manual",
            "interval_sliding_m": 20.0,
            "lasts_sliding_m": 10.0,
            "fades_over_sliding_m": 8.0,
        },
    ),
    "programme": edited(
        STRAND, wear=None, stop=None, service={"km_per_hour": 10}, lubrication={**AGEING, "phase": PHASES}
    ),
    "km programme": edited(
        STRAND,
        wear=None,
        stop=None,
        service={"km_per_hour": 10},
        lubrication={**AGEING, "phase": PHASES[::-1]},
    ),
    "at times": edited(
        STRAND,
        wear=None,
        stop=None,
        service={"km_per_hour": 10},
        lubrication={**AGEING, "at_hours": [30.0, 60.0]},
    ),
    "at km": edited(
        STRAND,
        wear=None,
        stop=None,
        service={"km_per_hour": 10},
        lubrication={**AGEING, "at_km": [300.0, 600.0]},
    ),
    "by rate": edited(STRAND, wear=None, stop=None, lubrication={**AGEING, "when_rate_exceeds": 4.0}),
    "default width": edited(
        STRAND,
        chain={"pitch_mm": 25.4, "roller_diameter_mm": 15.88, "inner_width_mm": 17.02},
        sprocket={"teeth": 20, "profile": "evolute", "nodes": 61},
    ),
    "power drive": edited(STRAND, load={"power_kW": 3, "speed_rpm": 100}),
    "torque drive": edited(STRAND, load={"torque_N_m": 300, "speed_rpm": 100}),
    "archard": edited(STRAND, wear={"specific_wear_rate_mm2_per_N": 1e-10, "band_factor": 2}),
    "power law": edited(STRAND, wear={"law": "power", "coefficient": 1e-14, "pressure_exponent": 2.0}),
    "drozdov": edited(
        STRAND,
        wear={
            "law": "drozdov",
            "coefficient": 1e-6,
            "pressure_exponent": 1.5,
            "hardness_MPa": 4000,
            "reference_speed_mm_per_s": 300,
            "speed_exponent": -0.3,
        },
    ),
    "tip land": edited(STRAND, stop={"critical_depth_mm": 0.2, "min_tip_land_mm": 9.07}),
    "per cycle": edited(
        STRAND,
        wear={"specific_wear_rate_mm2_per_N": 1e-7},
        run={"method": "per_cycle", "cycles_per_update": 1},
    ),
    "points": edited(
        STRAND,
        sprocket={
            "teeth": 20,
            "profile": "points",
            "points_file": "points.csv",
            "points_noise_mm": 1e-4,
            "face_width_mm": 17.0,
            "evolute_offset_mm": 5.5,
            "contact_start_mm": 30.6,
            "contact_end_mm": 4.1,
            "nodes": 61,
        },
    ),
    "prescribed": edited(
        STRAND,
        sprocket=None,
        load={"speed_rpm": 100},
        mechanism={"kind": "prescribed", "table_file": "loads.csv"},
    ),
}

SLOWING = {"cycles_exponent": 0.8, "reference_hours": 100.0}
BASES |= {
    "slowing": edited(STRAND, wear={"specific_wear_rate_mm2_per_N": 1e-10, **SLOWING}),
    "wrap slowing": edited(WRAP, wear={**WRAP["wear"], **SLOWING}),
    "severe": edited(
        STRAND,
        wear={"specific_wear_rate_mm2_per_N": 1e-10, "pv_limit_MPa_mm_per_s": 2e5, "severe_factor": 5.0},
    ),
    "t gamma": edited(
        BASES["prescribed"], wear={"law": "t_gamma", "coefficient": 1e-3, "friction_coefficient": 0.02}
    ),
    "duty": edited(
        STRAND,
        load=None,
        duty=[
            {"share_of_time": 0.5, "tension_N": 5000, "speed_rpm": 50},
            {"share_of_time": 0.5, "tension_N": 3000, "speed_rpm": 150},
        ],
    ),
    "duty of cycles": edited(
        STRAND,
        load=None,
        duty=[
            {"share_of_cycles": 0.5, "power_kW": 2, "speed_rpm": 50},
            {"share_of_cycles": 0.5, "torque_N_m": 300, "speed_rpm": 150},
        ],
    ),
    "duty torque": edited(
        STRAND,
        load=None,
        duty=[
            {"share_of_cycles": 0.5, "torque_N_m": 300, "speed_rpm": 150},
            {"share_of_cycles": 0.5, "power_kW": 2, "speed_rpm": 50},
        ],
    ),
    "wrap duty": edited(
        WRAP,
        load=None,
        duty=[
            {"share_of_cycles": 0.5, "tension_N": 800, "speed_rpm": 200, "wear_factor": 2},
            {"share_of_cycles": 0.5, "tension_N": 400, "speed_rpm": 200},
        ],
    ),
    "log": edited(STRAND, load={"duty_file": "duty.csv"}),
    "regime": edited(STRAND, load={"tension_N": 5000, "speed_rpm": 100, "regime": "II"}),
}

FATIGUE = {"load_factor": 1.1, "sprocket": {"treatment": "surface_hardened", "hardness_HRC": 45.0}}
SOFT = {**FATIGUE, "sprocket": {"treatment": "quenched_and_tempered", "hardness_HB": 300.0}}
BASES |= {
    "fatigue": edited(STRAND, fatigue=FATIGUE),
    "soft fatigue": edited(STRAND, fatigue=SOFT),
    "prescribed fatigue": edited(BASES["prescribed"], fatigue=SOFT),
    "wrap fatigue": edited(WRAP, load={"tension_N": 2500, "speed_rpm": 200}, fatigue=SOFT),
}

# Key: (base, another value) for a change of the result, (base, value, fault's key) for an error.
CHANGES = {
    "format_version": [("strand", 2, "format_version")],
    "chain.designation": [("catalogue", "16A-1"), ("own chain", "16B-1", "chain.pitch_mm")],
    "chain.pitch_mm": [("own chain", 25.0), ("strand", 25.4, "chain.pitch_mm")],
    "chain.roller_diameter_mm": [("own chain", 15.0)],
    "chain.inner_width_mm": [("default width", 16.0)],
    "sprocket.teeth": [("wrap", 14), ("strand", 21), ("strand", 4, "sprocket.teeth")],
    "sprocket.profile": [
        ("wrap", "ansi_b29", "sprocket.profile"),
        ("strand", "iso606", "sprocket.evolute_offset_mm"),
        ("strand", "points", "sprocket.points_file"),
    ],
    "sprocket.engaged_every": [("crawler", 1)],
    "sprocket.points_file": [("points", "other.csv"), ("strand", "points.csv", "sprocket.points_file")],
    "sprocket.points_noise_mm": [("points", 3e-4), ("strand", 1e-4, "sprocket.points_noise_mm")],
    "sprocket.face_width_mm": [("strand", 16.0), ("points", 16.0)],
    "sprocket.evolute_offset_mm": [("strand", 5.6), ("points", 5.45)],
    "sprocket.contact_start_mm": [("strand", 30.6), ("points", 30.5)],
    "sprocket.contact_end_mm": [("strand", 4.1), ("points", 4.2)],
    "sprocket.nodes": [("wrap", 111), ("strand", 71), ("points", 71)],
    "mechanism.kind": [("strand", "prescribed", "mechanism.table_file")],
    "mechanism.table_file": [
        ("prescribed", "other_loads.csv"),
        ("strand", "loads.csv", "mechanism.table_file"),
    ],
    "mechanism.roller_slip_fraction": [("wrap", 0.2), ("strand", 0.5), ("prescribed", 0.5)],
    "material.sprocket.name": [("strand", "grey cast iron"), ("prescribed", "bronze")],
    "material.sprocket.youngs_modulus_MPa": [("strand", 1e5)],
    "material.sprocket.poissons_ratio": [("strand", 0.25)],
    "material.roller.name": [("strand", "bronze")],
    "material.roller.youngs_modulus_MPa": [("strand", 1e5)],
    "material.roller.poissons_ratio": [("strand", 0.25)],
    "load.tension_N": [("strand", 5001), ("power drive", 5000, "load.power_kW")],
    "load.power_kW": [("power drive", 3.01), ("strand", 3, "load.power_kW")],
    "load.torque_N_m": [("torque drive", 301), ("strand", 3, "load.torque_N_m")],
    "load.speed_rpm": [("strand", 101), ("power drive", 101), ("prescribed", 101)],
    "wear.law": [("strand", "power", "wear.condition")],
    "wear.condition": [("strand", "soil-contaminated"), ("archard", "hardened, dry", "wear.condition")],
    "wear.tooth_hardness": [("lubricated", "normalised"), ("archard", "hardened", "wear.tooth_hardness")],
    "wear.specific_wear_rate_mm2_per_N": [("archard", 2e-10), ("strand", 1e-10, "wear.condition")],
    "wear.coefficient": [("power law", 2e-14), ("drozdov", 2e-6)],
    "wear.constants": [("strand", {"k": 1.0}, "wear.constants")],
    "wear.pressure_exponent": [
        ("power law", 2.01),
        ("drozdov", 1.51),
        ("archard", 1.0, "wear.pressure_exponent"),
    ],
    "wear.hardness_MPa": [("drozdov", 4100), ("power law", 4000, "wear.hardness_MPa")],
    "wear.reference_speed_mm_per_s": [("drozdov", 310), ("power law", 300, "wear.reference_speed_mm_per_s")],
    "wear.speed_exponent": [("drozdov", -0.2), ("power law", 0.1, "wear.speed_exponent")],
    "wear.friction_coefficient": [("t gamma", 0.025), ("strand", 0.3, "wear.friction_coefficient")],
    "wear.cycles_exponent": [
        ("slowing", 0.7),
        ("wrap slowing", 0.7),
        ("strand", 0.7, "wear.reference_hours"),
        ("layers", 0.7, "wear.cycles_exponent"),
    ],
    "wear.reference_hours": [
        ("slowing", 90.0),
        ("wrap slowing", 90.0),
        ("strand", 90.0, "wear.cycles_exponent"),
    ],
    "wear.pv_limit_MPa_mm_per_s": [("severe", 2.2e5), ("strand", 2e5, "wear.severe_factor")],
    "wear.severe_factor": [("severe", 4.0), ("strand", 4.0, "wear.pv_limit_MPa_mm_per_s")],
    "wear.band_factor": [("archard", 2.5), ("strand", 2.5), ("power law", 2.5), ("drozdov", 2.5)],
    "stop.critical_depth_mm": [("strand", 0.06), ("prescribed", 0.06)],
    "stop.min_tip_land_mm": [("tip land", 9.08), ("prescribed", 1.0, "stop.min_tip_land_mm")],
    "chain.pin_diameter_mm": [
        ("own wrap", 4.4),
        ("wrap", 4.4, "chain.pin_diameter_mm"),
        ("own chain", 4.4, "chain.pin_diameter_mm"),
    ],
    "chain.bush_diameter_mm": [("wrap", 6.0), ("own wrap", 9.0, "chain.bush_diameter_mm")],
    "chain.bearing_area_mm2": [("own wrap", 50.0), ("wrap", 50.0, "chain.bearing_area_mm2")],
    "chain.strands": [("wrap", 2), ("own wrap", 2)],
    "chain.mass_kg_per_m": [("own wrap", 0.71), ("wrap", 0.71)],
    "sprocket.role": [("wrap", "driven"), ("strand", "driven", "sprocket.role")],
    "sprocket.form": [("wrap", "max"), ("gost", "max", "sprocket.form")],
    "sprocket.seat_radius_mm": [
        ("between forms", 4.4),
        ("between forms", 4.6, "sprocket.seat_radius_mm"),
        ("gost", 4.4, "sprocket.seat_radius_mm"),
        ("max form", 4.4, "sprocket.seat_radius_mm"),
    ],
    "sprocket.flank_radius_mm": [
        ("between forms", 17.0),
        ("between forms", 15.0, "sprocket.flank_radius_mm"),
        ("max form", 17.0, "sprocket.flank_radius_mm"),
    ],
    "sprocket.seating_angle_deg": [
        ("between forms", 120.0),
        ("between forms", 134.0, "sprocket.seating_angle_deg"),
        ("max form", 120.0, "sprocket.seating_angle_deg"),
    ],
    "sprocket.displaced": [("gost", True), ("wrap", True, "sprocket.displaced")],
    "sprocket.seat_centre": [
        ("wrap", "root_diameter"),
        ("gost", "root_diameter"),
        ("strand", "root_diameter", "sprocket.seat_centre"),
    ],
    "sprocket.tip_diameter_mm": [("wrap", 57.0), ("drawing", 57.0, "sprocket.tip_diameter_mm")],
    "sprocket.dxf_file": [("drawing", "other.dxf"), ("wrap", "gap.dxf", "sprocket.dxf_file")],
    "sprocket.dxf_layer": [("drawing", "second"), ("drawing", "third", "sprocket.dxf_file")],
    "sprocket.dxf_join_tolerance_mm": [
        ("open drawing", 0.019, "sprocket.dxf_file"),
        ("open drawing", 0.2, "sprocket.dxf_join_tolerance_mm"),
        ("wrap", 0.01, "sprocket.dxf_join_tolerance_mm"),
    ],
    "drive.mate_teeth": [("wrap", 21), ("strand", 21, "drive.mate_teeth")],
    "drive.links": [("wrap", 62), ("wrap", 12, "drive.links"), ("distance", 60, "drive.centre_distance_mm")],
    "drive.centre_distance_mm": [("distance", 300), ("distance", 20, "drive.centre_distance_mm")],
    "drive.slack_tension_N": [("wrap", 31), ("wrap", 0.01, "drive.slack_tension_N")],
    "drive.sag_percent": [("own wrap", 1.9), ("wrap", 2, "drive.sag_percent")],
    "drive.inclination_deg": [
        ("own wrap", 30),
        ("own wrap", 90, "drive.inclination_deg"),
        ("wrap", 30, "drive.inclination_deg"),
    ],
    "drive.link_stiffness_N_per_mm": [("wrap", 4e4)],
    "mechanism.phases": [("wrap", 3), ("strand", 3, "mechanism.phases")],
    "mechanism.friction_roller_tooth": [("wrap", 0.02), ("strand", 0.02, "mechanism.friction_roller_tooth")],
    "mechanism.friction_roller_bush": [("wrap", 0.02), ("strand", 0.02, "mechanism.friction_roller_bush")],
    "joint.specific_wear_rate_mm2_per_N": [
        ("wrap", 1.1e-9),
        ("strand", 1e-9, "joint.specific_wear_rate_mm2_per_N"),
    ],
    "joint.source": [("strand", "a rig", "joint.source")],
    "joint.condition": [("joint state", "hardened, dry"), ("joint state", "oily", "joint.condition")],
    "joint.law": [("joint state", "constant"), ("joint law", "constant", "joint.pressure_exponent")],
    "joint.pressure_exponent": [("joint law", 1.6), ("wrap", 1.6, "joint.pressure_exponent")],
    "joint.speed_exponent": [("joint law", 0.5), ("wrap", 0.5, "joint.speed_exponent")],
    "joint.pitch_exponent": [("joint law", 0.5), ("wrap", 0.5, "joint.pitch_exponent")],
    "joint.reference_pressure_MPa": [("joint law", 25.0), ("wrap", 25.0, "joint.reference_pressure_MPa")],
    "joint.reference_speed_rpm": [("joint law", 600.0), ("wrap", 600.0, "joint.reference_speed_rpm")],
    "joint.reference_pitch_mm": [("joint law", 38.1), ("wrap", 38.1, "joint.reference_pitch_mm")],
    "joint.band_factor": [("short chain", 5.0), ("wrap", 0.5, "joint.band_factor")],
    "joint.pitch": [("wrap", "uniform")],
    "stop.elongation_percent": [("wrap", 0.01), ("strand", 1.0, "stop.elongation_percent")],
    "wear.case_depth_mm": [("layers", 0.03), ("wrap layers", 0.001), ("strand", 0.03, "wear.core_factor")],
    "wear.core_factor": [("layers", 3.0), ("wrap layers", 3.0), ("strand", 3.0, "wear.case_depth_mm")],
    "wear.running_in_factor": [
        ("layers", 3.0),
        ("wrap layers", 3.0),
        ("strand", 3.0, "wear.running_in_distance_mm"),
    ],
    "wear.running_in_distance_mm": [
        ("layers", 30.0),
        ("wrap layers", 30.0),
        ("strand", 3.0, "wear.running_in_factor"),
    ],
    "stop.case_depth_mm": [("strand", 0.02), ("wrap", 0.001)],
    "stop.min_tooth_thickness_mm": [
        ("strand", 7.57),
        ("prescribed", 1.0, "stop.min_tooth_thickness_mm"),
        ("wrap", 50.0, "stop.min_tooth_thickness_mm"),
    ],
    "stop.over_pins_change_mm": [("wrap", 0.0001), ("strand", 0.1, "stop.over_pins_change_mm")],
    "stop.min_slack_tension_N": [
        ("wrap", 2.0),
        ("wrap", 30.1, "stop.min_slack_tension_N"),
        ("wrap", 1e-6, "stop.min_slack_tension_N"),
        ("strand", 1.0, "stop.min_slack_tension_N"),
    ],
    "wear.roller_wear_ratio": [("wrap", 0.5), ("strand", 0.5, "wear.roller_wear_ratio")],
    "run.method": [("per cycle", "advance", "run.cycles_per_update"), ("archard", "per_cycle")],
    "run.cycles_per_update": [("per cycle", 2), ("strand", 2, "run.cycles_per_update")],
    "run.life_tolerance": [("strand", 1e-5)],
    "run.horizon_hours": [("strand", 100)],
}


CHANGES |= {
    "duty.share_of_time": [("duty", 0.5000005), ("duty of cycles", 0.5, "duty.1.share_of_cycles")],
    "duty.share_of_cycles": [("duty of cycles", 0.5000005), ("duty", 0.5, "duty.1.share_of_cycles")],
    "duty.tension_N": [("duty", 5001), ("duty of cycles", 5000, "duty.1.power_kW")],
    "duty.power_kW": [("duty of cycles", 2.01), ("duty", 2, "duty.1.power_kW")],
    "duty.torque_N_m": [("duty torque", 301), ("duty", 300, "duty.1.torque_N_m")],
    "duty.speed_rpm": [("duty", 51), ("duty of cycles", 51)],
    "duty.wear_factor": [("duty", 2), ("duty", 0, "duty.1.wear_factor")],
    "duty.applies_to": [("wrap duty", "joints"), ("duty", "joints", "duty.1.applies_to")],
    "lubrication.lubricant": [
        ("lubricated", "wet drip"),
        ("lubricated", "drip", "lubrication.interval_hours"),
    ],
    "lubrication.environment": [
        ("programme", "dust"),
        ("lubricated", "clean", "lubrication.contamination_factor"),
    ],
    "lubrication.interval_hours": [("lubricated", 25.0), ("lubricated", 0.0, "lubrication.interval_hours")],
    "lubrication.interval_km": [("by km", 250.0), ("lubricated", 9.0, "lubrication.interval_km")],
    "lubrication.interval_sliding_m": [("by way", 25.0)],
    "lubrication.at_hours": [("at times", [30.0]), ("lubricated", [2.0, 1.0], "lubrication.at_hours")],
    "lubrication.at_km": [("at km", [300.0]), ("by way", [3.0], "lubrication.at_km")],
    "lubrication.when_rate_exceeds": [("by rate", 8.0), ("by rate", 0.5, "lubrication.when_rate_exceeds")],
    "lubrication.lasts_hours": [("lubricated", 9.0), ("lubricated", -1.0, "lubrication.lasts_hours")],
    "lubrication.lasts_km": [("by km", 90.0), ("lubricated", 9.0, "lubrication.lasts_km")],
    "lubrication.lasts_sliding_m": [("by way", 9.0)],
    "lubrication.fades_over_hours": [("lubricated", 5.0)],
    "lubrication.fades_over_km": [("by km", 50.0)],
    "lubrication.fades_over_sliding_m": [("by way", 5.0)],
    "lubrication.dry_factor": [("lubricated", 12.0), ("lubricated", 0.5, "lubrication.dry_factor")],
    "lubrication.lasts_band_factor": [
        ("lubricated", 3.0),
        ("lubricated", 0.5, "lubrication.lasts_band_factor"),
    ],
    "lubrication.dry_band_factor": [("lubricated", 5.0), ("by rate", 0.5, "lubrication.dry_band_factor")],
    "lubrication.contamination_band_factor": [
        ("lubricated", 4.0),
        ("by rate", 4.0, "lubrication.contamination_band_factor"),
    ],
    "lubrication.completeness": [("lubricated", 0.5), ("lubricated", 1.1, "lubrication.completeness")],
    "lubrication.contamination_factor": [("lubricated", 2.0)],
    "lubrication.ageing_factor": [("lubricated", 3.0)],
    "lubrication.abrasive_hardness_HV": [
        ("abraded", 500.0),
        ("lubricated", 500.0, "lubrication.abrasive_hardness_HV"),
    ],
    "lubrication.surface_hardness_HV": [
        ("abraded", 1000.0),
        ("lubricated", 500.0, "lubrication.surface_hardness_HV"),
    ],
    "lubrication.phase.abrasive_hardness_HV": [("abraded programme", 500.0)],
    "lubrication.contamination_removed": [("programme", 0.2)],
    "lubrication.phase.hours": [("programme", 30.0), ("programme", -1.0, "lubrication.phase.1.hours")],
    "lubrication.phase.km": [("km programme", 150.0), ("programme", 20.0, "lubrication.phase.1.hours")],
    "lubrication.phase.environment": [
        ("programme", "mud"),
        ("programme", "clean", "lubrication.phase.1.contamination_factor"),
    ],
    "lubrication.phase.contamination_factor": [("programme", 5.0)],
    "lubrication.phase.ageing_factor": [("programme", 20.0)],
    "lubrication.phase.relubrications": [("programme", 5)],
    "lubrication.phase.contaminations": [
        ("programme", 0),
        ("programme", -1, "lubrication.phase.1.contaminations"),
    ],
    "load.regime": [("regime", "III"), ("duty", "I", "load.regime")],
    "load.duty_file": [("log", "other_duty.csv"), ("strand", "duty.csv", "load.tension_N")],
    "fatigue.load_factor": [
        ("fatigue", 1.2),
        ("wrap fatigue", 1.2),
        ("prescribed fatigue", 1.2),
        ("fatigue", 0.9, "fatigue.load_factor"),
    ],
    "fatigue.sprocket.treatment": [
        ("fatigue", "carburised"),
        ("fatigue", "nitrided", "fatigue.sprocket.contact_limit_MPa"),
    ],
    "fatigue.sprocket.hardness_HB": [
        ("soft fatigue", 310.0),
        ("prescribed fatigue", 310.0),
        ("fatigue", 450.0, "fatigue.sprocket.hardness_HB"),
    ],
    "fatigue.sprocket.hardness_HRC": [
        ("fatigue", 46.0),
        ("soft fatigue", 30.0, "fatigue.sprocket.hardness_HB"),
        ("fatigue", 71.0, "fatigue.sprocket.hardness_HRC"),
    ],
    "fatigue.sprocket.contact_limit_MPa": [("fatigue", 900.0), ("wrap fatigue", 600.0)],
    "fatigue.sprocket.contact_safety": [
        ("fatigue", 1.3),
        ("fatigue", 0.9, "fatigue.sprocket.contact_safety"),
    ],
    "load.duty_bins": [("log", [1, 1]), ("strand", [4, 4], "load.duty_bins")],
    "load.duty_speed_ratio": [("log", 0.5), ("strand", 0.5, "load.duty_speed_ratio")],
}


def test_every_key_is_covered_and_no_other(leaves):
    covered = [*CHANGES, *WITHOUT_EFFECT]
    assert sorted(covered) == sorted(leaves(CaseTables))


def test_every_base_and_every_law_profile_and_mechanism_takes_part():
    assert {change[0] for changes in CHANGES.values() for change in changes} == set(BASES)


def draw(path, layers, apart=None):
    """A gap as a polyline, on every layer receded by so much; or as two, so far apart in the seat."""
    drawing = ezdxf.new(units=4)
    outline = load_case({**WRAP, "sprocket": {"teeth": 13, "profile": "iso606"}}).drive.outline
    for layer, depth in layers.items():
        moved = outline.recede(depth)
        points = np.column_stack([moved.x, moved.y])
        halves = [points] if apart is None else [points[:300], points[299:] - np.array([apart, 0.0])]
        for half in halves:
            drawing.modelspace().add_lwpolyline(half, dxfattribs={"layer": layer})
    drawing.saveas(path)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Function that runs a mapping in a folder with the CSV files, each mapping once."""
    folder = tmp_path_factory.mktemp("walk")
    flank = profile_table(load_case(STRAND))
    flank.to_csv(folder / "points.csv", columns=["x_mm", "y_mm"], index=False)
    flank["y_mm"] += 0.02
    flank.to_csv(folder / "other.csv", columns=["x_mm", "y_mm"], index=False)
    arc = np.linspace(0.0, 10.0, 21)
    loads = pd.DataFrame(
        {
            "arc_length_mm": arc,
            "load_per_width_N_per_mm": 100.0 + 10.0 * np.sin(arc),
            "flank_curvature_per_mm": -0.01,
            "slip_ratio": 0.5,
        }
    )
    loads.to_csv(folder / "loads.csv", index=False)
    loads["slip_ratio"] = 0.6
    loads.to_csv(folder / "other_loads.csv", index=False)
    draw(folder / "gap.dxf", {"first": 0.0, "second": 0.01})
    draw(folder / "other.dxf", {"first": 0.02})
    draw(folder / "open.dxf", {"first": 0.0}, apart=0.02)
    for name, pull in (("duty", 4000), ("other_duty", 4100)):
        rows = "".join(f"{i},{pull + 50 * i},{60 + i}\n" for i in range(20))
        (folder / f"{name}.csv").write_text("time_s,tension_N,speed_rpm\n" + rows)
    done = {}

    def run(tables):
        if repr(tables) not in done:
            with pytest.MonkeyPatch.context() as patch:
                patch.chdir(folder)
                done[repr(tables)] = numbers(wearsim.simulate(load_case(tables)))
        return done[repr(tables)]

    return run


def numbers(result):
    """Every number of a result that is not an echo of the input."""
    lives = [result.life, result.life_low, result.life_high, *result.parts.values()]
    return [
        *(value for life in lives for value in vars(life).values()),
        result.updates,
        *(tuple(column) for column in result.history_columns.values()),
        *(tuple(column) for column in result.flank_columns.values()),
    ]


def with_value(base, key, value):
    *tables, name = key.split(".")
    changed = {**base}
    place = changed
    for table in tables:
        inner = place.get(table, {})
        place[table] = [{**inner[0]}, *inner[1:]] if isinstance(inner, list) else {**inner}
        place = place[table][0] if isinstance(inner, list) else place[table]
    assert place.get(name) != value
    place[name] = value
    return changed


EFFECTS = [(key, *change) for key, changes in CHANGES.items() for change in changes if len(change) < 3]
ERRORS = [(key, *change) for key, changes in CHANGES.items() for change in changes if len(change) > 2]


def same(one, other):
    return len(one) == len(other) and all(
        np.array_equal(a, b, equal_nan=True) for a, b in zip(one, other, strict=True)
    )


@pytest.mark.parametrize(("key", "base", "value"), EFFECTS)
def test_key_changes_the_result(run, key, base, value):
    assert not same(run(BASES[base]), run(with_value(BASES[base], key, value)))


@pytest.mark.parametrize(("key", "base", "value", "named"), ERRORS)
def test_key_is_refused_by_name(run, key, base, value, named):
    with pytest.raises(CaseError) as caught:
        run(with_value(BASES[base], key, value))
    assert named in [fault.key for fault in caught.value.faults]
    assert key.rpartition(".")[2] in str(caught.value) or str(value) in str(caught.value)


@pytest.mark.parametrize(("key", "value"), [("title", "other"), ("sprocket.back_flank", "mirrored")])
def test_key_without_effect(run, key, value):
    assert key in WITHOUT_EFFECT
    assert same(run(STRAND), run(with_value(STRAND, key, value)))
