"""The standard teeth that go with a chain."""

from functools import cache

from wearsim.catalogue.catalogues import Chain
from wearsim.geometry.forms import TOOTH_FORMS


def standard_form(chain: Chain) -> str:
    """Return the profile of a case that goes with a chain.

    Examples
    --------
    >>> from wearsim.catalogue.catalogues import chains
    >>> standard_form(chains()["08A-1"]), standard_form(chains()["08B-1"])
    ('ansi_b29', 'iso606')
    """
    return next(name for name, form in TOOTH_FORMS.items() if chain.series in form.usual_for)


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
    return 2.0 * TOOTH_FORMS[form].gap(pitch, roller_diameter, teeth).tip_radius
