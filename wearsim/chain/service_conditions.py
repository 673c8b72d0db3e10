"""How a drive is used, in words, and the factors and the wear condition that go with it."""

from dataclasses import dataclass

from wearsim.catalogue.catalogues import nearest
from wearsim.chain.joint_pressure import JointApplication, joint_application
from wearsim.chain.power_rating import application_factor
from wearsim.errors import CaseError, Fault

LUBRICATIONS = {
    "drip": ("hardened, oiled", "drip"),
    "oil-bath": ("hardened, oiled", "continuous"),
    "forced": ("hardened, oiled", "continuous"),
    "periodic": ("normalised, greased", "periodic"),
    "grease": ("normalised, greased", "periodic"),
    "dry": ("hardened, dry", "periodic"),
}
"""Condition of wear, and state of the GOST table of lubrication, by the word for a lubrication.

That table ends with periodic lubrication: a dry joint wears more than its factor of 1.5 says.
"""

SHOCKS = {
    "smooth": ("smooth", "steady"),
    "moderate": ("moderate shocks", "moderate shocks"),
    "heavy": ("heavy shocks", "heavy shocks"),
}
"""Driven machine of ISO 10823, and load of the GOST table, by the word for shocks."""

SHIFTS = ((8.0, "one"), (16.0, "two"), (24.0, "three"))
"""Hours a day up to which a drive runs in so many shifts."""


_OTHER_WORDS = {"continuous": "forced", "manual": "periodic", "steady": "smooth"}


def plain_word(text: str) -> str:
    """Return a word about the use of a drive as the tables have it.

    Examples
    --------
    >>> plain_word("Oil bath"), plain_word("manual")
    ('oil-bath', 'periodic')
    """
    word = text.strip().lower().replace(" ", "-").replace("_", "-")
    return _OTHER_WORDS.get(word, word)


@dataclass(frozen=True)
class ServiceConditions:
    """What follows from how a drive is used."""

    wear_condition: str  # row of the table of wear conditions
    service_factor: float  # f1 of ISO 10823, for an electric motor or another smooth driver
    joint_application: JointApplication  # factors of GOST practice, for a shaft that can be moved

    @property
    def joint_application_factor(self) -> float:
        """K_e, their product."""
        return self.joint_application.factor


def service_conditions(
    lubrication: str = "drip", shock: str = "smooth", hours_per_day: float = 8.0
) -> ServiceConditions:
    """Return the wear condition and the factors of a drive from words about its use.

    Parameters
    ----------
    lubrication : str
        ``drip``, ``oil-bath``, ``forced``, ``periodic``, ``grease`` or ``dry``.
    shock : str
        Of the driven machine: ``smooth``, ``moderate`` or ``heavy``.
    hours_per_day : float
        Above 0 to 24: up to 8 are one shift, up to 16 two, above that three.

    Returns
    -------
    ServiceConditions
        Wear condition, f1 of `application_factor`, and the factors of `joint_application` with their
        product K_e.

    Raises
    ------
    CaseError
        Words that are none of these, or hours that no day has; all of them at once.

    Examples
    --------
    1.35 for shocks, 1 for drip oil and 1.25 for two shifts:

    >>> used = service_conditions("drip", "moderate", 16.0)
    >>> used.wear_condition, used.service_factor, used.joint_application_factor
    ('hardened, oiled', 1.4, 1.6875)
    """
    words = {"lubrication": plain_word(lubrication), "shock": plain_word(shock)}
    faults = [
        Fault(f"must be one of {', '.join(known)}{nearest(word, list(known))} (got {word!r})", key)
        for key, word, known in (("lubrication", lubrication, LUBRICATIONS), ("shock", shock, SHOCKS))
        if words[key] not in known
    ]
    if not 0.0 < hours_per_day <= 24.0:
        message = f"must be above 0 and at most 24 (got {hours_per_day:g}): give the hours of a day"
        faults.append(Fault(message, "hours_per_day"))
    if faults:
        raise CaseError(faults)
    condition, oil = LUBRICATIONS[words["lubrication"]]
    driven, load = SHOCKS[words["shock"]]
    shifts = next(word for most, word in SHIFTS if hours_per_day <= most)
    return ServiceConditions(
        wear_condition=condition,
        service_factor=application_factor("smooth", driven),
        joint_application=joint_application(load, oil, shifts),
    )
