"""From the tables of a sprocket on a straight strand to its drive."""

import math
from functools import partial

from wearsim.case.chain_record import ChainRecord
from wearsim.case.duty_blocks import GivenDuty, GivenLoad
from wearsim.case.model import LoadBlock, WearInput, heaviest_block, on_flank
from wearsim.case.sprocket_inputs import evolute_tooth, hub_input, points_tooth
from wearsim.case.table_inputs import FLANK_NODES, effective_pull, face_width, slip_fraction, within_strength
from wearsim.catalogue.catalogues import Chain
from wearsim.geometry.blank import tooth_space
from wearsim.mechanisms.strand.drive import StrandDrive


def strand_drive(
    case: ChainRecord, wear: WearInput, chain: Chain, duty: GivenDuty | None
) -> StrandDrive | None:
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
    hub = hub_input(
        case, table, None if tooth_and_range is None else partial(tooth_space, tooth_and_range[0])
    )
    if tooth_and_range is None or blocks is None:
        return None
    tooth, contact_end, contact_start = tooth_and_range
    if wear.changes_with_load and len(blocks) > 1:
        faults.add(
            f"wear.{wear.changes_with_load}",
            "holds for one constant load only, not for the equivalent load of a duty: remove it or the duty",
        )
    fraction = slip_fraction(case)
    evolute = table.profile == "evolute"
    return StrandDrive(tooth, contact_end, contact_start, width, blocks, fraction, chain, evolute, hub)


def _blocks(
    case: ChainRecord, duty: GivenDuty, centrode: float, chain: Chain
) -> tuple[LoadBlock, ...] | None:
    """Return the blocks of a duty with their pulls."""

    def _block(load: GivenLoad) -> LoadBlock:
        speed = 2.0 * math.pi * centrode * load.speed_rpm / 60.0
        pull = load.part * effective_pull(load, speed, centrode)
        return LoadBlock(load.share, load.speed_rpm, pull, 0.0, load.wear_factor, load.joint_factor)

    blocks, rated = (tuple(map(_block, loads)) for loads in (duty.blocks, duty.rated))
    loaded = on_flank(blocks)
    pull, least = heaviest_block(loaded).tension, min(block.tension for block in loaded)
    shown = f"{pull:.6g} N" if len(loaded) == 1 else f"{least:.4g} to {pull:.6g} N"
    case.assumptions.append(f"pull on the flank {shown} (slack strand without tension)")
    heaviest = heaviest_block(rated)
    key = duty.rated[rated.index(heaviest)].key
    return blocks if within_strength(case, heaviest.tension, chain, key) else None
