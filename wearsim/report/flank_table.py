"""The working flank of a case as a table."""

import pandas as pd

from wearsim.case.model import Case
from wearsim.errors import CaseError, Fault


def profile_table(case: Case) -> pd.DataFrame:
    """Return the points of a flank with what follows from them."""
    columns = case.drive.profile_columns()
    if not columns:
        message = "the case must have a sprocket, a table of loads or gears have none: nothing to write"
        raise CaseError([Fault(message, "mechanism.kind", case.name)])
    return pd.DataFrame(columns)
