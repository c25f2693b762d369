#!/usr/bin/env python3
"""Plots the memory of a soak, and the times of its events. Usage: soak_plot.py FOLDER SVG (FOLDER of soak.py)

Needs matplotlib (Debian: python3-matplotlib)."""
import json
import pathlib
import sys

import matplotlib
import matplotlib.pyplot

STYLE = {"svg.fonttype": "none", "svg.hashsalt": "terrane", "font.size": 9, "axes.spines.top": False,
         "axes.spines.right": False}
MARKS = {"server killed": "tab:red", "window killed": "tab:purple", "database stopped": "tab:blue", "database killed": "navy"}


def lines_of(file):
    return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()]


def thinned(samples, most=600):
    return samples[::max(1, len(samples) // most)]


def draw(folder, axes):
    samples = thinned(lines_of(folder / "samples.jsonl"))
    names = sorted({name for sample in samples for name in sample["memory_mb"]})
    for name in names:
        points = [(sample["seconds"] / 60, sample["memory_mb"][name]) for sample in samples if name in sample["memory_mb"]]
        axes.plot(*zip(*points), label=name, linewidth=1)
    for event in lines_of(folder / "events.jsonl"):
        axes.plot(event["seconds"] / 60, 0, marker="|", color=MARKS[event["event"]], markersize=8, clip_on=False)
    axes.set(xlabel="minutes", ylabel="memory, MB (PSS)")
    axes.set_ylim(bottom=0)
    axes.grid(True, alpha=0.3)
    marks = [matplotlib.lines.Line2D([], [], marker="|", color=color, linestyle="", label=what) for what, color in MARKS.items()]
    axes.legend(handles=axes.get_legend_handles_labels()[0] + marks, frameon=False, loc="upper left", bbox_to_anchor=(1, 1))


def main(folder, file):
    matplotlib.use("svg")
    with matplotlib.rc_context(STYLE):
        figure, axes = matplotlib.pyplot.subplots(figsize=(9, 3.6), layout="constrained")
        draw(pathlib.Path(folder), axes)
        figure.savefig(file, metadata={"Date": None})


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
