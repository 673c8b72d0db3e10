"""Whether a reading of the measurement over pins tells the time."""

import numpy as np

from wearsim.geometry.profile import Vector


def ambiguity(over_pins: Vector, error: float) -> str:
    """Return why a reading over pins may belong to several times of a life.

    Parameters
    ----------
    over_pins : numpy.ndarray
        The measurement over the life [mm].
    error : float
        Of the reading [mm].

    Returns
    -------
    str
        What must hold and what to do; empty where it falls all the time, but for the error.

    Examples
    --------
    >>> ambiguity(np.array([80.0, 79.9, 79.95]), 0.1)
    ''
    """
    again = float((over_pins - np.minimum.accumulate(over_pins)).max())
    if again <= error:
        return ""
    return (
        f"must belong to one time, but the measurement over pins grows again by {again:.3g} mm in the "
        "life: measure the depth"
    )
