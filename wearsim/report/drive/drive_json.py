"""What is found of a whole drive, as JSON."""

from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.drive.drive_result import DriveLife
from wearsim.drive.maintenance import drive_plan, planned_events
from wearsim.report.drive.drive_words import banded_part
from wearsim.report.drive.layout import layout_json
from wearsim.result import life_keys
from wearsim.result.ends import ends_json, first_end_keys
from wearsim.result.events import events_json
from wearsim.result.lives import service_keys
from wearsim.result.second_opinions import opinions_json


def drive_json(found: DriveLife) -> dict[str, Any]:
    """Return what ``wearsim life --json`` prints of a whole drive."""
    drive, (low, high) = found.drive, found.band(banded_part(found))
    return {
        **ANSWER_HEAD,
        "case": drive.name,
        "title": drive.title,
        **life_keys("life_hours", found.life),
        **life_keys("life_hours_low", low),
        **life_keys("life_hours_high", high),
        "first": found.first_worn or None,
        **first_end_keys(found.ends),
        **life_keys("chain_life_hours", found.chain),
        **service_keys(drive.driver.case.inputs, found.life),
        "overloaded": bool(found.overloaded),
        "ends": ends_json(found.ends),
        "events": events_json(planned_events(drive_plan(found))),
        **({} if found.practice is None else {"practice": opinions_json(found.practice)}),
        "sprockets": [_sprocket_json(found, one.name) for one in drive.sprockets],
        "layout": layout_json(drive),
        "warnings": list(found.warnings),
    }


def _sprocket_json(found: DriveLife, name: str) -> dict[str, Any]:
    if name in found.failed:
        return {"name": name, "error": str(found.failed[name])}
    return {"name": name, **found.results[name].summary(), "chains": found.chains_with(name)}
