"""The tables that a case was read from, as attributes that an editor or a notebook completes."""

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, cast

if TYPE_CHECKING:
    from wearsim.case.keys import (
        CaseTables,
        ChainTable,
        JointTable,
        LoadTable,
        MaterialsTable,
        MechanismTable,
        StopTable,
    )


class ReadTables:
    """Tables of a case with every default; a table whose name is taken is in `tables` alone."""

    # No properties but cached ones: IPython completes what follows them.

    @property
    def complete_inputs(self) -> Mapping[str, Any]:
        """All tables with every default taken."""
        raise NotImplementedError

    @cached_property
    def tables(self) -> "CaseTables":
        """All tables; of a whole drive as of its driver, of a pair of gears those of gears."""
        from wearsim.input.keys import schema_of
        from wearsim.input.typed_tables import typed_tables

        inputs = self.complete_inputs
        return cast("CaseTables", typed_tables(schema_of(inputs), inputs))

    @cached_property
    def chain(self) -> "ChainTable":
        """Keys of [chain]."""
        return self.tables.chain

    @cached_property
    def load(self) -> "LoadTable":
        """Keys of [load]."""
        return self.tables.load

    @cached_property
    def mechanism(self) -> "MechanismTable":
        """Keys of [mechanism]."""
        return self.tables.mechanism

    @cached_property
    def material(self) -> "MaterialsTable":
        """Keys of [material]."""
        return self.tables.material

    @cached_property
    def joint(self) -> "JointTable | None":
        """Keys of [joint]; None on a straight strand."""
        return self.tables.joint

    @cached_property
    def stop(self) -> "StopTable":
        """Keys of [stop]."""
        return self.tables.stop
