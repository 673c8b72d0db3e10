"""``wearsim handbook hertz-check``: contact stress at the pitch point against a published comparison."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from wearsim.command.calculation_command import calculation
from wearsim.command.options import outside_option, working

if TYPE_CHECKING:
    from wearsim.handbook.hertz_check.hertz_fem import FemContact
    from wearsim.handbook.hertz_check.pitch_point_contact import PitchPointContact
    from wearsim.report.calculation_sheet import CalculationSheet


@calculation(
    "hertz-check",
    "Compare the contact stress of gears with finite elements.",
    click.option(
        "--fem", is_flag=True, help="Also solve the contact by finite elements (pip install 'wearsim[fem]')."
    ),
    outside_option,
)
def hertz_check(case: Path, settings: tuple[str, ...], fem: bool) -> "CalculationSheet":
    """Compute the contact stress and the von Mises stresses of the teeth of CASE at the pitch point.

    Compares them with published stresses: which inputs give those, which value each single input
    would need, and what the publication leaves out.
    """
    from wearsim.handbook.hertz_check.published import load_hertz_check
    from wearsim.handbook.hertz_check.sheet import hertz_check_sheet

    tables, axis = load_hertz_check(case, settings)
    found = tables.check()
    elements = tables.finite_elements.elements_per_half_width
    meshes = _solved(found.contact, elements) if fem else []
    return hertz_check_sheet(tables.title, found, meshes, axis)


def _solved(contact: "PitchPointContact", elements: tuple[int, ...]) -> "list[FemContact]":
    from wearsim.handbook.hertz_check.hertz_fem import hertz_fem

    meshes = []
    with working("finite elements") as report_progress:
        for place, number in enumerate(elements):
            meshes.append(hertz_fem(contact, number))
            report_progress(sum(n * n for n in elements[: place + 1]) / sum(n * n for n in elements))
    return meshes
