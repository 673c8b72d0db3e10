"""The standard teeth that go with a chain."""

from functools import cache

from wearsim.catalogue.catalogues import Chain
from wearsim.geometry.forms.ansi_b29 import TypeIITooth
from wearsim.geometry.forms.gost591 import GostTooth
from wearsim.geometry.forms.iso606 import iso606_gap

_FORMS = {"ISO606-A/ANSI B29.1": "ansi_b29", "ISO606-H": "ansi_b29", "GOST13568": "gost591"}
"""Profile of a case by the series of its chain, where it is not that of ISO 606."""


def standard_form(chain: Chain) -> str:
    """Return the profile of a case that goes with a chain.

    Examples
    --------
    >>> from wearsim.catalogue.catalogues import chains
    >>> standard_form(chains()["08A-1"]), standard_form(chains()["08B-1"])
    ('ansi_b29', 'iso606')
    """
    return _FORMS.get(chain.series, "iso606")


def standard_tip_diameter(chain: Chain, teeth: int) -> float:
    """Return the tip diameter that a case takes for a chain [mm].

    Examples
    --------
    >>> from wearsim.catalogue.catalogues import chains
    >>> round(standard_tip_diameter(chains()["08A-1"], 20), 4)  # p (0.6 + cot(9 deg))
    87.8046
    """
    return _tip_diameter(standard_form(chain), chain.pitch, chain.roller_diameter, teeth)


@cache
def _tip_diameter(form: str, pitch: float, roller_diameter: float, teeth: int) -> float:
    if form == "ansi_b29":
        return TypeIITooth(pitch, roller_diameter, teeth).outside_diameter
    if form == "gost591":
        return GostTooth(pitch, roller_diameter, teeth).outside_diameter
    return 2.0 * iso606_gap(pitch, roller_diameter, teeth).tip_radius
