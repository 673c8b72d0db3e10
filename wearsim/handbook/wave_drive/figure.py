"""The picture of a wave drive's diameter: a bar for the range of each method."""

from collections.abc import Sequence

from matplotlib.figure import Figure

from wearsim.handbook.wave_drive.model import MethodDiameter


def wave_drive_figure(title: str, found: Sequence[MethodDiameter]) -> Figure:
    """Return a bar for the range of each method with its diameter."""
    figure = Figure(figsize=(7.2, 0.9 + 0.42 * len(found)), layout="constrained")
    panel = figure.subplots()
    for place, one in enumerate(found):
        panel.plot(
            [one.least, one.greatest],
            [place, place],
            color="tab:blue",
            alpha=0.35,
            linewidth=9,
            solid_capstyle="butt",
            label="over the recommended values" if place == 0 else None,
        )
        panel.plot(
            one.diameter, place, "o", color="tab:blue", label="with the values given" if place == 0 else None
        )
        panel.annotate(
            f"{one.diameter:.0f}",
            (one.diameter, place),
            (0, 7),
            textcoords="offset points",
            ha="center",
            fontsize=7,
        )
    known = [(one.published, place) for place, one in enumerate(found) if one.published > 0.0]
    if known:
        panel.plot(*zip(*known, strict=True), "x", color="tab:red", markersize=8, label="published")
    panel.set_yticks(range(len(found)), [f"{one.method.name} {one.method.source}" for one in found])
    panel.set_ylim(len(found) - 0.4, -0.9)
    panel.set_xlabel("diameter of the flexspline, mm")
    panel.set_title(title, fontsize=9, loc="left")
    panel.grid(axis="x", alpha=0.3)
    panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=8)
    return figure
