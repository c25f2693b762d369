#!/usr/bin/env python3
"""Plots what bench_land prints: heights beside Earth's, Flint's law, Hack's law. Usage: land_plots.py TABLE FILE

TABLE is the output of bench_land, FILE an SVG or PNG. Needs matplotlib (Debian: python3-matplotlib)."""
import pathlib
import re
import sys

import matplotlib
import matplotlib.pyplot

STYLE = {"svg.fonttype": "none", "svg.hashsalt": "terrane", "font.size": 9, "axes.spines.top": False,
         "axes.spines.right": False}
KILOMETERS = "km² upstream"


def rows_after(lines, title):
    """The rows of numbers after the line that begins with the title."""
    first = next(k for k, line in enumerate(lines) if line.startswith(title)) + 1
    rows = []
    for line in lines[first:]:
        if not re.fullmatch(r"[-\d. ]+", line):
            break
        rows.append([float(word) for word in line.split()])
    return rows


def law_of(lines, name):
    """Factor and exponent of a law's line."""
    line = next(line for line in lines if line.startswith(name))
    factor, exponent = re.search(r"= ([\d.]+) A\^(-?[\d.]+)", line).groups()
    return float(factor), float(exponent)


def draw_heights(axes, rows):
    """The share of the area above each height."""
    heights = [row[0] for row in rows]
    for column, label in ((1, "here"), (2, "Earth")):
        above = [sum(row[column] for row in rows[k:]) for k in range(len(rows))]
        axes.plot(above, heights, label=label)
    axes.axhline(0, color="tab:blue", linewidth=0.5)
    axes.set(xlabel="% of the area above", ylabel="blocks above the sea", title="Heights", xlim=(0, 100))


def draw_law(axes, rows, column, law, labels):
    """The means of streams, and the line fitted to those of rivers."""
    areas = [row[0] for row in rows]
    factor, exponent = law
    axes.plot(areas, [row[column] for row in rows], marker="o", linestyle="", markersize=4, label="means of streams")
    axes.plot(areas, [factor * area ** exponent for area in areas], linewidth=1, label=f"fit to rivers: $A^{{{exponent:.2f}}}$")
    axes.set(xscale="log", yscale="log", xlabel=KILOMETERS, ylabel=labels[1], title=labels[0])


def main(table, file):
    lines = pathlib.Path(table).read_text(encoding="utf-8").splitlines()
    streams = rows_after(lines, "streams by area")
    matplotlib.use("agg" if file.endswith(".png") else "svg")
    with matplotlib.rc_context(STYLE):
        figure, axes = matplotlib.pyplot.subplots(1, 3, figsize=(11, 3.4), layout="constrained")
        draw_heights(axes[0], rows_after(lines, "hypsometry"))
        draw_law(axes[1], streams, 1, law_of(lines, "Flint's law:"), ("Flint's law", "slope, blocks a block"))
        draw_law(axes[2], streams, 2, law_of(lines, "Hack's law:"), ("Hack's law", "longest way upstream, km"))
        for each in axes:
            each.grid(True, alpha=0.3)
            each.legend(frameon=False)
        figure.savefig(file, metadata={} if file.endswith(".png") else {"Date": None}, dpi=110)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
