"""A flank whose load and sliding come from a table."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from wearsim.case.model import Case, Drive
from wearsim.catalogue.catalogues import Chain
from wearsim.contact.engagement import ContactKind, Mechanism
from wearsim.geometry.profile_points import Vector
from wearsim.input.csv_tables import PrescribedTable


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
