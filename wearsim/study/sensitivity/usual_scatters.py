"""What else of a case usually scatters, offered where only its wear coefficients do."""

from collections.abc import Sequence

from wearsim.case.model import Case
from wearsim.runner.design import value_at
from wearsim.runner.scatter import coefficient_key

_USUAL = {
    "load.tension_N": 0.1,
    "load.torque_N_m": 0.1,
    "load.power_kW": 0.1,
    "load.speed_rpm": 0.03,
    "sprocket.evolute_offset_mm": 0.02,
    "sprocket.face_width_mm": 0.02,
    "gear.face_width_mm": 0.02,
}
"""Standard deviations of load, speed and geometry, as parts of their values."""


def only_coefficients(case: Case, keys: Sequence[str]) -> bool:
    """Return whether no key but wear coefficients scatters."""
    return set(keys) <= {coefficient_key(case), *case.drive.wear_coefficients}


def usual_scatters(case: Case) -> list[str]:
    """Return lines of a table [uncertainty] for load, speed and geometry of a case."""
    found = ((key, share, value_at(case.inputs, key)) for key, share in _USUAL.items())
    return [
        f'"{key}" = {{distribution = "normal", standard_deviation = {share * value:.3g}}}'
        for key, share, value in found
        if isinstance(value, float)
    ]
