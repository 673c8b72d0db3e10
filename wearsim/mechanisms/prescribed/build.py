"""From a table of load and sliding to the drive of its flank."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from wearsim.case.chain_record import ChainRecord
from wearsim.case.duty_blocks import GivenDuty
from wearsim.case.model import Case, Drive, WearInput
from wearsim.case.table_inputs import slip_fraction
from wearsim.catalogue.catalogues import Chain
from wearsim.contact.engagement import ContactKind, Mechanism
from wearsim.geometry.profile_points import Vector
from wearsim.input.csv_tables import PrescribedTable, read_prescribed


@dataclass(frozen=True, eq=False)
class PrescribedDrive(Drive):
    """A flank whose load and sliding come from a table."""

    table: PrescribedTable
    slip_fraction: float  # scales its sliding
    chain: Chain  # whose roller touches it

    def mate(self, last: Mapping[str, Vector], node: int) -> tuple[float, str]:
        """Return the roller."""
        return 0.5 * self.chain.roller_diameter, "roller"

    def mechanism(self, case: Case) -> Mechanism:
        """Return the rows of the table as a contact."""
        from wearsim.mechanisms.prescribed.contact import PrescribedMechanism

        table = self.table
        path = table.sliding_distance
        slip = table.slip_ratio if table.slip_ratio is not None else path
        assert slip is not None
        speed = table.sliding_speed
        return PrescribedMechanism(
            kind=ContactKind.TRAVELLING if table.slip_ratio is not None else ContactKind.LOCAL,
            arc_length=table.arc_length,
            load_per_width=table.load_per_width,
            slip=self.slip_fraction * slip,
            sliding_speed=self.slip_fraction * speed if speed is not None else np.full(slip.size, np.nan),
            flank_curvature=table.flank_curvature,
            mate_radius=0.5 * self.chain.roller_diameter,
            modulus=case.modulus,
        )


def prescribed_drive(
    case: ChainRecord, wear: WearInput, chain: Chain, duty: GivenDuty | None
) -> PrescribedDrive | None:
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
    table = read_prescribed(case.path(tables.mechanism.table_file), key, case.faults)
    if table is None:
        return None
    if wear.law == "drozdov" and wear.constants["speed_exponent"] and table.sliding_speed is None:
        case.faults.add(
            key, "the drozdov law needs the column sliding_speed_mm_per_s: add it or set speed_exponent 0"
        )
        return None
    if wear.severe_factor != 1.0 and table.sliding_speed is None:
        case.faults.add(
            key, "pv_limit_MPa_mm_per_s needs the column sliding_speed_mm_per_s: add it or remove the limit"
        )
        return None
    if wear.law == "t_gamma" and table.slip_ratio is None:
        case.faults.add(key, "law = 't_gamma' needs the column slip_ratio in place of sliding_distance_mm")
        return None
    if wear.pressure_exponent < 1.0 and table.slip_ratio is not None:
        case.faults.add(
            "wear.pressure_exponent",
            "must be at least 1 with a given slip ratio: below 1 a pit deepens itself and the problem "
            f"is ill-posed (got {wear.pressure_exponent:g})",
        )
        return None
    return PrescribedDrive(table, slip_fraction(case), chain)
