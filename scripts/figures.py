#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""catena report RESULT --json | catena-figures FOLDER [--format FORMAT]

Draws every figure of a report into FOLDER by matplotlib, for papers: <figure>.svg, or what FORMAT says
(pdf, png, eps ...). In the sources this is scripts/figures.py, which the other scripts draw with, too.
"""
import argparse
import json
import pathlib
import sys

try:
    import matplotlib
    import numpy as np
except ImportError as missing:
    sys.exit(f"{sys.argv[0]}: {missing}; Debian has it in python3-matplotlib")

matplotlib.use("agg")
matplotlib.rcParams.update({
    "svg.hashsalt": "catena", "svg.fonttype": "none", "figure.constrained_layout.use": True,
    "axes.grid": True, "grid.alpha": 0.3, "lines.linewidth": 1.3, "font.size": 10,
    "axes.spines.top": False, "axes.spines.right": False,
})  # fmt: skip
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of what draws)

# Ink, then the colours of Okabe and Ito that the page has, each with its dash and marker.
COLOURS = ["#1a1a1a", "#0072b2", "#c44e00", "#007a5a", "#a8508a", "#9a6a00", "#2f96d0"]
BLUE, RED = COLOURS[1:3]
DASHES = ["-", "-", (0, (7, 3)), (0, (2, 2.5)), (0, (9, 3, 2, 3)), (0, (12, 4)), (0, (5, 2, 1, 2, 1, 2))]
MARKERS = ["o", "+", "x", "s", "^", "D", "v"]


def save(figure, path):
    """The same figure gives the same bytes."""
    figure.savefig(path, metadata={"Date": None} if str(path).endswith("svg") else None)
    plt.close(figure)


def axis_title(axis):
    return " / ".join(part for part in (axis["label"], axis["unit"]) if part not in ("", "1"))


def column(columns, index):
    return np.array([np.nan if value is None else value for value in columns[index]])


def set_axis(of, which, axis):
    of.set(**{f"{which}label": axis_title(axis), f"{which}scale": "log" if axis["logarithmic"] else "linear"})
    ticks = axis.get("ticks") or [{"at": k + 1, "label": name} for k, name in enumerate(axis.get("categories", []))]
    if ticks:
        of.set(**{f"{which}ticks": [tick["at"] for tick in ticks],
                  f"{which}ticklabels": [tick["label"] for tick in ticks]})  # fmt: skip


def draw(figure, columns):
    """A matplotlib figure of one entry of "figures" in what `catena report --json` prints."""
    drawn, axis = plt.subplots(figsize=(10, 4) if figure["wide"] else (6.4, 4))
    axis.set_title(figure["title"])
    named = set()
    for series in figure["series"]:
        k = 0 if series["colour"] <= 0 else 1 + (series["colour"] - 1) % 6
        mark = series["mark"]
        if mark == "bars":
            axis.barh(column(columns, series["y"]), column(columns, series["x"]), height=0.3, edgecolor=COLOURS[k],
                      color=(COLOURS[k], 0.8 if k % 2 else 0.25), label=series["name"])  # fmt: skip
            named.add(series["name"])
            continue
        axis.plot(column(columns, series["x"]), column(columns, series["y"]), color=COLOURS[k],
                  linestyle="" if mark == "points" else DASHES[k],
                  marker="" if mark == "line" else MARKERS[k], markersize=4, fillstyle="none",
                  label=None if series["name"] in named else series["name"])  # fmt: skip
        named.add(series["name"])
    if "map" in figure:
        grid = figure["map"]
        values = np.array([column(columns, row) for row in grid["value"]])
        most = grid["maximum"]
        axis.grid(False)
        mesh = axis.pcolormesh(column(columns, grid["x"]), np.arange(1, len(values) + 1), values,
                               cmap="cividis" if grid["signed"] else "YlGnBu",
                               vmin=-most if grid["signed"] else 0, vmax=most, shading="nearest",
                               rasterized=True)  # fmt: skip
        drawn.colorbar(mesh, label=axis_title(grid["scale"]))
        axis.set(yticks=range(1, len(values) + 1), yticklabels=grid["rows"])
        axis.invert_yaxis()
    else:
        set_axis(axis, "y", figure["y"])
    set_axis(axis, "x", figure["x"])
    if figure["equalAspect"]:
        axis.set_aspect("equal")
    if figure["yDownwards"]:
        axis.invert_yaxis()
    for rule in figure["rules"]:
        (axis.axvline if rule["vertical"] else axis.axhline)(rule["at"], color=COLOURS[0], linestyle="--", linewidth=0.8)
        at = {"xy": (rule["at"], 1), "xycoords": axis.get_xaxis_transform()} if rule["vertical"] else {
            "xy": (1, rule["at"]), "xycoords": axis.get_yaxis_transform(), "ha": "right"}  # fmt: skip
        axis.annotate(rule["label"], xytext=(3, -10) if rule["vertical"] else (-3, 3),
                      textcoords="offset points", fontsize=8, **at)  # fmt: skip
    if any(named):
        axis.legend(fontsize=8)
    return drawn


def main():
    said = argparse.ArgumentParser(prog="catena-figures", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    said.add_argument("folder", type=pathlib.Path)
    said.add_argument("--format", default="svg", choices=sorted(plt.figure().canvas.get_supported_filetypes()))
    values = said.parse_args()
    try:
        report = json.load(sys.stdin)
        figures, columns = report["figures"], report["columns"]
    except (ValueError, TypeError, KeyError):
        said.error("standard input is not what `catena report RESULT --json` prints")
    try:
        values.folder.mkdir(parents=True, exist_ok=True)
        for figure in figures:
            save(draw(figure, columns), values.folder / f"{figure['id']}.{values.format}")
    except OSError as error:
        said.error(str(error))
    print(f"{values.folder}: {len(figures)} figures")


if __name__ == "__main__":
    main()
