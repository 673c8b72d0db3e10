"""What runs on a sprocket, and how: [chain], [sprocket], [drive], [mechanism], [joint], [load], [[duty]]."""

from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BeforeValidator, Field, ValidationInfo, WithJsonSchema, field_validator

from wearsim.case.keys.wear_tables import MaterialTable, WearTable, known_condition
from wearsim.catalogue.catalogues import MOST_STRANDS, chains
from wearsim.catalogue.chain_names import chain_name, known_chain_name
from wearsim.geometry.forms import BETWEEN_FORMS, TOOTH_FORMS
from wearsim.input.table import Table, all_differ, others_of
from wearsim.input.texts import SEEN
from wearsim.input.units import NotNegative, Positive, PositiveNumber, Series, Signed, Speed


class MechanismTable(Table):
    """Contact model of the flank."""

    kind: Literal["strand", "prescribed", "wrap"] | None = None
    table_file: str | None = None
    phases: Annotated[int, Field(ge=1, le=720)] | None = None
    roller_slip_fraction: Annotated[PositiveNumber, Field(ge=1e-6, le=1.0)] | None = None
    """Below the least what slides is lost in the rounding of the flank's points."""
    friction_roller_tooth: Annotated[NotNegative, Field(le=1.0)] | None = None
    friction_roller_bush: Annotated[NotNegative, Field(le=1.0)] | None = None


JOINT_LAW_KEYS = (
    "pressure_exponent",
    "speed_exponent",
    "pitch_exponent",
    "reference_pressure_MPa",
    "reference_speed_rpm",
    "reference_pitch_mm",
)
"""Keys of the law by which joints wear, in the order of `wearsim.chain.joint_wear.JointLaw`."""


_REFERENCES = {
    "reference_pressure_MPa": (15.0, 1000.0),
    "reference_speed_rpm": (30.0, 1000.0),
    "reference_pitch_mm": (12.7, 50.8),
}
"""Ranges in which the law of the joints changes a rate, of pressures to far beyond any chain's."""


class JointTable(Table):
    """Wear of pin and bush, which makes the chain grow."""

    condition: str | None = None
    specific_wear_rate_mm2_per_N: Positive | None = None
    law: Literal["pressure_speed", "constant"] | None = None
    pressure_exponent: Annotated[PositiveNumber, Field(ge=0.5, le=5.0)] | None = None
    speed_exponent: Annotated[NotNegative, Field(le=2.0)] | None = None
    pitch_exponent: Annotated[NotNegative, Field(le=2.0)] | None = None
    reference_pressure_MPa: Positive | None = None
    reference_speed_rpm: Positive | None = None
    reference_pitch_mm: Positive | None = None
    band_factor: Annotated[PositiveNumber, Field(ge=1.0)] | None = None
    source: Annotated[str, Field(min_length=1, max_length=200), SEEN] | None = None
    pitch: Literal["alternating", "uniform"] | None = None

    @field_validator("condition")
    @classmethod
    def _known(cls, value: str | None) -> str | None:
        return known_condition(value)

    @field_validator(*_REFERENCES)
    @classmethod
    def _changes_there(cls, value: float | None, info: ValidationInfo) -> float | None:
        low, high = _REFERENCES[info.field_name or ""]
        if value is None or low <= value <= high:
            return value
        raise ValueError(
            f"must lie between {low:g} and {high:g}, as the law keeps the rate constant beyond: give the "
            "nearer end"
        )

    @classmethod
    def gives_way(cls, key: str, value: Any) -> tuple[str, ...]:
        """Return the keys whose place a new value of a key takes."""
        if key == "specific_wear_rate_mm2_per_N":
            return ("source",)
        return JOINT_LAW_KEYS if (key, value) == ("law", "constant") else ()

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        return [*self._source_alone(), *self._law_keys_without_law()]

    def _source_alone(self) -> list[tuple[str, str]]:
        if self.source is None or self.specific_wear_rate_mm2_per_N is not None:
            return []
        return [
            (
                "source",
                "names the source of specific_wear_rate_mm2_per_N: give that key too, or remove this one",
            )
        ]

    def _law_keys_without_law(self) -> list[tuple[str, str]]:
        if self.law == "pressure_speed" or (self.law is None and self.specific_wear_rate_mm2_per_N is None):
            return []
        why = "law = 'constant'" if self.law else "a rate without a law"
        return [
            (key, f"{why} is the same at every pressure and speed: remove it, or give law = 'pressure_speed'")
            for key in JOINT_LAW_KEYS
            if getattr(self, key) is not None
        ]


class DriveTable(Table):
    """Other sprocket, chain length, slack span, and factors for the use of the drive."""

    mate_teeth: Annotated[int, Field(ge=5, le=1000)] | None = None
    links: Annotated[int, Field(ge=10, le=100000)] | None = None
    centre_distance_mm: Positive | None = None
    slack_tension_N: Positive | None = None
    sag_percent: Annotated[PositiveNumber, Field(le=20.0)] | None = None
    inclination_deg: Annotated[NotNegative, Field(le=90.0)] | None = None
    link_stiffness_N_per_mm: Positive | None = None
    service_factor: Annotated[PositiveNumber, Field(ge=1.0, le=10.0)] | None = None
    joint_application_factor: Annotated[PositiveNumber, Field(ge=0.5, le=10.0)] | None = None
    joint_friction: Annotated[NotNegative, Field(le=1.0)] | None = None

    @classmethod
    def one_of(cls) -> tuple[tuple[str, ...], ...]:
        """Return groups of keys that exclude each other."""
        slack = ("slack_tension_N", "sag_percent"), ("slack_tension_N", "inclination_deg")
        return ("links", "centre_distance_mm"), *slack

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        pairs = (("links", "centre_distance_mm"), ("slack_tension_N", "sag_percent"))
        found = [
            (second, f"{first} already gives this: remove one of the two")
            for first, second in pairs
            if getattr(self, first) is not None and getattr(self, second) is not None
        ]
        if self.slack_tension_N is not None and self.inclination_deg is not None:
            found.append(("inclination_deg", "slack_tension_N is given: remove one of the two"))
        return found


OWN_CHAIN = ("pitch_mm", "roller_diameter_mm", "inner_width_mm")
"""Keys that a chain without a designation must have."""


class ChainTable(Table):
    """A chain of the catalogue by its designation, or your own by its dimensions."""

    designation: str | None = None
    pitch_mm: Annotated[Positive, Field(ge=0.01, le=1e5)] | None = None
    """From below the finest chains to far beyond the largest; what is outside is a slip of units."""
    roller_diameter_mm: Positive | None = None
    inner_width_mm: Positive | None = None
    pin_diameter_mm: Positive | None = None
    bush_diameter_mm: Positive | None = None
    bearing_area_mm2: Positive | None = None
    mass_kg_per_m: Positive | None = None
    strands: Annotated[int, Field(ge=1, le=MOST_STRANDS)] | None = None

    @field_validator("designation", mode="before")
    @classmethod
    def _text(cls, value: object) -> object:
        """A number is refused as its text is, with the chains that may be meant."""
        return str(value) if type(value) is int else value

    @field_validator("designation")
    @classmethod
    def _known(cls, value: str | None) -> str | None:
        if value is not None:
            known_chain_name(value)
        return value

    @classmethod
    def gives_way(cls, key: str, value: Any) -> tuple[str, ...]:
        """Return the keys whose place a new value of a key takes."""
        if key == "designation":
            return tuple(name for name in cls.model_fields if name != key)
        return ("designation",) if key in OWN_CHAIN else ()

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        own = OWN_CHAIN
        given = [key for key in own if getattr(self, key) is not None]
        if self.designation is not None:
            single = chains()[chain_name(self.designation) or ""]
            if self.strands is not None and single.strands not in (1, self.strands):
                message = (
                    f"the designation is of {single.strands} strands (got {self.strands}): remove one of "
                    "the two"
                )
                return [("strands", message)]
            given += [key for key in self._known_by_designation() if getattr(self, key) is not None]
            return [(key, "a designation already gives this: remove one of the two") for key in given]
        missing = [key for key in own if key not in given]
        if missing:
            message = (
                "give a designation, or pitch_mm, roller_diameter_mm and inner_width_mm "
                f"(missing: {', '.join(missing)})"
            )
            return [(missing[0], message)]
        assert self.roller_diameter_mm and self.pitch_mm
        if not self.roller_diameter_mm < self.pitch_mm:
            message = (
                f"the roller must be smaller than the pitch of {self.pitch_mm:g} mm "
                f"(got {self.roller_diameter_mm:g})"
            )
            return [("roller_diameter_mm", message)]
        inside = self.bush_diameter_mm or self.pin_diameter_mm
        if inside and inside > self.roller_diameter_mm:
            key = "bush_diameter_mm" if self.bush_diameter_mm else "pin_diameter_mm"
            message = f"must fit into the roller of {self.roller_diameter_mm:g} mm (got {inside:g})"
            return [(key, message)]
        return []

    def _known_by_designation(self) -> list[str]:
        chain = chains()[chain_name(self.designation or "") or ""]
        # No standard of ISO gives a mass: that of the chain's maker takes the place of the catalogue's.
        values = {"pin_diameter_mm": chain.pin_diameter, "bearing_area_mm2": chain.bearing_area}
        return [key for key, value in values.items() if value]


_FORMS_BY_KEY = {
    key: tuple(name for name, form in TOOTH_FORMS.items() if key in form.keys)
    for every in TOOTH_FORMS.values()
    for key in every.keys
}
"""What a key belongs to that is not of every tooth form."""

if TYPE_CHECKING:
    _Profile = str
else:
    _Profile = Literal[tuple(TOOTH_FORMS)]


class SprocketTable(Table):
    """Teeth, tooth form and, on a strand, the range of contact."""

    teeth: Annotated[int, Field(ge=5, le=1000)]
    profile: _Profile
    role: Literal["driver", "driven"] | None = None
    engaged_every: Annotated[int, Field(ge=1, le=4)] = 1
    form: Literal["min", "max"] | None = None
    seat_radius_mm: Positive | None = None
    flank_radius_mm: Positive | None = None
    seating_angle_deg: Positive | None = None
    displaced: bool | None = None
    seat_centre: Literal["pitch_circle", "root_diameter"] | None = None
    tip_diameter_mm: Positive | None = None
    points_file: str | None = None
    points_noise_mm: NotNegative | None = None
    dxf_file: str | None = None
    dxf_layer: str | None = None
    dxf_join_tolerance_mm: Annotated[Positive, Field(le=0.1)] | None = None
    face_width_mm: Positive | None = None
    evolute_offset_mm: Positive | None = None
    contact_start_mm: Positive | None = None
    contact_end_mm: Positive | None = None
    back_flank: Literal["relieved", "mirrored"] = "relieved"
    nodes: Annotated[int, Field(ge=11, le=20001)] | None = None
    bore_mm: Positive | None = None
    keyway_width_mm: Positive | None = None
    keyway_depth_mm: Positive | None = None
    hub_diameter_mm: Positive | None = None
    hub_length_mm: Positive | None = None

    @classmethod
    def gives_way(cls, key: str, value: Any) -> tuple[str, ...]:
        """Return the keys whose place a new value of a key takes."""
        if key == "profile":
            return tuple(name for name, forms in _FORMS_BY_KEY.items() if value not in forms)
        return BETWEEN_FORMS if key == "form" else ("form",) if key in BETWEEN_FORMS else ()

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        found = [
            (key, f"belongs to profile = {' or '.join(map(repr, _FORMS_BY_KEY[key]))}: remove it")
            for key in type(self).model_fields
            if key in self.model_fields_set and self.profile not in _FORMS_BY_KEY.get(key, TOOTH_FORMS)
        ]
        file = TOOTH_FORMS[self.profile].file
        if file and getattr(self, file) is None:
            found.append((file, f"profile = {self.profile!r} needs this key"))
        found += [
            (key, f"form = {self.form!r} already gives this: remove one of the two")
            for key in BETWEEN_FORMS
            if self.form is not None and getattr(self, key) is not None
        ]
        return found


Share = Annotated[PositiveNumber, Field(le=1.0)]


class TakeUpTable(Table):
    """How a sprocket of a drive takes up the slack of the chain."""

    guide_deg: Signed | None = None
    travel_mm: Series | None = None
    tensioner_force_N: Positive | None = None

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.travel_mm is None or (len(self.travel_mm) == 2 and self.travel_mm[0] < self.travel_mm[1]):
            return []
        message = f"must be the two ends of the travel, the smaller one first (got {list(self.travel_mm)})"
        return [("travel_mm", message)]


class CogTable(Table):
    """A cog of a cassette: its teeth, and the fraction of the time for which the chain runs on it."""

    teeth: Annotated[int, Field(ge=5, le=1000)]
    share_of_time: Share


class PlaceTable(Table):
    """What a sprocket of a drive has beside the keys of the only one of a case: its place in the loop."""

    name: Annotated[str, Field(min_length=1, max_length=60), SEEN] | None = None
    role: Literal["driver", "driven", "idler"] | None = None
    position_mm: Series | None = None
    outside: bool | None = None
    power_share: Share | None = None
    torque_N_m: Positive | None = None
    take_up: TakeUpTable | None = None
    cog: Annotated[list[CogTable], Field(min_length=2, max_length=20)] | None = None
    price: PositiveNumber | None = None
    wear: WearTable | None = None
    material: MaterialTable | None = None
    smooth_diameter_mm: Annotated[Positive, Field(le=1e5)] | None = None

    @classmethod
    def gives_way(cls, key: str, value: Any) -> tuple[str, ...]:
        """Return the keys whose place a new value of a key takes."""
        return others_of(key, ("power_share", "torque_N_m"), ("teeth", "cog"))

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        found = []
        if self.position_mm is not None and len(self.position_mm) != 2:
            found.append(("position_mm", f"must be x and y of the centre (got {list(self.position_mm)})"))
        found += [
            (key, "an idler transmits no power: remove this, or give it another role")
            for key in ("power_share", "torque_N_m")
            if self.role == "idler" and getattr(self, key) is not None
        ]
        if self.power_share is not None and self.torque_N_m is not None:
            found.append(("torque_N_m", "power_share already gives this: remove one of the two"))
        if self.cog and abs(sum(cog.share_of_time for cog in self.cog) - 1.0) > 1e-6:
            total = sum(cog.share_of_time for cog in self.cog)
            found.append(("cog", f"share_of_time of all cogs must sum to 1 (got {total:.9g})"))
        if self.cog and not all_differ([cog.teeth for cog in self.cog]):
            found.append(
                ("cog", "cogs must have different numbers of teeth: join those with the same number")
            )
        return found


_OF_A_SMOOTH_WHEEL = frozenset({"name", "role", "position_mm", "outside", "take_up", "smooth_diameter_mm"})
"""Keys of a wheel without teeth."""


def _teeth(value: object) -> object:
    if type(value) is not int or value < 5:
        raise ValueError("must be a whole number of at least 5")
    return value


class PlacedSprocketTable(SprocketTable, PlaceTable):
    """A sprocket of the drive: its place in the loop and its teeth."""

    role: Literal["driver", "driven", "idler"] | None = None  # type: ignore[assignment]
    teeth: Annotated[int, Field(ge=5, le=1000), BeforeValidator(_teeth)] | None = None  # type: ignore[assignment]
    profile: _Profile | None = None  # type: ignore[assignment]

    @classmethod
    def gives_way(cls, key: str, value: Any) -> tuple[str, ...]:
        """Return the keys whose place a new value of a key takes."""
        return (*SprocketTable.gives_way(key, value), *PlaceTable.gives_way(key, value))

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.smooth_diameter_mm is not None:
            return [*PlaceTable.conflicts(self), *self._smooth_faults()]
        found = PlaceTable.conflicts(self)
        if self.profile is None:
            found.append(("profile", "this key is required and missing"))
        else:
            found += SprocketTable.conflicts(self)
        if self.cog and self.teeth is not None:
            found.append(("teeth", "each cog gives its own: remove one of the two"))
        if not self.cog and self.teeth is None:
            found.append(("teeth", "this key is required and missing"))
        return found

    def _smooth_faults(self) -> list[tuple[str, str]]:
        """Return what is wrong with a wheel without teeth."""
        found = []
        if self.role != "idler":
            found.append(("role", "a smooth wheel transmits no power: must be 'idler'"))
        given = (key for key in type(self).model_fields if key in self.model_fields_set)
        text = "a smooth idler has no teeth: remove this, or smooth_diameter_mm"
        return [*found, *((key, text) for key in given if key not in _OF_A_SMOOTH_WHEEL)]

    def alone(self, **taken: int | str) -> SprocketTable:
        """Return the table of this sprocket where it is the only one of a case, with values of some keys."""
        keys = SprocketTable.model_fields
        given = {*self.model_fields_set & keys.keys(), *taken}
        return SprocketTable.model_construct(given, **{key: getattr(self, key) for key in keys} | taken)


class DutyBlock(Table):
    """A part of the duty in which load and speed are constant."""

    share_of_time: Share | None = None
    share_of_cycles: Share | None = None
    tension_N: Positive | None = None
    power_kW: Positive | None = None
    torque_N_m: Positive | None = None
    speed_rpm: Speed
    wear_factor: PositiveNumber = 1.0
    applies_to: Literal["all", "teeth", "joints"] = "all"
    power_share: dict[str, PositiveNumber] | None = None

    @classmethod
    def one_of(cls) -> tuple[tuple[str, ...], ...]:
        """Return groups of keys that exclude each other."""
        return (LOAD_KEYS,)

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        found = []
        for keys in (("share_of_time", "share_of_cycles"), LOAD_KEYS):
            given = [key for key in keys if getattr(self, key) is not None]
            if len(given) != 1:
                names = f"{', '.join(keys[:-1])} and {keys[-1]}"
                message = f"give exactly one of {names} (got {', '.join(given) or 'none'})"
                found.append((given[1] if given else keys[0], message))
        return found


LOAD_KEYS = ("tension_N", "power_kW", "torque_N_m")
"""Keys of which exactly one gives a load."""

_OF_A_LOG = ("duty_bins", "duty_speed_ratio")
"""Keys that say how a log is taken."""

_MAX_BINS = 100


def _bins(value: object) -> object:
    pair = value if isinstance(value, list) and len(value) == 2 else [None]
    if not all(type(entry) is int and 1 <= entry <= _MAX_BINS for entry in pair):
        raise ValueError(
            f"must be two whole numbers from 1 to {_MAX_BINS}, the numbers of load and speed bins, such as "
            "[20, 8]"
        )
    return value


def _named(value: object) -> object:
    """Take the number 0 for the name: that is what --set load.regime=0 gives."""
    return "0" if type(value) is int and value == 0 else value


Regime = Annotated[Literal["0", "I", "II", "III", "IV", "V"], BeforeValidator(_named)]
"""A typical regime of loading, from constant to very light."""

_BINS: dict[str, Any] = {
    "type": "array",
    "items": {"type": "integer", "minimum": 1, "maximum": _MAX_BINS},
    "minItems": 2,
    "maxItems": 2,
}


class LoadTable(Table):
    """Load and speed of this sprocket: constant, by a typical regime, or by a log."""

    tension_N: Positive | None = None
    power_kW: Positive | None = None
    torque_N_m: Positive | None = None
    speed_rpm: Speed | None = None
    regime: Regime | None = None
    duty_file: str | None = None
    duty_bins: Annotated[list[int], BeforeValidator(_bins), WithJsonSchema(_BINS)] | None = None
    duty_speed_ratio: PositiveNumber | None = None

    @classmethod
    def one_of(cls) -> tuple[tuple[str, ...], ...]:
        """Return groups of keys that exclude each other."""
        return (LOAD_KEYS,)

    @classmethod
    def gives_way(cls, key: str, value: Any) -> tuple[str, ...]:
        """Return the keys whose place a new value of a key takes."""
        if key == "duty_file":
            return (*LOAD_KEYS, "speed_rpm", "regime")
        of_a_log = ("duty_file", *_OF_A_LOG) if key in (*LOAD_KEYS, "speed_rpm", "regime") else ()
        return (*super().gives_way(key, value), *of_a_log)

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.duty_file is not None:
            keys = (*LOAD_KEYS, "speed_rpm", "regime")
            return [
                (key, "duty_file gives load and speed: remove one of the two")
                for key in keys
                if getattr(self, key) is not None
            ]
        found = [
            (key, "belongs to duty_file: remove it") for key in _OF_A_LOG if getattr(self, key) is not None
        ]
        given = [key for key in LOAD_KEYS if getattr(self, key) is not None]
        if len(given) > 1:
            message = f"give exactly one of {', '.join(LOAD_KEYS)} (got {', '.join(given)})"
            found.append((given[1], message))
        return found
