"""The directive ``{shared-readings}``: a row for every file of docs/shared_readings, as wearsim reads it."""

from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment

from wearsim.quantities import grouped
from wearsim.readings.shared_reading import ConditionsTable, SharedReading, read_reading

FOLDER = Path(__file__).parents[1] / "shared_readings"

HEAD = ("file", "origin", "chain, teeth", "load", "wear condition", "hours", "depth, mm", "shared by")

_LOADS = {"power_kW": "kW", "torque_N_m": "N m", "tension_N": "N", "speed_rpm": "rpm"}


def _load(found: ConditionsTable) -> str:
    values = [(getattr(found, key), unit) for key, unit in _LOADS.items()]
    return ", ".join(f"{value:g} {unit}" for value, unit in values if value is not None) or "-"


def cells(name: str, found: SharedReading) -> list[str]:
    """Return a reading as a row of the table."""
    read, under = found.reading, found.conditions
    surroundings = [text for text in (under.condition, under.lubricant, under.environment) if text]
    return [
        f"`{name}`",
        f"**{read.origin}**" if read.origin == "rendered" else read.origin,
        f"{under.designation or f'{under.pitch_mm:g} mm pitch'}, {under.teeth}",
        _load(under),
        "; ".join(surroundings) or "-",
        grouped(read.time_hours),
        f"{read.depth_mm:.3f} +- {read.depth_se_mm:.3f}",
        f"{read.contributor}, {read.date}",
    ]


def table() -> list[str]:
    """Return all readings as the lines of a table of Markdown."""
    rows = [cells(path.name, read_reading(path)) for path in sorted(FOLDER.glob("*.toml"))]
    return [f"| {' | '.join(row)} |" for row in (HEAD, ("---",) * len(HEAD), *rows)]


class SharedReadings(Directive):
    """The table of all shared readings."""

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        env: BuildEnvironment = self.state.document.settings.env
        for path in FOLDER.glob("*.toml"):
            env.note_dependency(str(path))
        found = nodes.container()
        self.state.nested_parse(StringList(table()), self.content_offset, found)
        return [found]


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the directive."""
    app.add_directive("shared-readings", SharedReadings)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
