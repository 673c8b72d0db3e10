"""The work-precision diagram: a panel for every case and number of nodes."""

import matplotlib as mpl
from matplotlib.figure import Figure

STYLES = {
    "ROS34PW2": ("tab:blue", "o", "-"),
    "ROS34PW2, PI": ("tab:cyan", ".", "--"),
    "ROS2": ("tab:orange", "s", "-"),
    "implicit Euler": ("tab:green", "^", "-"),
    "RKC2": ("tab:purple", "v", "-"),
    "LSODA": ("tab:red", "D", "-"),
}
ERRORS, TIMES = (1e-8, 1e-2), (0.2, 1e3)


def work_precision_figure(points):
    """Draw ``points``: error and milliseconds by case, nodes and method; a line marks 1e-4."""
    figure = Figure(figsize=(13.0, 9.0), layout="constrained")
    first = next(iter(points.values()))
    panels = figure.subplots(len(points), len(first), sharex=True, sharey=True)
    for row, (case, by_nodes) in zip(panels, points.items(), strict=True):
        for panel, (nodes, methods) in zip(row, by_nodes.items(), strict=True):
            for method, (errors, times) in methods.items():
                colour, marker, line = STYLES[method]
                panel.loglog(
                    errors,
                    times,
                    color=colour,
                    marker=marker,
                    linestyle=line,
                    markersize=4.0,
                    linewidth=1.0,
                    label=method,
                )
            panel.axvline(1e-4, color="0.6", linewidth=0.8)
            panel.grid(True, color="0.9", linewidth=0.6)
            panel.set_title(f"{case}, K = {nodes}", fontsize=10)
        row[0].set_ylabel("time of one solve, ms")
    for panel in panels[-1]:
        panel.set_xlabel("life error, relative")
    panels[0][0].set(xlim=ERRORS, ylim=TIMES)
    handles, labels = panels[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(STYLES), frameon=False)
    return figure


def write_figure(points, path):
    """Write the diagram in the format of the path's suffix, the same bytes for the same points."""
    with mpl.rc_context({"svg.hashsalt": "wearsim", "svg.fonttype": "none"}):
        options = {"metadata": {"Date": None}} if path.suffix == ".svg" else {"dpi": 110}
        work_precision_figure(points).savefig(path, **options)
