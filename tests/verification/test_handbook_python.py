"""Handbook calculations called with plain numbers, as from a notebook.

Each is held against a closed form or a publication, and against what its command prints for its shipped case.
"""

import json
import math
from pathlib import Path

import pytest
from click.testing import CliRunner

from wearsim.cli.main import wearsim_command
from wearsim.errors import GeometryError
from wearsim.handbook import (
    convex_concave,
    face_load,
    hertz_check,
    stiffness_spectrum,
    strength,
    synthesise,
    wave_drive,
)

SIZING = Path(__file__).parents[2] / "cases" / "sizing"


def printed(command, case):
    done = CliRunner().invoke(wearsim_command, ["handbook", command, str(SIZING / f"{case}.toml"), "--json"])
    assert done.exit_code == 0, done.output
    # Older versions of click show warnings among the answer.
    return json.loads(next(line for line in done.stdout.splitlines() if line.startswith("{")))


def carburised(**others):
    gear = strength.GearMaterial("carburised", hardness_HRC=59.5)
    steps = [(1.0, 0.40), (0.7, 0.35), (0.4, 0.25)]
    spectrum = [strength.SpectrumStep(torque, share_of_time=share) for torque, share in steps]
    given = {
        "pinion_speed": 1450.0,
        "gear_ratio": 3.15,
        "hours": 3000.0,
        "load_spectrum": [*spectrum, strength.SpectrumStep(1.6, overload_cycles=2e4)],
        "rules": strength.StrengthRules(overload_frequency_factor=1.2),
    }
    return strength.pair_strength(gear, gear, **(given | others))


def test_strength():
    """Case-hardened flanks of the source: 23 HRC over a safety of 1.2, beyond the base cycles."""
    load = strength.PairLoad(
        pinion_torque=540e3,
        module=4.0,
        pinion_teeth=20,
        face_width=60.0,
        initial_face_load_factor=1.2,
        running_in_share=0.7,
        accuracy_grade=8,
        contact_dynamic_factor=1.1,
        bending_dynamic_factor=1.2,
    )
    found, told = carburised(load=load), printed("strength", "strength-b-carburised")
    assert found.contact_governs.contact.allowable == pytest.approx(23.0 * 59.5 / 1.2, rel=1e-12)
    assert found.contact_governs.contact.allowable == told["allowable_contact_MPa"]
    assert found.load.contact_stress == told["contact_stress_MPa"]
    assert found.load.mesh.tangential_force == pytest.approx(2.0 * 540e3 / 80.0, rel=1e-12)
    # 2/sin^2(20 deg) = 17.1 teeth.
    assert load.undercut_below == 17


def test_face_load():
    """7.09 MW at 170 rpm on a radius of 325 mm and a face of 1 m: P/(omega r b) = 1225 N/mm."""
    found = face_load.face_load_factors(
        face_load.WidePair(face_width=1000.0, pinion_pitch_diameter=650.0, gear_ratio=12.5),
        face_load.FaceGaps(fixed=0.12, varying=0.06),
        face_load.FlankWear(1e-11, slip_ratio=0.3, hours=8000.0, wheel_wear_ratio=2.0),
        power=7090.0,
        pinion_speed=170.0,
        pivot_friction_lever=20.0,
    )
    told = printed("face-load", "face-load-mill-drive")
    assert found.mesh.mean_load == pytest.approx(
        7.09e9 / (math.tau * 170.0 / 60.0 * 325.0 * 1000.0), rel=1e-12
    )
    assert found.mesh.mean_load == told["mean_load_per_width_N_per_mm"]
    assert [state.factor for state in found.fixed.states] == [
        state["face_load_factor"] for state in told["states"] if state["pinion_mounting"] == "fixed"
    ]


def test_wave_drive():
    """The diameter by crushing of the flanks that was published, 159 mm."""
    drive = {
        "gear_ratio": 100.0,
        "output_torque_N_m": 800.0,
        "life_hours": 10_000.0,
        "generator_speed_rpm": 1500.0,
        "tooth_length_ratio": 0.2,
    }
    crushing = {"crushing": {"allowable_crushing_MPa": 10.0}}
    (found,) = wave_drive.flexspline_diameters(drive, crushing, published={"crushing": 159.0}).diameters
    assert found.diameter == pytest.approx(159.0, abs=0.5)
    assert found.reproduces
    told = {row["sizing_method"]: row for row in printed("wave-drive", "wave-drive-100")["methods"]}
    assert found.diameter == told["crushing"]["flexspline_diameter_mm"]


def test_stiffness_spectrum():
    """Without errors as many teeth touch on average as the contact ratio says; 1500 rpm give 500 Hz."""
    none = [stiffness_spectrum.ToothErrors(teeth, 0.0) for teeth in (20, 30)]
    ideal = stiffness_spectrum.mesh_spectrum(*none, module=3.0, pinion_speed=1500.0)
    assert ideal.contacts.mean == pytest.approx(ideal.pair.contact_ratio, rel=1e-12)
    assert ideal.mesh_frequency == 500.0
    found = stiffness_spectrum.mesh_spectrum(
        stiffness_spectrum.ToothErrors(20, 0.020),
        stiffness_spectrum.ToothErrors(30, 0.025),
        module=3.0,
        load=stiffness_spectrum.LoadedTeeth(10.0, 10.0, force=2000.0),
    )
    told = printed("stiffness-spectrum", "stiffness-spectrum-20-30")
    assert found.pair.contact_ratio == told["contact_ratio"]
    assert found.contacts.mean == told["mean_contacts"]


def test_synthesise():
    """454.16 MPa is Hertz' stress of the involute of 20 degrees at its pitch point."""
    pair = synthesise.loaded_pair(
        centre_distance=135.0,
        gear_ratio=1.5,
        contact_stress=[454.1608627],
        pinion_torque=240e3,
        face_width=76.0,
        pinion_speed=1000.0,
        youngs_modulus=(2.1e5, 2.1e5),
    )
    assert math.degrees(pair.pitch_point_crossing().pressure_angle) == pytest.approx(20.0, abs=1e-8)
    start = synthesise.PhaseStart(first_distance=-10.0, last_distance=10.0)
    (phase,) = synthesise.profile_phases(pair, [start])
    told = printed("synthesise", "synthesise-constant-stress")["indices"][0]
    assert math.degrees(phase.line.contacts.pressure_angle[0]) == told["pressure_angle_deg"]


def test_hertz_check():
    """0.418 sqrt(q E/rho) with q = 2 T/(d b cos a) and rho = d sin(a) u/(2 (u + 1))."""
    angle = math.radians(20.0)
    contact = hertz_check.PitchPointContact(240e3, 1.5, 76.0, 108.0, angle)
    found = hertz_check.pitch_point_check(contact, teeth=hertz_check.TeethOfPair(36, 54, 3.0))
    q = 2.0 * 240e3 / (108.0 * 76.0 * math.cos(angle))
    rho = 108.0 * math.sin(angle) * 1.5 / (2.0 * 2.5)
    assert found.contact.printed_stress == pytest.approx(0.418 * math.sqrt(q * 2.1e5 / rho), rel=1e-12)
    told = printed("hertz-check", "hertz-check-36-54")["contact"]
    assert found.contact.printed_stress == told["contact_stress_MPa"]


def test_convex_concave():
    found = convex_concave.pair_layout(
        module=4.5,
        pinion_teeth=17,
        wheel_teeth=34,
        addendum_arc_radius=10.0,
        blanks=convex_concave.GearBlanks(face_width=45.0, roller_diameters=[7.0]),
    )
    told = printed("convex-concave", "convex-concave-17-34")
    assert found.pair.centre_distance == 4.5 * (17 + 34) / 2.0 == told["centre_distance_mm"]
    assert found.pair.contact_ratio == told["contact_ratio"]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: carburised(hours=0.0), "strength: hours must be above 0, is 0"),
        (lambda: carburised(gear_ratio=math.nan), "strength: gear_ratio must be .*, is nan"),
        (
            lambda: strength.pair_strength(
                *2 * [strength.GearMaterial("improved", hardness_HB=250.0)],
                pinion_speed=1.0,
                gear_ratio=1.0,
                hours=1.0,
            ),
            "pinion: treatment must be one of normalised, .*, is 'improved'",
        ),
        (
            lambda: strength.pair_strength(
                *2 * [strength.GearMaterial("normalised")], pinion_speed=1.0, gear_ratio=1.0, hours=1.0
            ),
            "pinion must have one of hardness_HB and hardness_HRC",
        ),
        (
            lambda: face_load.face_load_factors(
                face_load.WidePair(-1.0, 100.0, 2.0),
                face_load.FaceGaps(),
                face_load.FlankWear(1e-10, 0.1, 1.0),
                power=1.0,
                pinion_speed=1.0,
            ),
            "face load: face_width must be above 0, is -1",
        ),
        (
            lambda: wave_drive.flexspline_diameters({"gear_ratio": 100.0}, {"presure": {}}),
            "methods must be among pressure, .*, but holds presure",
        ),
        (
            lambda: stiffness_spectrum.mesh_spectrum(
                *2 * [stiffness_spectrum.ToothErrors(20, 0.0)], module=0.0
            ),
            "stiffness spectrum: module must be above 0, is 0",
        ),
        (
            lambda: synthesise.loaded_pair(centre_distance=90.0, gear_ratio=1.0, contact_stress=[500.0]),
            "give load_per_width, or pinion_torque and face_width",
        ),
        (
            lambda: hertz_check.pitch_point_check(
                hertz_check.PitchPointContact(240e3, 1.5, 0.0, 108.0, 0.35)
            ),
            "hertz check: face_width must be above 0, is 0",
        ),
        (
            lambda: convex_concave.pair_layout(
                module=-1.0, pinion_teeth=17, wheel_teeth=34, addendum_arc_radius=10.0
            ),
            "convex-concave: module must be above 0, is -1",
        ),
        (lambda: carburised(regime="X", load_spectrum=()), "regime must be one of 0, I, .*, is 'X'"),
        (lambda: carburised(gear_ratio=0.5), "gear_ratio must be at least 1, is 0.5"),
        (
            lambda: carburised(rules=strength.StrengthRules(static_safety=0.0)),
            "static_safety must be at least 1, is 0",
        ),
        (
            lambda: carburised(load_spectrum=[strength.SpectrumStep(1.0, share_of_time=0.5)]),
            "shares of time of load_spectrum must come to 1, come to 0.5",
        ),
        (
            lambda: face_load.face_load_factors(
                face_load.WidePair(1.0, 100.0, 2.0, slices=0),
                face_load.FaceGaps(),
                face_load.FlankWear(1e-10, 0.1, 1.0),
                power=1.0,
                pinion_speed=1.0,
            ),
            "face load: slices must be at least 10 and at most 2000, is 0",
        ),
        (
            lambda: stiffness_spectrum.mesh_spectrum(
                *2 * [stiffness_spectrum.ToothErrors(0, 0.0)], module=1.0
            ),
            "stiffness spectrum: pinion: teeth must be at least 5 and at most 300, is 0",
        ),
        (
            lambda: hertz_check.pitch_point_check(
                hertz_check.PitchPointContact(240e3, 1.5, 76.0, 108.0, 0.35, poissons_ratio=2.0)
            ),
            "hertz check: poissons_ratio must be at least 0 and below 0.5, is 2",
        ),
    ],
)
def test_numbers_that_cannot_be(call, message):
    with pytest.raises(GeometryError, match=message):
        call()


def strength_steps(*steps):
    return carburised(load_spectrum=[strength.SpectrumStep(*step) for step in steps])


def strength_teeth(**others):
    return carburised(load=strength.PairLoad(1e5, 4.0, face_width=60.0, **LOAD_FACTORS, **others))


LOAD_FACTORS = dict.fromkeys(
    (
        "initial_face_load_factor",
        "running_in_share",
        "contact_dynamic_factor",
        "bending_dynamic_factor",
        "initial_transverse_load_factor",
    ),
    1.0,
)


def spectrum_of(load=None, module=5.0, order=1, phase=0.0, **choice):
    return stiffness_spectrum.mesh_spectrum(
        stiffness_spectrum.ToothErrors(20, 0.01, order, phase),
        stiffness_spectrum.ToothErrors(30, 0.0),
        module=module,
        choice=stiffness_spectrum.SpectrumChoice(**choice),
        load=None if load is None else stiffness_spectrum.LoadedTeeth(10.0, 10.0, **load),
    )


def diameters(methods=None, drive=None, **others):
    given = {"gear_ratio": 100.0, "output_torque_N_m": 800.0, "life_hours": 1e4, "generator_speed_rpm": 1e3}
    crushing = {"crushing": {"allowable_crushing_MPa": 10.0}} if methods is None else methods
    return wave_drive.flexspline_diameters(given | (drive or {"tooth_length_ratio": 0.2}), crushing, **others)


def stressed(stress=(700.0,), **others):
    given = {"centre_distance": 90.0, "gear_ratio": 1.25, "load_per_width": 100.0}
    return synthesise.loaded_pair(contact_stress=stress, **(given | others))


def phases(first=None, last=5.0, angle=None, **others):
    start = synthesise.PhaseStart(last, first, **others)
    return synthesise.profile_phases(stressed(), [start], angle)


def fields(x=(-5.0, 5.0), **others):
    return synthesise.direction_fields(stressed(), synthesise.MeshPlane(x, (-1.0, 1.0), **others))


def hertz(teeth=None, literal=(), published=None, **others):
    given = {"torque": 240e3, "gear_ratio": 1.5, "face_width": 76.0, "pitch_diameter": 108.0}
    contact = hertz_check.PitchPointContact(**(given | {"pressure_angle": 0.35} | others))
    return hertz_check.pitch_point_check(
        contact,
        teeth=teeth and hertz_check.TeethOfPair(*teeth),
        literal=[hertz_check.PitchPointContact(**(given | {"pressure_angle": one})) for one in literal],
        published=published and hertz_check.PublishedStresses(*published),
    )


def layout(rollers=None, teeth=17):
    return convex_concave.pair_layout(
        module=4.5,
        pinion_teeth=teeth,
        wheel_teeth=34,
        addendum_arc_radius=10.0,
        blanks=convex_concave.GearBlanks(roller_diameters=rollers),
    )


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: carburised(hours="3000"), "strength: hours must be a number, is '3000'"),
        (lambda: carburised(hours=None), "strength: hours must be given, but is not"),
        (lambda: carburised(hours=True), "strength: hours must be a number, is True"),
        (lambda: carburised(hours=math.inf), "strength: hours must be a finite number, is inf"),
        (
            lambda: strength.pair_strength(
                *2 * [strength.GearMaterial("normalised", hardness_HB=200.0, poissons_ratio=-1.0)],
                pinion_speed=1.0,
                gear_ratio=1.0,
                hours=1e6,
            ),
            "poissons_ratio must be above -1 and below 0.5, is -1",
        ),
        (lambda: strength_steps((-1.0, 1.0)), "step 1 of .*relative_torque must be at least 0 .*, is -1"),
        (lambda: strength_steps((math.nan, 1.0)), "relative_torque must be a finite number, is nan"),
        (lambda: strength_steps((math.inf, 1.0)), "relative_torque must be a finite number, is inf"),
        (lambda: strength_steps((1.0, math.nan)), "share_of_time must be a finite number, is nan"),
        (
            lambda: strength_steps((1.0, 1.5), (0.5, -0.5)),
            "share_of_time must be above 0 and at most 1, is 1.5",
        ),
        (lambda: strength_steps((1.0, 1.0), (0.5, -0.0)), "step 2 of .* share_of_time must be above 0"),
        (lambda: strength_steps((1.0, 1.0), (1.6, None, 6e4)), "overload_cycles must be .* below 50000, is"),
        (lambda: strength_steps((1.0, 1.0), (0.5,)), "step 2 .* one of share_of_time and overload_cycles"),
        (lambda: strength_steps((1.0, 1.0, 1e4)), "step 1 .* one of share_of_time and overload_cycles"),
        (lambda: carburised(regime="I"), "load_spectrum gives the loads already"),
        (lambda: strength_teeth(pinion_teeth=20.5), "pinion_teeth must be a whole number, is 20.5"),
        (lambda: spectrum_of({}), "must have one of force and pinion_torque"),
        (lambda: spectrum_of({"force": 1.0, "pinion_torque": 1.0}), "one of force and pinion_torque"),
        (lambda: spectrum_of({"force": 1.0, "formula": "printed"}), "formula belongs to pinion_torque"),
        (lambda: spectrum_of(order=2.5), "pinion: error_order must be a whole number, is 2.5"),
        (lambda: spectrum_of(order=11), "pinion: error_order must be at most 10, is 11"),
        (lambda: spectrum_of(phase=math.nan), "pinion: error_phase must be a finite number, is nan"),
        (lambda: spectrum_of(tooth_harmonics=2.5), "tooth_harmonics must be a whole number, is 2.5"),
        (lambda: spectrum_of(model="double_sum", series_harmonics=-1), "series_harmonics must be .*, is -1"),
        (lambda: spectrum_of(model="double_sum", formula="x"), "formula must be one of .*, is 'x'"),
        (lambda: spectrum_of(formula="printed"), "formula and series_harmonics belong to the closed form"),
        (lambda: hertz(youngs_modulus=(2e5, math.nan)), r"youngs_modulus\[1\] must be .* finite .*, is nan"),
        (lambda: hertz(youngs_modulus=(2e5,)), r"youngs_modulus must be .* of length 2, is \(200000.0,\)"),
        (lambda: hertz(teeth=(20.5, 30, 3.0)), "pinion_teeth must be a whole number, is 20.5"),
        (lambda: hertz(literal=[0.35, math.nan]), "literal 2: pressure_angle must be .*, is nan"),
        (lambda: hertz(published=({}, {}, {})), "published hertz: contact must be given"),
        (lambda: hertz(published=({"contact": math.nan}, {}, {})), "hertz: contact must be given"),
        (
            lambda: hertz(published=({"contact": 464.0, "depth": -1.0}, {}, {})),
            "hertz: depth must be above 0",
        ),
        (
            lambda: hertz(published=({"contact": 464.0}, {"contact": 0.0}, {})),
            "finite_elements: contact must",
        ),
        (
            lambda: hertz(published=({"contact": 464.0}, {}, {"surface": 100.0})),
            "difference: surface must be above 0 and below 100, is 100",
        ),
        (lambda: hertz(published=({"contact": 464.0}, {"root": 1.0}, {})), "but holds 'root'"),
        (lambda: layout([1e9, 3.0]), "must be from 2.9711 to 26.359 mm"),
        (lambda: layout([7.0, math.nan]), r"roller_diameters\[1\] must be a finite number, is nan"),
        (lambda: layout([]), "roller_diameters must be a sequence of length 1 or more"),
        (lambda: layout(teeth=17.5), "pinion_teeth must be a whole number, is 17.5"),
        (lambda: layout(teeth=5), "no diameter is possible, .* those of z = 5 turn away"),
        (lambda: diameters({"pressure": {}}), "wave drive: pressure: allowable_pressure_MPa must be given"),
        (lambda: diameters({"crushing": {"foo": 1.0}}), "crushing must be among .*, but holds foo"),
        (lambda: diameters(drive={"tooth_length_ratio": 0.2, "foo": 1.0}), "drive must be .* holds foo"),
        (lambda: diameters(drive={"tooth_length_ratio": 2.0}), "tooth_length_ratio must be .* most 1, is 2"),
        (lambda: diameters(published={"crushing": 0.0}), "published: crushing must be above 0, is 0"),
        (lambda: diameters(published={"crushing": -1.0}), "published: crushing must be above 0, is -1"),
        (lambda: diameters(published={"foo": 3.0}), "published must be among .*, but holds foo"),
        (lambda: diameters(printed=["foo"]), "printed must be among torsion, rim_bending, but holds foo"),
        (lambda: diameters(printed=["crushing"]), "printed must be among .*, but holds crushing"),
        (lambda: diameters(required=["foo"]), "required must be among crushing, but holds foo"),
        (lambda: stressed([]), "contact_stress must be a sequence of length 1 or more"),
        (lambda: stressed([700.0, math.nan]), r"contact_stress\[1\] must be a finite number, is nan"),
        (lambda: stressed([700.0, 800.0]), "pitch_point_distance must be given for several stresses"),
        (lambda: stressed(pitch_point_distance=[0.0, 1.0]), "pitch_point_distance must be .* length 1, is"),
        (lambda: stressed([7e2, 8e2], pitch_point_distance=[1.0, 0.0]), "distance must ascend, is 1, 0"),
        (lambda: stressed([7e2, 8e2], pitch_point_distance=[1.0, 1.0]), "distance must ascend, is 1, 1"),
        (lambda: stressed([7e2, 8e2], pitch_point_distance=[0.0, math.nan]), "must be a finite number"),
        (lambda: stressed(pinion_speed=math.nan), "pinion_speed must be a finite number, is nan"),
        (lambda: stressed(youngs_modulus=(2e5, math.nan)), r"youngs_modulus\[1\] must be .*, is nan"),
        (lambda: stressed(poissons_ratio=(0.3, 0.5)), r"poissons_ratio\[1\] must be .* below 0.5, is 0.5"),
        (lambda: phases(-5.0, nodes=-1), "phase 1: nodes must be at least 2 and at most 20001, is -1"),
        (lambda: phases(-5.0, nodes=0), "phase 1: nodes must be at least 2 and at most 20001, is 0"),
        (lambda: phases(-5.0, family=2.5), "phase 1: family must be one of 1, -1, is 2.5"),
        (lambda: phases(-5.0, family=math.nan), "phase 1: family must be one of 1, -1, is nan"),
        (lambda: phases(-5.0, family=-1), "phase 1: family must be 1 without start"),
        (lambda: phases(math.nan), "phase 1: first_distance must be a finite number, is nan"),
        (lambda: phases(-5.0, math.inf), "phase 1: last_distance must be a finite number, is inf"),
        (lambda: phases(start=(math.nan, 1.0)), r"phase 1: start\[0\] must be a finite number, is nan"),
        (lambda: phases(start=(1.0, 2.0)), r"phase 1: start\[1\] must be above 0 and below 1.5708, is 2"),
        (lambda: phases(start=(-1.0, 0.35)), "last_distance must be on the side of the start, -1, and not"),
        (lambda: phases(-5.0, start=(1.0, 0.35)), "must have one of first_distance and start"),
        (lambda: phases(), "must have one of first_distance and start"),
        (lambda: phases(-5.0, angle=1e9), "compared_angle must be above 0 and below 1.5708, is 1"),
        (lambda: fields((math.nan, 5.0)), r"x\[0\] must be a finite number, is nan"),
        (lambda: fields((5.0, -5.0)), "x must ascend, is 5, -5"),
        (lambda: fields(nodes=0), "nodes must be at least 2 and at most 20001, is 0"),
        (lambda: fields(directions=(90.0,)), r"directions\[0\] must be above -90 and below 90, is 90"),
    ],
)
def test_what_a_file_may_not_hold_either(call, message):
    with pytest.raises(GeometryError, match=message):
        call()
