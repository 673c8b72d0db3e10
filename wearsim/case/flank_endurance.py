"""What flanks are made of against contact fatigue, completed."""

from collections.abc import Mapping
from dataclasses import dataclass

from wearsim.input.case_record import Record
from wearsim.input.schema.fatigue import FatigueTable, FlankMaterialTable

_SPROCKET = (
    "contact fatigue of the sprocket by formulas (21) to (26) of source 001, which are those of gears: "
    "that they hold for its teeth is this project's reconstruction",
    "the stress of contact fatigue is the highest contact pressure on the new flank, once in a cycle; "
    "loads of a duty add up by the sixth power of it (Miner), and what wear does to it is left out",
)


@dataclass(frozen=True)
class FlankMaterial:
    """Material of the flanks of a sprocket, pinion or wheel against contact fatigue."""

    treatment: str  # heat treatment
    hardness: float  # of the flank
    scale: str  # `HB` or `HRC`
    contact_limit: float | None  # sigma_Hlim [MPa]; None for that of the treatment
    contact_safety: float | None  # S_H; None for that of the treatment


@dataclass(frozen=True)
class FatigueInput:
    """Contact fatigue as it was asked for."""

    load_factor: float  # K_H on the load, for contact fatigue only
    materials: Mapping[str, FlankMaterial]  # of `pinion` and `wheel`, or of `sprocket`


def resolve_fatigue(case: Record, table: FatigueTable | None) -> FatigueInput | None:
    """Return what a case says about contact fatigue."""
    if table is None:
        return None
    if "load_factor" not in table.model_fields_set:
        case.assumptions.append("fatigue.load_factor = 1 (default)")
    sides = {name: side for name, side in dict(table).items() if isinstance(side, FlankMaterialTable)}
    if "sprocket" in sides:
        case.assumptions += _SPROCKET
    return FatigueInput(
        load_factor=table.load_factor,
        materials={
            name: FlankMaterial(
                treatment=side.treatment,
                hardness=side.hardness_HB or side.hardness_HRC or 0.0,
                scale="HB" if side.hardness_HB else "HRC",
                contact_limit=side.contact_limit_MPa,
                contact_safety=side.contact_safety,
            )
            for name, side in sides.items()
        },
    )
