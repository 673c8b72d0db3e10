"""Which mechanism a case is about."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from wearsim.geometry.forms import TOOTH_FORMS
from wearsim.jit.compiled import expect
from wearsim.lazy import named

if TYPE_CHECKING:
    from wearsim.input.document import Document

STRAND_FORMS = tuple(name for name, form in TOOTH_FORMS.items() if form.on_strand)
WRAP_FORMS = tuple(name for name in TOOTH_FORMS if name not in STRAND_FORMS)
"""Tooth forms for a chain that wraps the sprocket, and no other."""

HISTORY = (
    "cycles",
    "time_hours",
    "max_depth_mm",
    "peak_pressure_MPa",
    "max_sliding_speed_mm_per_s",
    "removed_area_mm2",
    "worn_contact_ratio",
)
FLANK = (
    "cycles",
    "node",
    "arc_length_mm",
    "x_mm",
    "y_mm",
    "depth_mm",
    "pressure_MPa",
    "sliding_speed_mm_per_s",
    "load_per_width_N_per_mm",
    "relative_curvature_per_mm",
)
"""Columns that both tables have at least, where a mechanism names no others."""


@dataclass(frozen=True)
class MechanismEntry:
    """Where a mechanism stands; its modules are imported only for a case of it."""

    tables: str  # `module:class` of the tables of its input
    read: str  # `module:function` from a document to a complete case
    build: str = ""  # of a chain, `module:function` from the record of a case to what wears in it
    history: tuple[str, ...] = HISTORY  # columns that history.csv has at least
    flank: tuple[str, ...] = FLANK  # columns that flank.csv has at least
    # kernels that a life takes, which are compiled together: `module.function` of wearsim.kernels
    kernels: tuple[str, ...] = ()

    def load(self, name: str) -> Any:
        """Return the object behind one of these fields."""
        return named(getattr(self, name))


_FLANK_KERNELS = (
    "flank_geometry.flank_frame",
    "rosenbrock.rosenbrock_step",
    "controlled_steps.wear_flanks",
    "controlled_steps.states_between",
)
_CHAIN = "wearsim.case.keys:CaseTables", "wearsim.drive.read_sprocket:read_sprocket"

MECHANISMS = {
    "strand": MechanismEntry(
        *_CHAIN,
        "wearsim.mechanisms.strand.build:strand_drive",
        kernels=(*_FLANK_KERNELS, "strand.strand_contact"),
    ),
    "prescribed": MechanismEntry(
        *_CHAIN,
        "wearsim.mechanisms.prescribed.build:prescribed_drive",
        kernels=(*_FLANK_KERNELS, "prescribed.prescribed_contact"),
    ),
    "wrap": MechanismEntry(
        *_CHAIN,
        "wearsim.mechanisms.wrap.build:wrapped_drive",
        (
            *HISTORY[:3],
            "elongation_percent",
            "roller_wear_mm",
            "chain",
            *HISTORY[3:6],
            "tip_land_mm",
            "over_pins_mm",
        ),
        ("cycles", "gap_kind", *FLANK[1:6]),
        kernels=(
            "flank_geometry.flank_frame",
            "roller_locus.roller_locus",
            "wrap_equilibrium.solve_wrap",
            "wrap_cycle.wrap_events",
            "half_space.influence_coefficients",
            "wrap_stage.implicit_stage",
            "wrap_wear.recede",
            "wrap_wear.wear_events",
        ),
    ),
    "gear_pair": MechanismEntry(
        "wearsim.mechanisms.gear_pair.keys:GearTables",
        "wearsim.drive.read_gears:read_gears",
        flank=(*FLANK, "path_mm", "wheel_x_mm", "wheel_y_mm", "wheel_depth_mm"),
        kernels=(*_FLANK_KERNELS, "gear_pair.gear_pair_contact"),
    ),
}
"""The one list of mechanisms by their kinds; a program adds one of its own by ``MECHANISMS[kind] = ...``."""

WHOLE_DRIVE = replace(
    MECHANISMS["wrap"], tables="wearsim.case.keys:DriveTables", read="wearsim.drive.read:read_drive"
)
"""A chain and all of its sprockets, each of which it wraps."""


def is_whole_drive(tables: Mapping[str, Any]) -> bool:
    """Tell whether tables name every sprocket of a drive.

    Examples
    --------
    >>> is_whole_drive({"sprocket": [{"teeth": 21}, {"teeth": 57}]}), is_whole_drive({"sprocket": {}})
    (True, False)
    """
    return isinstance(tables.get("sprocket"), list)


def mechanism_of(data: Mapping[str, Any]) -> MechanismEntry:
    """Return the mechanism that tables are about, whether or not they are right.

    Examples
    --------
    >>> mechanism_of({"sprocket": [{"teeth": 21}, {"teeth": 57}]}) is WHOLE_DRIVE
    True
    """
    if is_whole_drive(data):
        return WHOLE_DRIVE
    if "gear" in data:
        return MECHANISMS["gear_pair"]
    mechanism, sprocket = data.get("mechanism"), data.get("sprocket")
    kind = mechanism.get("kind") if isinstance(mechanism, dict) else None
    profile = sprocket.get("profile") if isinstance(sprocket, dict) else None
    default = "wrap" if profile in WRAP_FORMS else "strand"
    return MECHANISMS[kind if isinstance(kind, str) and kind in MECHANISMS else default]


def read_case(document: "Document") -> Any:
    """Return the complete case of a document; only the models of its mechanism are imported."""
    mechanism = mechanism_of(document.data)
    read = mechanism.load("read")
    expect(mechanism.kernels)
    return read(document)
