"""The mass of a sprocket as it is cut from a plate."""

from wearsim.case.model import Case
from wearsim.catalogue.catalogues import materials
from wearsim.errors import CaseError, Fault

_M3_PER_MM3 = 1e-9


def blank_mass(case: Case) -> float:
    """Return the mass of a new sprocket: its outline times face width and density."""
    area = case.drive.blank_area()
    if area is None:
        text = (
            "the mass needs a sprocket whose whole outline is known, which a table of loads and gears do "
            "not tell: leave mass_kg out of [optimise]"
        )
        raise CaseError([Fault(text, "mass_kg", case.name)])
    width: float = case.inputs["sprocket"]["face_width_mm"]
    return _M3_PER_MM3 * area * width * density(case)


def density(case: Case) -> float:
    """Return the density of a sprocket's material."""
    return materials()[_material(case)].density


def mass_assumption(case: Case) -> str:
    """Return what the mass takes for granted."""
    return (
        "the mass is that of the new outline over the face width, without bore, hub and chamfers, of "
        f"{_material(case)} with {density(case):g} kg/m3"
    )


def _material(case: Case) -> str:
    return str(case.inputs.get("material", {}).get("sprocket", {}).get("name", "steel"))
