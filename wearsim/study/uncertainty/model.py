"""How sure a life is: samples of a case of which some keys scatter."""

from collections.abc import Sequence
from dataclasses import dataclass

from wearsim.input.document import CaseSource
from wearsim.runner.design import Design
from wearsim.runner.samples import Method, unit_samples
from wearsim.runner.scatter import ScatteredCase, load_scattered


@dataclass(frozen=True)
class UncertaintyStudy:
    """The samples of a case."""

    scattered: ScatteredCase  # the case and what of it scatters
    method: Method  # `sobol`, `lhs` or `random`
    seed: int  # of the samples
    design: Design  # the cases of the samples


def load_uncertainty(
    source: CaseSource,
    overrides: Sequence[str],
    samples: int,
    seed: int,
    method: Method,
    least_horizon: float | None = None,
) -> UncertaintyStudy:
    """Return the samples of a case."""
    scattered = load_scattered(source, overrides, least_horizon)
    shares = unit_samples(len(scattered.scatters), samples, seed, method)
    return UncertaintyStudy(scattered, method, seed, scattered.design(shares))
