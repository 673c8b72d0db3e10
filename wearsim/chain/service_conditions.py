"""How a drive is used, in words, and the factors and the wear condition that go with it."""

from dataclasses import dataclass
from typing import NamedTuple

from wearsim.catalogue.catalogues import nearest
from wearsim.chain.joint_pressure import JointApplication, joint_application
from wearsim.chain.power_rating import application_factor
from wearsim.errors import CaseError, Fault


class Lubrication(NamedTuple):
    """What a word for a lubrication stands for in the tables.

    That of GOST ends with periodic lubrication: a dry joint wears more than its factor of 1.5 says.
    """

    wear_condition: str  # row of the table of wear conditions
    gost: str  # state of the GOST table of lubrication
    lubricant: str  # row of the table of lubricants


LUBRICATIONS = {
    "drip": Lubrication("hardened, oiled", "drip", "drip"),
    "oil-bath": Lubrication("hardened, oiled", "continuous", "oil bath"),
    "forced": Lubrication("hardened, oiled", "continuous", "forced"),
    "periodic": Lubrication("normalised, greased", "periodic", "manual"),
    "grease": Lubrication("normalised, greased", "periodic", "greased"),
    "dry": Lubrication("hardened, dry", "periodic", "dry"),
}
"""What the words for a lubrication stand for."""

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

    lubrication: str  # word of `LUBRICATIONS`
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
    supplied = LUBRICATIONS[words["lubrication"]]
    driven, load = SHOCKS[words["shock"]]
    shifts = next(word for most, word in SHIFTS if hours_per_day <= most)
    return ServiceConditions(
        lubrication=words["lubrication"],
        wear_condition=supplied.wear_condition,
        service_factor=application_factor("smooth", driven),
        joint_application=joint_application(load, supplied.gost, shifts),
    )
