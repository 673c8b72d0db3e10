"""What is shown of fits that another library has repeated: text and JSON."""

from typing import Any

from wearsim.command.study_files import plain
from wearsim.quantities import grouped
from wearsim.study.uncertainty.cross_check import Bounded, CrossCheck, CrossFit


def cross_check_lines(crossed: CrossCheck) -> list[str]:
    """Return the repeated fits with the bounds of their parameters, as text."""
    if not crossed.fits:
        return [f"cross-check  by {crossed.library}: no fit"]
    head = f"cross-check  by {crossed.library}, parameters with their 95 % bounds"
    return [head, *(f"  {fit.name:<10} {_parameters(fit)}" for fit in crossed.fits)]


def _parameters(fit: CrossFit) -> str:
    shape = f"{fit.shape.value:.3f} ({fit.shape.low:.3f} to {fit.shape.high:.3f})"
    scale = f"{grouped(fit.scale.value)} h ({grouped(fit.scale.low)} to {grouped(fit.scale.high)})"
    if fit.name == "lognormal":
        return f"median {scale}, sigma_ln {shape}"
    return f"shape {shape}, scale {scale}"


def cross_check_json(crossed: CrossCheck) -> dict[str, Any]:
    """Return the repeated fits as plain values."""
    return {
        "library": crossed.library,
        "fits": [
            {"name": fit.name} | _bounded("shape", fit.shape) | _bounded("scale_hours", fit.scale)
            for fit in crossed.fits
        ],
    }


def _bounded(name: str, found: Bounded) -> dict[str, float | None]:
    return {name: plain(found.value), f"{name}_low": plain(found.low), f"{name}_high": plain(found.high)}
