"""Plain words for keys and for the words that a key takes."""

from functools import cache

from wearsim.catalogue.catalogues import chains
from wearsim.contact.stop_limits import LIMITS
from wearsim.quantities import quantities
from wearsim.report.key_words import key_words

_LABELS = {
    "abrasive_hardness_HV": "Hardness of the dirt",
    "ageing_factor": "Ageing factor of the lubricant in dirt",
    "applies_to": "Factor acts on",
    "at_hours": "Relubrication times (hours)",
    "at_km": "Relubrication times (km)",
    "band_factor": "Uncertainty factor of the wear coefficient",
    "coefficient": "Coefficient of the wear law",
    "completeness": "Fraction of the age removed by relubrication",
    "condition": "Material and lubrication",
    "consumption_ml_per_hour": "Consumption",
    "contaminations": "Number of contaminations",
    "contamination_band_factor": "Uncertainty factor of the wear factor of dirt",
    "contamination_factor": "Wear factor of dirt",
    "contamination_removed": "Fraction of the dirt removed by relubrication",
    "contact_end_mm": "End of contact, at the root",
    "contact_limit_MPa": "Contact stress limit",
    "contact_safety": "Safety factor against contact fatigue",
    "contact_start_mm": "Start of contact, at the tip",
    "cycles_exponent": "Exponent of the cycles",
    "core_factor": "Wear factor below the hardened layer",
    "designation": "Chain",
    "displaced": "Seat offset (GOST 591)",
    "dry_band_factor": "Uncertainty factor of the wear factor without lubricant",
    "dry_factor": "Wear factor without lubricant",
    "duty_bins": "Number of load and speed classes",
    "duty_file": "File of the load spectrum",
    "duty_speed_ratio": "Speed ratio to the logged shaft",
    "dxf_file": "Drawing (DXF)",
    "dxf_join_tolerance_mm": "Tolerance for joining lines",
    "dxf_layer": "Layer of the drawing",
    "engaged_every": "A roller in every n-th gap",
    "fades_over_hours": "Lubricant fades over (hours)",
    "fades_over_km": "Lubricant fades over (km)",
    "fades_over_sliding_m": "Lubricant fades over (sliding distance)",
    "form": "Gap form",
    "format_version": "Version of the input format",
    "friction_roller_bush": "Friction, roller on bush",
    "friction_roller_tooth": "Friction, roller on tooth",
    "guide_deg": "Direction of travel",
    "hardness_HB": "Brinell hardness",
    "hardness_HRC": "Rockwell hardness",
    "high": "Maximum",
    "horizon_hours": "Longest time simulated",
    "hours": "Duration (hours)",
    "interval_hours": "Relubrication interval (hours)",
    "interval_km": "Relubrication interval (km)",
    "interval_sliding_m": "Relubrication interval (sliding distance)",
    "joint_application_factor": "Application factor K_e",
    "kind": "Contact model",
    "km": "Duration (km)",
    "km_per_hour": "Distance per hour",
    "lasts_band_factor": "Uncertainty factor of how long it lasts",
    "lasts_hours": "Lubricant lasts (hours)",
    "lasts_km": "Lubricant lasts (km)",
    "lasts_sliding_m": "Lubricant lasts (sliding distance)",
    "law": "Wear law",
    "life_tolerance": "Tolerance of the life",
    "links": "Number of links",
    "low": "Minimum",
    "mass_kg_per_m": "Mass per metre",
    "mate_teeth": "Number of teeth of the other sprocket",
    "method": "Time stepping",
    "nodes": "Number of points along the flank",
    "outside": "Runs on the back of the chain",
    "phases": "Number of phases per pitch",
    "pinion_teeth": "Number of teeth of the pinion",
    "pitch": "Pitch lengthened by joint wear",
    "points_file": "File of flank points",
    "points_noise_mm": "Error of the flank points",
    "poissons_ratio": "Poisson's ratio",
    "position_mm": "Position x, y",
    "profile": "Tooth form",
    "pv_limit_MPa_mm_per_s": "Pressure-speed limit (pv)",
    "reference_hours": "Reference time",
    "regime": "Loading regime",
    "relubrications": "Number of relubrications",
    "replace_at_percent": "Replace the chain at an elongation of",
    "role": "Driver, driven or idler",
    "roller_slip_fraction": "Slip fraction of the roller",
    "roughness_um": "Combined rms roughness",
    "running_in_distance_mm": "Running-in distance",
    "running_in_factor": "Running-in factor",
    "sag_percent": "Sag of the slack span",
    "seat_centre": "Centre of the seat arc",
    "severe_factor": "Wear factor above the pressure-speed limit",
    "source": "Source of the numbers",
    "strands": "Number of strands",
    "table_file": "File of load and sliding",
    "teeth": "Number of teeth",
    "tonnes_per_hour": "Tonnes per hour",
    "travel_mm": "Travel limits of the take-up",
    "treatment": "Heat treatment",
    "turn_sprocket": "Turn the worn sprocket over",
    "wheel_critical_depth_mm": "Allowable wear depth of the wheel",
    "wheel_teeth": "Number of teeth of the wheel",
    "when_rate_exceeds": "Relubrication above a relative wear of",
    "youngs_modulus_MPa": "Young's modulus",
    **{row.key: row.label for row in LIMITS.values()},
}
"""Where the key itself is no plain word."""

_TABLES = {
    "duty": "Load block",
    "fatigue": "Contact fatigue",
    "fatigue.pinion": "Contact fatigue of the pinion",
    "fatigue.sprocket": "Contact fatigue of the sprocket",
    "fatigue.wheel": "Contact fatigue of the wheel",
    "film": "Oil film",
    "gear": "Gears",
    "joint": "Chain joints",
    "lubrication.option": "Alternative lubricant",
    "lubrication.phase": "Lubrication phase",
    "material.pinion": "Material of the pinion",
    "material.roller": "Material of the roller",
    "material.sprocket": "Material of the sprocket",
    "material.wheel": "Material of the wheel",
    "mechanism": "Contact model",
    "optimise": "Optimisation",
    "run": "Calculation",
    "sprocket.cog": "Cog",
    "sprocket.material": "Material of this sprocket",
    "sprocket.take_up": "Take-up",
    "sprocket.wear": "Wear of this sprocket",
    "stop": "Wear limits",
}
"""Where the name of the table itself is no plain word."""

_LIMITS = "optimise.limits."

_CONDITIONS = {
    "hardened, oiled": "hardened teeth, oil on teeth and joints at all times",
    "hardened, greased": "hardened teeth, occasional grease or oil",
    "normalised, oiled": "softer teeth, oil on teeth and joints at all times",
    "normalised, greased": "softer teeth, occasional grease or oil",
    "hardened, dry": "hardened teeth, no lubricant",
    "normalised, dry": "softer teeth, no lubricant",
    "soil-contaminated": "soil or sand on the chain, as in tracks and field machines",
    "bicycle, immersion wax": "bicycle chain dipped into molten wax",
    "bicycle, wax drip": "bicycle chain with wax dripped on",
    "bicycle, wet drip": "bicycle chain with oil dripped on",
    "bicycle, factory grease": "bicycle chain with the grease that it is sold with",
}
_LUBRICATIONS = {
    "drip": "oil drips on the chain",
    "oil bath": "the chain dips into oil",
    "forced": "a pump sprays oil on the chain",
    "manual": "occasional oil by hand",
    "greased": "occasional grease",
    "dry": "none",
}
_SHOCKS = {
    "smooth": "steady load, such as a fan or a belt conveyor",
    "moderate": "uneven load, such as a mixer or a piston pump",
    "heavy": "shocks, such as a crusher or a press",
}
_ENVIRONMENTS = {
    "clean": "no dirt on the chain",
    "dust": "dry dust",
    "wet": "wet dirt",
    "mud": "water and mud",
    "soil": "soil or sand, as in tracks and field machines",
}
_HARDNESSES = {"hardened": "flame or case hardened, about 650 HV", "normalised": "not hardened, about 200 HV"}
_WORDS = {
    "condition": _CONDITIONS,
    "environment": _ENVIRONMENTS,
    "lubricant": _LUBRICATIONS,
    "lubrication": _LUBRICATIONS,
    "shock": _SHOCKS,
    "tooth_hardness": _HARDNESSES,
}


def label(name: str) -> str:
    """Return what a key is called in plain words.

    Examples
    --------
    >>> label("tension_N"), label("profile"), label("centre_distance_mm")
    ('Tension', 'Tooth form', 'Centre distance')
    """
    words = key_words(name)
    return _LABELS.get(name, words[0].upper() + words[1:])


def table_label(name: str) -> str:
    """Return what a table is called in plain words, one of a list without its number.

    Examples
    --------
    >>> table_label("load"), table_label("sprocket.take_up")
    ('Load', 'Take-up')
    >>> table_label("optimise.limits.peak_pressure_MPa")
    'Optimisation limit: peak pressure (MPa)'
    """
    if name.startswith(_LIMITS):
        quantity = name.removeprefix(_LIMITS)
        return f"Optimisation limit: {key_words(quantity)} ({quantities()[quantity].unit})"
    return _TABLES.get(name, name.capitalize())


def choice_words(name: str, choice: str) -> str:
    """Return a word that a key takes, with what it means where that does not go without saying.

    Examples
    --------
    >>> choice_words("condition", "hardened, dry"), choice_words("profile", "iso606")
    ('hardened, dry: hardened teeth, no lubricant', 'iso606')
    >>> choice_words("designation", "16A-2")
    '16A-2 (ANSI 80-2): 25.4 mm pitch'
    """
    meaning = _WORDS.get(name, {}).get(choice)
    if name == "designation":
        return _chain_words().get(choice, choice)
    return f"{choice}: {meaning}" if meaning else choice


@cache
def _chain_words() -> dict[str, str]:
    """Return the chains of the catalogue with their other names and their pitches."""
    found = {}
    for chain in chains().values():
        first = chain.designation
        same = [name for name, other in chains().items() if other == chain]
        others = [name for name in same if first not in (name, f"{name}-1")]
        more = f" ({', '.join(others)})" if others else ""
        found[first] = f"{first}{more}: {chain.pitch:g} mm pitch"
    return found
