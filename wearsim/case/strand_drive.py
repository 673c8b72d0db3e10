"""What touches the flank, completed: a sprocket on a strand, or a table of loads."""

import math

from wearsim.case.duty_blocks import Duty, LoadBlock
from wearsim.case.model import Block, PrescribedDrive, StrandDrive, WearInput, heaviest
from wearsim.case.shared import FLANK_NODES
from wearsim.case.working_flank import evolute_tooth, points_tooth
from wearsim.catalogue.catalogues import Chain
from wearsim.input.case_record import Resolution
from wearsim.input.csv_tables import read_prescribed
from wearsim.input.schema import SprocketTable

_SAFETY = 7.0
"""Breaking load over tension below which a chain is loaded beyond its endurance."""


def resolve_strand(case: Resolution, chain: Chain, duty: Duty | None) -> StrandDrive | None:
    """Complete a sprocket on a straight strand."""
    tables, faults = case.tables, case.faults
    if tables.sprocket is None:
        faults.add("sprocket", "this table is required and missing")
        return None
    table = tables.sprocket
    centrode = chain.pitch * table.teeth / (2.0 * math.pi * table.engaged_every)
    blocks = _blocks(case, duty, centrode, chain) if duty is not None else None
    width = face_width(case, table, chain)
    nodes = table.nodes or FLANK_NODES
    if table.nodes is None:
        case.take("sprocket.nodes", nodes, "default")
    tooth_and_range = (
        evolute_tooth(case, table, chain, centrode, nodes)
        if table.profile == "evolute"
        else points_tooth(case, table, chain, centrode, nodes)
    )
    if tooth_and_range is None or blocks is None:
        return None
    tooth, contact_end, contact_start = tooth_and_range
    fraction = slip_fraction(case)
    return StrandDrive(tooth, contact_end, contact_start, width, blocks, fraction, chain)


def resolve_prescribed(case: Resolution, wear: WearInput, chain: Chain) -> PrescribedDrive | None:
    """Complete a flank whose load and sliding come from a table."""
    tables, key = case.tables, "mechanism.table_file"
    unused = [f"load.{name}" for name in sorted(tables.load.model_fields_set - {"speed_rpm"})]
    if tables.sprocket is not None:
        used = {"engaged_every"}
        unused += [f"sprocket.{name}" for name in sorted(tables.sprocket.model_fields_set - used)]
    if unused:
        case.warnings.append(f"not used with a table of loads: {', '.join(unused)}")
    if tables.mechanism.table_file is None:
        case.faults.add(key, "kind = 'prescribed' needs the file of load and sliding")
        return None
    table = read_prescribed(case.path(key, tables.mechanism.table_file), key, case.faults)
    if table is None:
        return None
    if wear.speed_exponent != 0.0 and table.sliding_speed is None:
        case.faults.add(
            key, "the drozdov law needs the column sliding_speed_mm_per_s: add it or set speed_exponent 0"
        )
        return None
    if wear.pressure_exponent < 1.0 and table.slip_ratio is not None:
        case.faults.add(
            "wear.pressure_exponent",
            "must be at least 1 with a given slip ratio: below 1 a pit deepens itself and the problem "
            f"is ill-posed (got {wear.pressure_exponent:g})",
        )
        return None
    return PrescribedDrive(table, slip_fraction(case), chain)


def slip_fraction(case: Resolution, default: float = 1.0) -> float:
    """Return the part of the sliding of a roller that does not turn."""
    given = case.tables.mechanism.roller_slip_fraction
    if given is None:
        why = "default" if default == 1.0 else "a roller free to turn"
        case.take("mechanism.roller_slip_fraction", default, why)
        return default
    return given


def _blocks(case: Resolution, duty: Duty, centrode: float, chain: Chain) -> tuple[Block, ...] | None:
    """Return the blocks of a duty with their pulls."""

    def _block(load: LoadBlock) -> Block:
        speed = 2.0 * math.pi * centrode * load.speed_rpm / 60.0
        pull = load.part * effective_pull(load, speed, centrode)
        return Block(load.share, load.speed_rpm, pull, 0.0, load.wear_factor, load.joint_factor)

    blocks, rated = (tuple(map(_block, loads)) for loads in (duty.blocks, duty.rated))
    pull, least = heaviest(blocks).tension, min(block.tension for block in blocks)
    shown = f"{pull:.6g} N" if len(blocks) == 1 else f"{least:.4g} to {pull:.6g} N"
    case.assumptions.append(f"pull on the flank {shown} (slack strand without tension)")
    most = heaviest(rated)
    key = duty.rated[rated.index(most)].key
    return blocks if within_strength(case, most.tension, chain, key) else None


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
