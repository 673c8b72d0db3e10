"""What a sprocket takes from its keys whether a strand or a wrap loads it."""

from wearsim.case.duty_blocks import LoadBlock
from wearsim.catalogue.catalogues import Chain
from wearsim.input.case_record import Resolution
from wearsim.input.schema import SprocketTable

_SAFETY = 7.0
"""Breaking load over tension below which a chain is loaded beyond its endurance."""


def slip_fraction(case: Resolution, default: float = 1.0) -> float:
    """Return the part of the sliding of a roller that does not turn."""
    given = case.tables.mechanism.roller_slip_fraction
    if given is None:
        why = "default" if default == 1.0 else "a roller free to turn"
        case.take("mechanism.roller_slip_fraction", default, why)
        return default
    return given


def effective_pull(block: LoadBlock, speed: float, lever: float) -> float:
    """Return the force that the load of a block asks of the chain."""
    if block.kind == "tension_N":
        return block.value
    if block.kind == "power_kW":
        return 1e6 * block.value / speed
    return 1e3 * block.value / lever


def within_strength(case: Resolution, pull: float, chain: Chain, key: str) -> bool:
    """Compare a pull with the chain's tensile strength: a fault above it, a warning near it."""
    if not chain.tensile:
        case.assumptions.append("tensile strength of the chain not known: the pull is not checked")
        return True
    if pull >= chain.tensile:
        case.faults.add(
            key, f"the pull must stay below the chain's tensile strength {chain.tensile:g} N, is {pull:.4g} N"
        )
        return False
    if pull * _SAFETY > chain.tensile:
        case.warnings.append(
            f"the pull of {pull:.4g} N is more than 1/{_SAFETY:g} of the chain's tensile strength "
            f"{chain.tensile:g} N: the plates will not last"
        )
    return True


def face_width(case: Resolution, table: SprocketTable, chain: Chain) -> float:
    """Return the width of the tooth that carries load."""
    if table.face_width_mm is None:
        width = float(f"{chain.face_width:.4g}")
        case.take("sprocket.face_width_mm", width, "standard tooth width for the chain")
        return width
    if table.face_width_mm > chain.strands * chain.inner_width:
        case.faults.add(
            "sprocket.face_width_mm",
            "the tooth must fit between the inner plates, "
            f"{chain.strands * chain.inner_width:g} mm (got {table.face_width_mm:g})",
        )
    return table.face_width_mm
