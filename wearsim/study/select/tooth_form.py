"""The standard teeth that go with a chain."""

from functools import cache

from wearsim.catalogue.catalogues import Chain
from wearsim.geometry.forms.ansi_b29 import TypeIITooth
from wearsim.geometry.forms.gost591 import GostTooth
from wearsim.geometry.forms.iso606 import iso606_gap
from wearsim.study.select.requirements import SERIES

TOOTH_FORMS = {
    SERIES["A"]: "ansi_b29",
    SERIES["B"]: "iso606",
    SERIES["H"]: "ansi_b29",
    SERIES["GOST"]: "gost591",
}
"""Profile of a case by the series of its chain."""


def standard_tip_diameter(chain: Chain, teeth: int) -> float:
    """Return the tip diameter that a case takes for a chain [mm].

    Examples
    --------
    >>> from wearsim.catalogue.catalogues import chains
    >>> round(standard_tip_diameter(chains()["08A-1"], 20), 4)  # p (0.6 + cot(9 deg))
    87.8046
    """
    return _tip_diameter(TOOTH_FORMS[chain.series], chain.pitch, chain.roller_diameter, teeth)


@cache
def _tip_diameter(form: str, pitch: float, roller_diameter: float, teeth: int) -> float:
    if form == "ansi_b29":
        return TypeIITooth(pitch, roller_diameter, teeth).outside_diameter
    if form == "gost591":
        return GostTooth(pitch, roller_diameter, teeth).outside_diameter
    return 2.0 * iso606_gap(pitch, roller_diameter, teeth).tip_radius
