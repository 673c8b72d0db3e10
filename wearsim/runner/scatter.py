"""What of a case scatters, and its cases at samples of that."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy import stats

from wearsim.case.keys.study_tables import Distribution
from wearsim.case.model import Case, WearBand, log_deviation
from wearsim.catalogue.catalogues import wear_laws
from wearsim.drive.drive_case import with_one_wear
from wearsim.drive.load_case import load_case
from wearsim.errors import CaseError, Fault
from wearsim.geometry.profile_points import Vector
from wearsim.input.document import CaseSource, Document, read_document
from wearsim.input.named_files import file_paths
from wearsim.lubrication.keys import LASTS
from wearsim.runner.design import Design, design, replaced, value_at, value_in

WITH_FATIGUE = "a life ends by wear or by contact fatigue, whichever is first ([fatigue])"


@dataclass(frozen=True)
class ScatteredKey:
    """A key that scatters."""

    key: str  # its dotted name
    distribution: Distribution  # how it scatters
    value: float  # what it is in the case
    text: str  # the distribution in words


@dataclass(frozen=True)
class ScatteredCase:
    """A case and what of it scatters."""

    file: str  # what faults call it
    case: Case  # with the values of the file
    document: Document  # the file without [uncertainty], the wear coefficient by its own key
    scatters: tuple[ScatteredKey, ...]  # what scatters, independently of one another
    assumptions: tuple[str, ...]  # what is taken for granted about that

    @property
    def keys(self) -> tuple[str, ...]:
        """Keys that scatter."""
        return tuple(scatter.key for scatter in self.scatters)

    def values(self, shares: Vector) -> Vector:
        """Return values of the keys by their probabilities."""
        columns, faults = [], []
        for scatter, column in zip(self.scatters, shares.T, strict=True):
            try:
                columns.append(quantile(scatter.distribution, scatter.value)(column))
            except ValueError as error:
                faults.append(Fault(str(error), f'uncertainty."{scatter.key}"', self.case.name))
        if faults:
            raise CaseError(faults)
        return np.column_stack(columns)

    def design(self, shares: Vector) -> Design:
        """Return the cases at some probabilities of the keys."""
        rows = self.values(shares).tolist()
        return design(self.document, self.keys, rows, self.file)


def load_scattered(
    source: CaseSource, overrides: Sequence[str], least_horizon: float | None = None
) -> ScatteredCase:
    """Return a case and what of it scatters by its table [uncertainty]."""
    document = read_document(source, overrides)
    loaded = with_one_wear(load_case(source, overrides))
    case = loaded.chain_case.with_horizon(least_horizon or 0.0)
    given = _given(case)
    assumptions = []
    for coefficient, (value, band) in _coefficients(case).items():
        if coefficient not in given:
            given[coefficient] = _banded(value, band)
            assumptions.append(
                f"{coefficient} is log-normal, 90 % of it {band.low:.3g} to {band.high:.3g} times "
                f"{value:.3g}, its band (default; [uncertainty] gives another)"
            )
    for key, scatter, ends in _of_lubricant(case):
        if key not in given:
            given[key] = scatter
            assumptions.append(
                f"{key} is log-normal, 90 % of it {ends} (default; [uncertainty] gives another)"
            )
    if case.fatigue is not None:
        assumptions.append(WITH_FATIGUE)
    if len(given) > 1:
        assumptions.append("keys scatter independently of one another")
    scatters = tuple(_scatter(case, key, law, value_in(loaded, key)) for key, law in given.items())
    plain = plain_document(document, case)
    return ScatteredCase(document.faults.file, case, plain, scatters, tuple(assumptions))


def coefficient_key(case: Case) -> str:
    """Return the key of a case's wear coefficient."""
    return f"wear.{wear_laws()[case.wear.law].keys[0]}"


def _coefficients(case: Case) -> dict[str, tuple[float, WearBand]]:
    """Wear coefficients of the teeth and, on a wrap, of the joints, with their bands."""
    teeth, chain = (case.drive.wear_band(part, case.wear) for part in ("sprocket", "chain"))
    of_joints = {key: (value, chain) for key, value in case.drive.wear_coefficients.items()}
    return {coefficient_key(case): (case.wear.coefficient, teeth), **of_joints}


def _of_lubricant(case: Case) -> Iterator[tuple[str, Distribution, str]]:
    """Give keys of the lubricant that are not known exactly, how they scatter, and that in words.

    Beside a band that the user gives of the drive only those of which the case says how surely they are
    known, as that band holds the others.
    """
    given, table = case.lubrication, case.inputs.get("lubrication") or {}
    if given is None:
        return
    part = "chain" if case.drive.wear_coefficients else "sprocket"
    is_given = case.drive.wear_band(part, case.wear).is_given
    lasts = next((key for key in LASTS if key in table), "")
    dirt = given.dirt.ends and tuple((1.0 + end) / (1.0 + given.dirt.excess) for end in given.dirt.ends)
    found = (
        (lasts, "lasts_band_factor", given.lasts_ends, None),
        ("dry_factor", "dry_band_factor", given.dry_ends, 1.0),
        ("contamination_factor", "contamination_band_factor", dirt, 1.0),
    )
    for key, band, ends, least in found:
        if key not in table or not ends or ends == (1.0, 1.0) or (is_given and band not in given.stated):
            continue
        value, (low, high) = table[key], ends
        scatter = _banded(value, WearBand(low, high, "")).model_copy(update={"low": least})
        yield f"lubrication.{key}", scatter, f"{low:.3g} to {high:.3g} times {value:.3g}"


def _banded(value: float, band: WearBand) -> Distribution:
    """Return the log-normal distribution of which a band holds 90 %."""
    median = value * math.sqrt(band.low * band.high)
    sigma = log_deviation(band.low, band.high)
    return Distribution(distribution="lognormal", median=median, sigma_ln=sigma)


def _given(case: Case) -> dict[str, Distribution]:
    table: Mapping[str, Any] = case.inputs.get("uncertainty") or {}
    return {key: Distribution.model_validate(entry) for key, entry in table.items()}


def _scatter(case: Case, key: str, distribution: Distribution, given: Any) -> ScatteredKey:
    if key.startswith("run."):
        text = "keys of [run] say how a life is calculated and cannot scatter: remove it"
        raise CaseError([Fault(text, f'uncertainty."{key}"', case.name)])
    value = case.wear.coefficient if key == coefficient_key(case) else _number(case, key, given)
    return ScatteredKey(key, distribution, value, described(distribution, value))


def _number(case: Case, key: str, found: Any) -> float:
    if isinstance(found, bool | int) or not isinstance(found, float):
        what = "is not in the case" if found is None else f"is {found!r}"
        text = f"only a key that holds a number with a fraction can scatter, but it {what}"
        raise CaseError([Fault(text, f'uncertainty."{key}"', case.name)])
    return found


def plain_document(document: Document, case: Case) -> Document:
    """Return a case in which every value stands that a study changes."""
    data = {name: table for name, table in document.data.items() if name != "uncertainty"}
    if "condition" in case.inputs["wear"]:
        told = ("condition", "tooth_hardness")
        wear = {name: value for name, value in data.get("wear", {}).items() if name not in told}
        if case.drive.wear_coefficients:
            # The law of its teeth is that of the condition.
            wear["condition"] = case.inputs["wear"]["condition"]
        data = {**data, "wear": wear}
        data = replaced(data, coefficient_key(case).split("."), case.wear.coefficient)
    for key, setting in {**case.drive.wear_coefficients, **case.drive.wear_settings}.items():
        data = replaced(data, key.split("."), setting)
    data = replaced(data, ("run", "horizon_hours"), case.run.horizon_hours)
    return with_whole_paths(replace(document, data=data))


def with_whole_paths(document: Document) -> Document:
    """Return an input whose files are named by their whole paths."""
    data = document.data
    for place in file_paths(data):
        path = (document.folder / value_at(data, ".".join(place))).resolve()
        data = replaced(data, place, str(path))
    return replace(document, data=data)


Quantile = Callable[[Vector], Vector]


def quantile(scatter: Distribution, value: float) -> Quantile:
    """Return the value of a key by its probability.

    Examples
    --------
    >>> scatter = Distribution(distribution="lognormal", sigma_ln=0.5)
    >>> float(quantile(scatter, 2.0)(np.array([0.5]))[0])
    2.0
    """
    if scatter.sigma_ln == 0.0:
        median = value if scatter.median is None else scatter.median
        return lambda share: np.full(share.shape, float(median))
    whole = _whole(scatter, value)
    if scatter.distribution in ("uniform", "triangular"):
        return lambda share: np.asarray(whole.ppf(share))
    low = 0.0 if scatter.low is None else float(whole.cdf(scatter.low))
    high = 1.0 if scatter.high is None else float(whole.cdf(scatter.high))
    if not low < high:
        raise ValueError("its low and high must leave a part of the distribution, but leave none")
    return lambda share: np.asarray(whole.ppf(low + (high - low) * share))


def _whole(scatter: Distribution, value: float) -> "stats.distributions.rv_frozen":
    low, high = float(scatter.low or 0.0), float(scatter.high or 0.0)
    match scatter.distribution:
        case "lognormal":
            median = value if scatter.median is None else scatter.median
            sigma = float(scatter.sigma_ln or 0.0)
            if not median > 0.0:
                raise ValueError(f"a log-normal key must be above 0, is {median:g}")
            return stats.lognorm(sigma, scale=median)
        case "normal":
            mean = value if scatter.mean is None else scatter.mean
            return stats.norm(mean, float(scatter.standard_deviation or 1.0))
        case "uniform":
            return stats.uniform(low, high - low)
        case "triangular":
            mode = float(value if scatter.mode is None else scatter.mode)
            if not low <= mode <= high:
                raise ValueError(f"its mode must lie from {low:g} to {high:g}, is {mode:g}")
            return stats.triang((mode - low) / (high - low), low, high - low)
        case _:
            assert scatter.shape is not None and scatter.scale is not None
            return stats.weibull_min(scatter.shape, scale=scatter.scale)


def described(scatter: Distribution, value: float) -> str:
    """Return a distribution in words.

    Examples
    --------
    >>> described(Distribution(distribution="lognormal", sigma_ln=0.5), 2e-10)
    'lognormal, median 2e-10, sigma_ln 0.5'
    """
    taken = {"lognormal": "median", "normal": "mean", "triangular": "mode"}
    given = scatter.model_dump(exclude_none=True, exclude={"distribution"})
    if (name := taken.get(scatter.distribution)) is not None:
        given = {name: given.pop(name, value), **given}
    shown = ", ".join(f"{name} {number:.6g}" for name, number in given.items())
    return f"{scatter.distribution}, {shown}"
