"""Laws of cumulative wear: a row for each, with its parameters and the readings it applies to.

A law gives the shape of the wear; how much it is stands in its level, which is fitted too. Exposure
is in parts of the longest one, load in parts of the geometric mean.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from wearsim.geometry.profile_points import Vector
from wearsim.kernels.severity import FIRST, LEVEL, MILD, SECOND, STEEP
from wearsim.study.judge.wear_series import WearSeries

Values = Mapping[str, Vector]
"""Values of parameters by name, each of shape (k, 1)."""


@dataclass(frozen=True)
class LawParameter:
    """A constant of a law; `low` to `high` is where it is expected to be, with 95 % before any reading.

    Between the ends it is taken as normal, or as log-normal where both are above 0 and `log` is set.
    """

    name: str
    low: float
    high: float
    log: bool = True
    of_exposure: bool = False  # in parts of the longest exposure


@dataclass(frozen=True)
class WearLaw:
    """A row of the table of laws."""

    name: str
    formula: str
    parameters: tuple[LawParameter, ...]
    applies: Callable[[WearSeries], bool]
    clock: Callable[[Values, WearSeries], Vector]  # amount of wear at a load of 1, shape (k, n)
    load_power: bool | None = False  # load to a fitted power, to the power 1, or neither load nor slip


def ln_shape(law: WearLaw, values: Values, data: WearSeries) -> Vector:
    """Return the logarithm of the wear, less the level of the law, shape (k, n)."""
    worn = np.log(np.maximum(law.clock(values, data), 1e-300))
    if law.load_power is None:
        return worn
    power = values["load_exponent"] if law.load_power else 1.0
    return np.asarray(worn + power * np.log(data.load) + np.log(data.slip))


def _varies(column: Vector) -> bool:
    return bool(np.isfinite(column).all() and np.ptp(column) > 1e-9 * abs(column).max())


def _always(data: WearSeries) -> bool:
    return True


def _grows(data: WearSeries) -> bool:
    return _varies(data.exposure)


def _has_history(data: WearSeries) -> bool:
    return bool(data.slots.shape[1] > 1)


def _steady(values: Values, data: WearSeries) -> Vector:
    return data.exposure[None, :]


def _nothing(values: Values, data: WearSeries) -> Vector:
    return np.ones((1, data.exposure.size))


def _power(values: Values, data: WearSeries) -> Vector:
    return np.asarray(data.exposure ** values["exposure_exponent"])


def _running_in(values: Values, data: WearSeries) -> Vector:
    length, excess = values["run_in"], values["run_in_factor_less_1"]
    return np.asarray(data.exposure - excess * length * np.expm1(-data.exposure / length))


def _offset(values: Values, data: WearSeries) -> Vector:
    return np.asarray(values["offset"] + data.exposure)


def _lubricant_age(values: Values, data: WearSeries) -> Vector:
    first = _faded(data.age, values)
    last = _faded(data.age + data.exposure - data.start, values)
    added = data.exposure - data.start + values["dry_factor_less_1"] * (last - first)
    return data.summed(added)


def _faded(age: Vector, values: Values) -> Vector:
    """Return the integral of the ramp from 0 to 1 over the age."""
    lasts, width = values["lasts"], values["fades_over"]
    after = np.clip((age - lasts) / width, 0.0, None)
    return np.asarray(width * np.where(after < 1.0, 0.5 * after**2, after - 0.5))


def _environment(values: Values, data: WearSeries) -> Vector:
    factors = [values[name] for name in _factor_names(data)]
    factor = np.concatenate([np.ones_like(factors[0]), *factors], axis=1)[:, data.environment]
    return data.summed(factor * (data.exposure - data.start))


def _factor_names(data: WearSeries) -> list[str]:
    first, *others = data.environments
    return [f"{other} over {first}" for other in others]


def t_gamma_rate(t_gamma: Vector) -> Vector:
    """Return the published rate of wear of wheel and rail steel, dry [ug/(m mm2)].

    5.3 x in mild wear, 55 in severe wear, 55 + 61.9 (x - 77.2) in catastrophic wear: Lewis and
    Dwyer-Joyce 2004, Braghin et al. 2006, the last branch as joined to the one before.

    Examples
    --------
    >>> t_gamma_rate(np.array([10.0, 20.0, 78.2])).tolist()
    [53.0, 55.0, 116.9]
    """
    beyond = LEVEL + STEEP * (t_gamma - SECOND)
    return np.where(t_gamma < FIRST, MILD * t_gamma, np.maximum(LEVEL, beyond))


def _t_gamma(values: Values, data: WearSeries) -> Vector:
    return (t_gamma_rate(data.t_gamma) * data.exposure)[None, :]


def _pv(values: Values, data: WearSeries) -> Vector:
    ln_pv = np.log(data.load * data.speed)
    ends = ln_pv.min(), ln_pv.max()
    place = ends[0] + values["transition"] * (ends[1] - ends[0])
    return np.asarray(data.exposure * np.where(ln_pv > place, values["severe_factor"], 1.0))


_EXPONENT = LawParameter("exposure_exponent", 0.0, 2.0, log=False)
_LOAD_EXPONENT = LawParameter("load_exponent", 0.0, 2.0, log=False)
_RUN_IN = (
    LawParameter("run_in_factor_less_1", 0.1, 100.0),
    LawParameter("run_in", 0.003, 1.0, of_exposure=True),
)
_OFFSET = LawParameter("offset", 0.003, 10.0, of_exposure=True)
_AGE = (
    LawParameter("dry_factor_less_1", 0.3, 100.0),
    LawParameter("lasts", 0.03, 3.0, of_exposure=True),
    LawParameter("fades_over", 0.003, 1.0, of_exposure=True),
)
_PV = (LawParameter("transition", 0.05, 0.95, log=False), LawParameter("severe_factor", 1.0, 100.0))


def _load_varies(data: WearSeries) -> bool:
    return _varies(data.load)


def laws_for(data: WearSeries) -> list[WearLaw]:
    """Return the laws that apply to readings."""
    factors = tuple(LawParameter(name, 0.1, 100.0) for name in _factor_names(data))
    steady: tuple[LawParameter, ...] = ()
    clocks = [
        ("", "s", steady, _steady, _always),
        ("cycle power", "s^b", (_EXPONENT,), _power, _grows),
        ("running-in", "(s + (f - 1) s_r (1 - exp(-s/s_r)))", _RUN_IN, _running_in, _has_history),
        ("offset", "(s_0 + s)", (_OFFSET,), _offset, _has_history),
        ("lubricant age", "(integral of 1 + (R - 1) F((a - s_L)/w))", _AGE, _lubricant_age, _noted),
        ("environment", "(sum of phi s)", factors, _environment, _several_environments),
    ]
    laws = [WearLaw("none", "k", (), _always, _nothing, None)]
    for name, formula, parameters, clock, applies in clocks:
        laws.append(WearLaw(name or "Archard", f"k P {formula}", parameters, applies, clock))
        with_load = (*parameters, _LOAD_EXPONENT)
        both = "powers" if clock is _power else f"{name}, load power".removeprefix(", ")
        laws.append(WearLaw(both, f"k P^a {formula}", with_load, _with_load(applies), clock, True))
    laws += [
        WearLaw("T-gamma", "k s g(T gamma/A)", (), _has_t_gamma, _t_gamma, None),
        WearLaw("p v", "k P s, times c beyond some p v", _PV, _has_speed, _pv),
    ]
    return [law for law in laws if law.applies(data)]


def _with_load(applies: Callable[[WearSeries], bool]) -> Callable[[WearSeries], bool]:
    return lambda data: applies(data) and _load_varies(data)


def _noted(data: WearSeries) -> bool:
    return data.relubricated


def _several_environments(data: WearSeries) -> bool:
    return len(data.environments) > 1


def _has_t_gamma(data: WearSeries) -> bool:
    return _varies(data.t_gamma)


def _has_speed(data: WearSeries) -> bool:
    return bool(np.isfinite(data.speed).all()) and _varies(data.load * data.speed)
