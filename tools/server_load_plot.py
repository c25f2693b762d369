#!/usr/bin/env python3
"""Plots the output of server_load.py. Usage: server_load_plot.py TABLE SVG

Needs matplotlib and pandas (Debian: python3-matplotlib, python3-pandas)."""
import sys

import matplotlib
import matplotlib.pyplot
import pandas

STYLE = {"svg.fonttype": "none", "svg.hashsalt": "terrane", "font.size": 9, "axes.spines.top": False,
         "axes.spines.right": False}
LEFT = (("tick_ms_p99", "a tick of the server"), ("seen_ms_p99", "until another player sees an edit"))
RIGHT = (("received_kb_s", "received"), ("sent_kb_s", "sent"))


def main(table, file):
    rows = pandas.read_csv(table, sep="\t", comment="#")
    matplotlib.use("svg")
    with matplotlib.rc_context(STYLE):
        figure, (left, right) = matplotlib.pyplot.subplots(1, 2, figsize=(9, 3.2), layout="constrained")
        for axes, lines in ((left, LEFT), (right, RIGHT)):
            for column, label in lines:
                axes.plot(rows.bots, rows[column].where(rows[column] > 0), marker="o", label=label)
            axes.set(xlabel="players", xscale="log", xticks=rows.bots, xticklabels=rows.bots)
            axes.minorticks_off()
            axes.set_ylim(bottom=0)
            axes.grid(True, alpha=0.3)
            axes.legend(frameon=False)
        left.set_ylabel("ms, 99th percentile")
        right.set_ylabel("kB/s a player")
        figure.savefig(file, metadata={"Date": None})


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
