"""The reference run of the project, tables of load for prescribed contacts, and the assertion
whose numbers stand in docs/validation.md."""

import copy
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import wearsim
from wearsim.geometry.forms.evolute import Strand, evolute_flank
from wearsim.mechanisms.strand.contact import StrandMechanism

LAWS: dict[float, dict[str, Any]] = {
    1: {"law": "archard", "specific_wear_rate_mm2_per_N": 1e-8},
    1.5: {"law": "power", "coefficient": 3e-10, "pressure_exponent": 1.5},
    2: {"law": "power", "coefficient": 1e-11, "pressure_exponent": 2},
}

REFERENCE: dict[str, Any] = {
    "format_version": 1,
    "chain": {"pitch_mm": 25.4, "roller_diameter_mm": 15.88, "inner_width_mm": 17.02},
    "sprocket": {
        "teeth": 20,
        "profile": "evolute",
        "face_width_mm": 17.0,
        "evolute_offset_mm": 5.5,
        "contact_start_mm": 30.67,
        "contact_end_mm": 4.0,
    },
    "material": {
        body: {"youngs_modulus_MPa": 2.1e5, "poissons_ratio": 0.3} for body in ("sprocket", "roller")
    },
    "load": {"tension_N": 5000, "speed_rpm": 100},
    "stop": {"critical_depth_mm": 0.2},
    "run": {"life_tolerance": 1e-4},
}


@pytest.fixture
def reference_tables() -> dict[str, Any]:
    """Return the tables of the reference run without a wear law."""
    return copy.deepcopy(REFERENCE)


@pytest.fixture
def laws() -> dict[float, dict[str, Any]]:
    """Return the wear law of the reference run for every exponent m."""
    return copy.deepcopy(LAWS)


@pytest.fixture(scope="session")
def reference() -> Callable[..., wearsim.Case]:
    """Return the reference case of an exponent m, with overrides."""

    def case(exponent: float = 1, *overrides: str) -> wearsim.Case:
        return wearsim.load_case({**REFERENCE, "wear": LAWS[exponent]}, overrides)

    return case


@pytest.fixture(scope="session")
def reference_mechanism() -> Callable[..., StrandMechanism]:
    """Return the rollers and the flank of the reference run, without a case around them."""

    def mechanism(
        nodes: int, offset: float = 5.5, contact: tuple[float, float] = (4.0, 30.67)
    ) -> StrandMechanism:
        strand = Strand(25.4 * 20 / (2.0 * np.pi), 7.94, offset)
        return StrandMechanism(
            strand=strand,
            profile=evolute_flank(strand, *contact, nodes).profile,
            contact_end=contact[0],
            contact_start=contact[1],
            pitch=25.4,
            pull_per_width=5000.0 / 17.0,
            angular_speed=2.0 * np.pi * 100.0 / 60.0,
            slip_fraction=1.0,
            modulus=2.1e5 / (2.0 * (1.0 - 0.3**2)),
        )

    return mechanism


@pytest.fixture
def prescribed(tmp_path: Path) -> Callable[..., wearsim.Case]:
    """Return a case whose load and sliding come from columns."""

    def case(
        columns: dict[str, Any],
        wear: dict[str, Any],
        depth: float,
        roller_radius: float,
        overrides: Sequence[str] = (),
    ) -> wearsim.Case:
        file = tmp_path / "run.csv"
        size = np.size(columns["arc_length_mm"])
        table = np.column_stack([np.broadcast_to(values, size) for values in columns.values()])
        rows = [",".join(repr(float(value)) for value in row) for row in table]
        file.write_text("\n".join([",".join(columns), *rows]) + "\n", encoding="utf-8")
        return wearsim.load_case(
            {
                "format_version": 1,
                "chain": {
                    "pitch_mm": 25.4,
                    "roller_diameter_mm": 2.0 * roller_radius,
                    "inner_width_mm": 17.0,
                },
                "mechanism": {"kind": "prescribed", "table_file": str(file)},
                "load": {"speed_rpm": 100},
                "wear": wear,
                "stop": {"critical_depth_mm": depth},
                "run": {"horizon_hours": 1e9},
            },
            overrides,
        )

    return case


@pytest.fixture
def b9(prescribed: Callable[..., wearsim.Case]) -> Callable[..., wearsim.Case]:
    """Return benchmark B9 on so many points, with overrides.

    Flank radius 39.1 mm, length 6 mm, roller 6.035 mm, q = 100 (0.2 + 0.8 cos(pi u/2)),
    s = 0.05 + 0.4 u mm, k = 1e-10 mm2/N, depth 0.5 mm.
    """

    def case(points: int, *overrides: str) -> wearsim.Case:
        u = np.linspace(0.0, 1.0, points)
        return prescribed(
            {
                "arc_length_mm": 6.0 * u,
                "load_per_width_N_per_mm": 100.0 * (0.2 + 0.8 * np.cos(0.5 * np.pi * u)),
                "flank_curvature_per_mm": 1.0 / 39.1,
                "sliding_distance_mm": 0.05 + 0.4 * u,
            },
            {"law": "archard", "specific_wear_rate_mm2_per_N": 1e-10},
            0.5,
            6.035,
            overrides,
        )

    return case


def agreement(
    what: tuple[str, str, str], value: Any, expected: Any, tolerance: float, absolute: bool
) -> dict[str, Any]:
    """Assert that all values agree; return the row of the one that is furthest off.

    Where all differences are rounding it is the largest value, which is the same everywhere.
    """
    quantity, source, unit = what
    found, wanted = (array.astype(float).ravel() for array in np.broadcast_arrays(value, expected))
    size = np.abs(wanted)
    off, allowed = np.abs(found - wanted), np.full(size.shape, tolerance)
    allowed *= 1.0 if absolute else size
    for at in np.flatnonzero(~(off <= allowed))[:1]:
        pytest.fail(
            f"{quantity}: is {found[at]:.12g} {unit}, expected {wanted[at]:.12g} ({source}), "
            f"off by {off[at]:.3g}, tolerance {tolerance:.3g} {unit if absolute else 'relative'}"
        )
    relative = off / np.where(size > 0.0, size, size.max() or 1.0)
    at = int(relative.argmax() if relative.max() > 1e-9 else size.argmax())
    texts = {"quantity": quantity, "source": source, "unit": unit, "count": found.size}
    numbers = {"value": found[at], "expected": wanted[at], "allowed": allowed[at]}
    return texts | {name: float(number) for name, number in numbers.items()}


@pytest.fixture
def validated(request: pytest.FixtureRequest) -> Callable[..., None]:
    """Return the assertion that a number agrees with one from outside, a row of the page.

    The tolerance is relative, or in the unit of the value where ``absolute``. Of arrays the
    value that is furthest off makes the row; ``page=False`` asserts without one.
    """

    def check(
        quantity: str,
        value: Any,
        expected: Any,
        tolerance: float,
        source: str,
        unit: str = "",
        *,
        absolute: bool = False,
        page: bool = True,
    ) -> None:
        row = agreement((quantity, source, unit), value, expected, tolerance, absolute)
        if page and request.config.getoption("validation_page"):
            request.node.user_properties.append(("validated", row))

    return check
