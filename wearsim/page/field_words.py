"""Plain words for keys and for the words that a key takes."""

from wearsim.contact.stop_limits import LIMITS
from wearsim.report.key_words import key_words

_LABELS = {
    "abrasive_hardness_HV": "Hardness of the dirt",
    "ageing_factor": "Lubricant ages faster in dirt, factor",
    "applies_to": "Factor acts on",
    "at_hours": "Relubricated at these hours",
    "at_km": "Relubricated at these km",
    "back_flank": "Back flank",
    "band_factor": "Uncertainty factor of the wear coefficient",
    "coefficient": "Coefficient of the law",
    "completeness": "Fraction of the age removed by relubrication",
    "condition": "Material and lubrication",
    "contamination_factor": "Factor on wear in dirt",
    "contamination_removed": "Fraction of the dirt removed by relubrication",
    "contact_end_mm": "End of contact, at the root",
    "contact_limit_MPa": "Contact stress limit",
    "contact_start_mm": "Start of contact, at the tip",
    "cycles_exponent": "Exponent of the cycles",
    "core_factor": "Factor on wear below the case",
    "designation": "Chain",
    "displaced": "Seat offset (GOST 591)",
    "dry_factor": "Factor on wear without lubricant",
    "duty_file": "File of the load spectrum",
    "duty_speed_ratio": "Speed ratio to the logged shaft",
    "dxf_file": "Drawing (DXF)",
    "dxf_join_tolerance_mm": "Tolerance for joining lines, mm",
    "dxf_layer": "Layer of the drawing",
    "engaged_every": "A roller in every n-th gap",
    "fades_over_hours": "Then fades over, hours",
    "fades_over_km": "Then fades over, km",
    "fades_over_sliding_m": "Then fades over, sliding distance",
    "form": "Gap form",
    "format_version": "Version of the input format",
    "friction_roller_bush": "Friction, roller on bush",
    "friction_roller_tooth": "Friction, roller on tooth",
    "guide_deg": "Direction of travel",
    "hardness_HB": "Brinell hardness",
    "hardness_HRC": "Rockwell hardness",
    "high": "Highest value",
    "horizon_hours": "Longest time simulated",
    "hours": "Duration, hours",
    "interval_hours": "Relubricated every, hours",
    "interval_km": "Relubricated every, km",
    "interval_sliding_m": "Relubricated every, sliding distance",
    "joint_application_factor": "Application factor of the joint pressure",
    "kind": "Contact model",
    "km": "Distance, km",
    "km_per_hour": "Distance per hour",
    "lasts_hours": "Lubricant lasts, hours",
    "lasts_km": "Lubricant lasts, km",
    "lasts_sliding_m": "Lubricant lasts, sliding distance",
    "law": "Wear law",
    "life_tolerance": "Tolerance of the life",
    "links": "Number of links",
    "low": "Lowest value",
    "mass_kg_per_m": "Mass per metre",
    "mate_teeth": "Teeth of the other sprocket",
    "method": "Time stepping",
    "nodes": "Points along the flank",
    "phases": "Phases per pitch",
    "points_file": "File of flank points",
    "poissons_ratio": "Poisson's ratio",
    "profile": "Tooth form",
    "regime": "Loading regime",
    "replace_at_percent": "Replace the chain at an elongation of",
    "role": "Driver, driven or idler",
    "roller_slip_fraction": "Slip fraction of the roller",
    "sag_percent": "Sag of the slack span",
    "seat_centre": "Centre of the seat arc",
    "service_factor": "Service factor",
    "table_file": "File of load and sliding",
    "tonnes_per_hour": "Tonnes per hour",
    "travel_mm": "Travel limits of the take-up",
    "treatment": "Heat treatment",
    "turn_sprocket": "Turn the worn sprocket over",
    "when_rate_exceeds": "Relubricated when wear exceeds, times",
    "youngs_modulus_MPa": "Young's modulus",
    **{row.key: row.label for row in LIMITS.values()},
}
"""Where the key itself is no plain word."""

_CONDITIONS = {
    "hardened, oiled": "hardened teeth, oil on teeth and joints at all times",
    "normalised, greased": "softer teeth, grease or oil now and then",
    "hardened, dry": "hardened teeth, no lubricant",
    "unhardened, dry": "soft teeth, no lubricant",
    "soil-contaminated": "soil or sand on the chain, as in tracks and field machines",
    "bicycle, immersion wax": "bicycle chain dipped into molten wax",
    "bicycle, wax drip": "bicycle chain with wax dripped on",
    "bicycle, wet drip": "bicycle chain with oil dripped on",
    "bicycle, factory grease": "bicycle chain with the grease that it is sold with",
}
_LUBRICATIONS = {
    "drip": "oil drips on the chain",
    "oil-bath": "the chain dips into oil",
    "forced": "a pump sprays oil on the chain",
    "periodic": "oil by hand now and then",
    "grease": "grease now and then",
    "dry": "none",
}
_SHOCKS = {
    "smooth": "even load, such as a fan or a belt conveyor",
    "moderate": "uneven load, such as a mixer or a piston pump",
    "heavy": "shocks, such as a crusher or a press",
}
_WORDS = {"condition": _CONDITIONS, "lubrication": _LUBRICATIONS, "shock": _SHOCKS}


def label(name: str) -> str:
    """Return what a key is called in plain words.

    Examples
    --------
    >>> label("tension_N"), label("profile"), label("centre_distance_mm")
    ('Tension', 'Tooth form', 'Centre distance')
    """
    words = key_words(name)
    return _LABELS.get(name, words[0].upper() + words[1:])


def choice_words(name: str, choice: str) -> str:
    """Return a word that a key takes, with what it means where that does not go without saying.

    Examples
    --------
    >>> choice_words("condition", "hardened, dry"), choice_words("profile", "iso606")
    ('hardened, dry: hardened teeth, no lubricant', 'iso606')
    """
    meaning = _WORDS.get(name, {}).get(choice)
    return f"{choice}: {meaning}" if meaning else choice
