"""Fits to lives repeated by the library reliability, which also knows how sure their parameters are."""

import io
import math
import re
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, redirect_stdout
from dataclasses import dataclass
from importlib.metadata import version
from typing import Any

import numpy as np
import pandas as pd

from wearsim.geometry.profile_points import Vector
from wearsim.study.uncertainty.percentiles import CONFIDENCE, DistributionFit, Flags

TOLERANCE = 0.01
"""Relative difference of parameters from which the two fits are told to disagree."""


@dataclass(frozen=True)
class BoundedValue:
    """A parameter between its bounds."""

    value: float  # estimate of maximum likelihood
    low: float  # ends of its 95 % interval by the curvature of the likelihood; nan where not known
    high: float  # ends of its 95 % interval by the curvature of the likelihood; nan where not known


@dataclass(frozen=True)
class CrossFit:
    """A distribution fitted by reliability."""

    name: str  # `lognormal` or `weibull`
    # shape, scale: those of `DistributionFit`: sigma of ln L and the median [h]; modulus and characteristic
    # life [h]
    shape: BoundedValue
    scale: BoundedValue


@dataclass(frozen=True)
class CrossCheck:
    """What reliability makes of lives."""

    library: str  # its name and version
    fits: tuple[CrossFit, ...]  # in the order of the fits that they repeat
    differences_found: tuple[str, ...]  # where it differs from those, has failed or warns


def cross_check(lives: Vector, reached: Flags, fits: Sequence[DistributionFit]) -> CrossCheck:
    """Return the fits to some lives repeated by reliability."""
    library = f"reliability {version('reliability')}"
    if not fits:
        return CrossCheck(library, (), ())
    # As a unit the library's optimisers take a middling life better than an hour.
    unit = float(np.median(lives[reached]))
    found, differences_found = [], []
    for fit in fits:
        try:
            crossed, printed = _repeated(fit.name, lives[reached] / unit, lives[~reached] / unit)
        except (ArithmeticError, RuntimeError, ValueError) as error:
            differences_found.append(f"{library} finds no {fit.name} fit: {error}")
            continue
        scale = BoundedValue(*(unit * part for part in vars(crossed.scale).values()))
        crossed = CrossFit(fit.name, crossed.shape, scale)
        found.append(crossed)
        differences_found += [f"{library}, {fit.name}: {text}" for text in printed]
        differences_found += _differences(library, fit, crossed)
    return CrossCheck(library, tuple(found), tuple(differences_found))


def _repeated(name: str, failures: Vector, suspensions: Vector) -> tuple[CrossFit, list[str]]:
    """Fit one distribution; what the library prints comes as lines."""
    with _kept_to_itself() as printed:
        from reliability.Fitters import Fit_Lognormal_2P, Fit_Weibull_2P

        fitter = Fit_Weibull_2P if name == "weibull" else Fit_Lognormal_2P
        found: Any = fitter(
            failures=failures,
            right_censored=suspensions,
            CI=CONFIDENCE,
            optimizer="best",  # of all it has: the usual one may stop short of the maximum likelihood
            show_probability_plot=False,
            print_results=False,
        )
    lines = re.sub(r"\x1b\[[\d;]*m", "", printed.getvalue()).splitlines()
    return _parameters(name, found), [line.removeprefix("WARNING: ") for line in lines if line]


def _parameters(name: str, found: Any) -> CrossFit:
    if name == "weibull":
        shape = BoundedValue(float(found.beta), float(found.beta_lower), float(found.beta_upper))
        scale = BoundedValue(float(found.alpha), float(found.alpha_lower), float(found.alpha_upper))
    else:
        shape = BoundedValue(float(found.sigma), float(found.sigma_lower), float(found.sigma_upper))
        scale = BoundedValue(*map(math.exp, (found.mu, found.mu_lower, found.mu_upper)))
    return CrossFit(name, shape, scale)


@contextmanager
def _kept_to_itself() -> Iterator[io.StringIO]:
    """Catch what reliability prints, and take back what it sets for the whole process."""
    printing = [f"display.{name}" for name in ("float_format", "max_columns", "max_rows", "width")]
    kept = [part for name in printing for part in (name, pd.get_option(name))]
    printed = io.StringIO()
    with (
        redirect_stdout(printed),
        warnings.catch_warnings(),
        np.errstate(all="ignore"),
        pd.option_context(*kept),
    ):
        warnings.simplefilter("ignore")
        yield printed


def _differences(library: str, fit: DistributionFit, crossed: CrossFit) -> list[str]:
    found = []
    for part in ("shape", "scale"):
        ours, theirs = getattr(fit, part), getattr(crossed, part).value
        if not abs(theirs - ours) <= TOLERANCE * ours:
            found.append(
                f"the {part} of the {fit.name} fit is {ours:.6g}, that of {library} {theirs:.6g}: they "
                f"should agree within {100 * TOLERANCE:g} %, trust neither"
            )
    return found
