"""Tooth and link counts near those of a drive: who meets whom, and the same drive with them."""

import copy
from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import product
from pathlib import PurePath
from typing import Any

from wearsim.case.model import Case
from wearsim.chain.drive_layout import ToothMeetings
from wearsim.drive.load_case import load_single
from wearsim.geometry.forms import TOOTH_FORMS
from wearsim.input.named_files import FILE_KEYS
from wearsim.mechanisms.wrap.drive import WrapDrive
from wearsim.result import Life, LowerBound


@dataclass(frozen=True)
class ToothCount:
    """Numbers of teeth and links, and the lives that go with them."""

    meetings: ToothMeetings  # who meets whom with these numbers
    run: bool  # whether their lives are to be calculated
    # of `chain` and `sprocket`; empty where they were not calculated
    lives: Mapping[str, Life | LowerBound] = field(default_factory=dict)


def meetings_around(case: Case, drive: WrapDrive) -> tuple[ToothCount, ...]:
    """Return the counts next to those of a drive: one tooth, two links more and less."""
    if case.engaged_every > 1:
        return ()
    drawn = not TOOTH_FORMS[case.inputs["sprocket"]["profile"]].standard_gap
    teeth, links = drive.gaps, drive.layout.links
    return tuple(
        ToothCount(ToothMeetings(teeth + more, links + longer), run=more >= 0 and longer >= 0)
        for more, longer in product((0,) if drawn else (-1, 0, 1), (-2, 0, 2))
        if teeth + more >= 5 and links + longer >= 10
    )


def variant(case: Case, meetings: ToothMeetings) -> Case:
    """Return a case with other numbers of teeth and links, all else as it is.

    Load, limits and the other sprocket stay; the tip diameter follows the teeth where it is
    the standard's, the centre distance follows the links.
    """
    inputs: dict[str, Any] = copy.deepcopy(dict(case.inputs))
    sprocket, drive = inputs["sprocket"], inputs.setdefault("drive", {})
    if meetings.teeth != sprocket["teeth"]:
        sprocket["teeth"] = meetings.teeth
        if any(text.startswith("sprocket.tip_diameter_mm = ") for text in case.assumptions):
            del sprocket["tip_diameter_mm"]
    drive["links"] = meetings.links
    drive.pop("centre_distance_mm", None)
    for table, key in FILE_KEYS:
        if key in inputs.get(table, {}):
            name = PurePath(inputs[table][key]).name
            (path,) = (path for path in case.files if path.name == name)
            inputs[table][key] = str(path.resolve())
    return load_single(inputs)
