"""How a drive is used, in words, and the factors and the wear condition that go with it."""

from dataclasses import dataclass

from wearsim.catalogue.catalogues import HARDNESSES, condition_of_teeth, environments, lubricants, nearest
from wearsim.chain.joint_pressure import JointApplication, joint_application
from wearsim.chain.power_rating import application_factor
from wearsim.errors import CaseError, Fault, quoted

LUBRICATIONS = {
    "drip": "drip",
    "oil bath": "continuous",
    "forced": "continuous",
    "manual": "periodic",
    "greased": "periodic",
    "dry": "periodic",
}
"""Lubricants that a drive is designed for, with their state in the GOST table of lubrication.

That table ends with periodic lubrication: a dry joint wears more than its factor of 1.5 says.
"""

STEADY = "steady"
"""Load without shocks in the GOST table."""

SHOCKS = {
    "smooth": ("smooth", STEADY),
    "moderate": ("moderate shocks", "moderate shocks"),
    "heavy": ("heavy shocks", "heavy shocks"),
}
"""Driven machine of ISO 10823, and load of the GOST table, by the word for shocks."""


def load_of(service_factor: float) -> str:
    """Return the load of the GOST table whose shocks have the f1 nearest to one, of two as near the harder.

    Examples
    --------
    Moderate and heavy shocks have 1.4 and 1.8, moderate ones of both machines 1.7:

    >>> [load_of(factor) for factor in (1.0, 1.1, 1.4, 1.7, 2.1)]
    ['steady', 'steady', 'moderate shocks', 'heavy shocks', 'heavy shocks']
    """
    factors = {load: application_factor("smooth", driven) for driven, load in SHOCKS.values()}
    return min(factors, key=lambda load: (abs(factors[load] - service_factor), -factors[load]))


SHIFTS = ((8.0, "one"), (16.0, "two"), (24.0, "three"))
"""Hours a day up to which a drive runs in so many shifts."""


_OTHER_WORDS = {
    "continuous": "forced",
    "grease": "greased",
    "periodic": "manual",
    "steady": "smooth",
    "unhardened": "normalised",
}
"""Words that others, or earlier versions of wearsim, use."""


def plain_word(text: str) -> str:
    """Return a word about the use of a drive as the tables have it.

    Examples
    --------
    >>> plain_word("Oil-bath"), plain_word("periodic")
    ('oil bath', 'manual')
    """
    word = text.strip().lower().replace("-", " ").replace("_", " ")
    return _OTHER_WORDS.get(word, word)


@dataclass(frozen=True)
class ServiceConditions:
    """What follows from how a drive is used."""

    lubrication: str  # row of the table of lubricants
    environment: str  # row of the table of environments
    tooth_hardness: str  # word of `HARDNESSES`
    service_factor: float  # f1 of ISO 10823, for an electric motor or another smooth driver
    joint_application: JointApplication  # factors of GOST practice, for a shaft that can be moved

    @property
    def joint_application_factor(self) -> float:
        """K_e, their product."""
        return self.joint_application.factor

    @property
    def wear_condition(self) -> str:
        """Row of the table of wear conditions."""
        return condition_of_teeth(lubricants()[self.lubrication], self.tooth_hardness)

    @property
    def tables(self) -> dict[str, dict[str, str]]:
        """The three words as tables of a case."""
        return {
            "wear": {"tooth_hardness": self.tooth_hardness},
            "lubrication": {"lubricant": self.lubrication, "environment": self.environment},
        }


def service_conditions(
    lubrication: str = "drip",
    shock: str = "smooth",
    hours_per_day: float = 8.0,
    environment: str = "clean",
    tooth_hardness: str = "hardened",
) -> ServiceConditions:
    """Return the wear condition and the factors of a drive from words about its use.

    Parameters
    ----------
    lubrication : str
        ``drip``, ``oil bath``, ``forced``, ``manual``, ``greased`` or ``dry``.
    shock : str
        Of the driven machine: ``smooth``, ``moderate`` or ``heavy``.
    hours_per_day : float
        Above 0 to 24: up to 8 are one shift, up to 16 two, above that three.
    environment : str
        ``clean``, ``dust``, ``wet``, ``mud`` or ``soil``.
    tooth_hardness : str
        ``hardened`` or ``normalised``.

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
    given = (
        ("lubrication", lubrication, LUBRICATIONS),
        ("shock", shock, SHOCKS),
        ("environment", environment, environments()),
        ("tooth_hardness", tooth_hardness, HARDNESSES),
    )
    words = {key: plain_word(word) for key, word, _ in given}
    faults = [
        Fault(f"must be one of {', '.join(known)}{nearest(word, list(known))} (got {quoted(word)})", key)
        for key, word, known in given
        if words[key] not in known
    ]
    if not 0.0 < hours_per_day <= 24.0:
        message = f"must be above 0 and at most 24 (got {hours_per_day:g}): give the running hours per day"
        faults.append(Fault(message, "hours_per_day"))
    if faults:
        raise CaseError(faults)
    driven, load = SHOCKS[words["shock"]]
    supply, shifts = LUBRICATIONS[words["lubrication"]], shifts_of(hours_per_day)
    return ServiceConditions(
        lubrication=words["lubrication"],
        environment=words["environment"],
        tooth_hardness=words["tooth_hardness"],
        service_factor=application_factor("smooth", driven),
        joint_application=joint_application(load, supply, shifts),
    )


def shifts_in_words(shifts: str) -> str:
    """Return a number of shifts as one reads it.

    Examples
    --------
    >>> shifts_in_words("one"), shifts_in_words("three")
    ('one shift', 'three shifts')
    """
    return f"{shifts} {'shift' if shifts == 'one' else 'shifts'}"


def shifts_of(hours_per_day: float) -> str:
    """Return in words the shifts in which a drive runs so many hours a day."""
    return next(shifts for most, shifts in SHIFTS if hours_per_day <= most)
