"""``wearsim handbook``: calculations of gears, each with an input file of its own."""

import copy
from typing import Any

import click

from wearsim.command.example_group import ExampleGroup
from wearsim.command.options import common_options, warn
from wearsim.handbook.convex_concave.command import convex_concave
from wearsim.handbook.face_load.command import face_load
from wearsim.handbook.hertz_check.command import hertz_check
from wearsim.handbook.stiffness_spectrum.command import stiffness_spectrum
from wearsim.handbook.strength.command import strength
from wearsim.handbook.synthesise.command import synthesise
from wearsim.handbook.wave_drive.command import wave_drive

HANDBOOK: dict[click.Command, str] = {
    strength: "wearsim handbook strength strength-a-tempered",
    stiffness_spectrum: "wearsim handbook stiffness-spectrum stiffness-spectrum-20-30",
    face_load: "wearsim handbook face-load face-load-mill-drive",
    hertz_check: "wearsim handbook hertz-check hertz-check-36-54",
    synthesise: "wearsim handbook synthesise synthesise-two-segments",
    convex_concave: "wearsim handbook convex-concave convex-concave-17-34",
    wave_drive: "wearsim handbook wave-drive wave-drive-100",
}
"""Calculations of the handbook, each with an example."""

_GONE = "0.4.0"
"""The version that is without the names of before."""


@click.group(
    cls=ExampleGroup, groups={"Commands": HANDBOOK}, short_help="Calculate gears by handbook methods."
)
@common_options
def handbook() -> None:
    """Calculate gears by handbook methods: strength, contact stress, face load, pitch errors, profiles.

    Each calculation has an input file of its own; wearsim schema --of NAME describes its keys.
    """


def commands_of_before() -> list[click.Command]:
    """Return the calculations under the names that they had before there was a handbook."""
    return [_of_before(command) for command in HANDBOOK]


def _of_before(command: click.Command) -> click.Command:
    """Return a hidden command that does the same and names its new place."""
    old = copy.copy(command)
    run = command.callback
    assert run is not None

    def renamed(**values: Any) -> Any:
        warn(
            f"warning: wearsim {command.name} is now wearsim handbook {command.name}; "
            f"the old name works until wearsim {_GONE}"
        )
        return run(**values)

    old.hidden, old.callback = True, renamed
    return old
