"""The highest pressure on the flanks of a case while they are new."""

import numpy as np

from wearsim.case.model import Case, WrapDrive
from wearsim.contact.engagement import Contact
from wearsim.contact.hertz import peak_pressure


def new_peak_pressure(case: Case) -> float:
    """Return the highest pressure of a case on its new flanks, without a run."""
    # Kernels compile where their module is imported for the first time: only those needed.
    if isinstance(case.drive, WrapDrive):
        from wearsim.simulation.law_of_case import wear_law
        from wearsim.simulation.wrap_life import wrap_contact
        from wearsim.wear.bodies import highest_load

        law = wear_law(case.wear, case.wear.coefficient)
        return highest_load(wrap_contact(case, case.drive), law, None)[0]
    from wearsim.simulation.pointwise import pointwise_mechanism

    return new_contact_pressure(pointwise_mechanism(case).contact)


def new_contact_pressure(contact: Contact) -> float:
    """Return the highest pressure on a flank that has not worn, by Hertz's theory."""
    flank = contact.profile
    touch = contact.engage(flank.x.copy(), flank.y.copy(), np.zeros(flank.x.size))
    relative = np.maximum(touch.relative_curvature, 0.0)
    return float(peak_pressure(touch.load_per_width, relative, contact.modulus).max())
