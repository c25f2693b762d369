#!/usr/bin/python3
"""Plots the flights of tools/flight_trace.sh. Usage: flight_plot.py FOLDER   (writes FOLDER/flight.svg)

For four flights (generating and from a save, at view distances 16 and 32): the time of each frame and its part for
loading, next to frames from the same places with everything loaded.
"""

import pathlib
import sys

try:
    import matplotlib
    import matplotlib.pyplot
    import pandas
except ModuleNotFoundError as missing:
    sys.exit(f"flight_plot: {missing}; needed are the Debian packages python3-pandas and python3-matplotlib")

FLIGHTS = ("generating_16", "from_disk_16", "generating_32", "from_disk_32")
SECONDS = 20  # that are shown
STYLE = {"svg.fonttype": "none", "svg.hashsalt": "terrane", "font.size": 9, "axes.spines.top": False,
         "axes.spines.right": False}


def draw(axes, folder, name):
    kind, _, distance = name.rpartition("_")
    flight = pandas.read_csv(folder / f"{name}.csv")
    standing = pandas.read_csv(folder / f"standing_{distance}.csv", names=["seconds", "milliseconds"])
    axes.vlines(flight.time_s, 0, flight.frame_ms, color="#9db8d2", label="frame")
    axes.vlines(flight.time_s, 0, flight.follow_cpu_ms + flight.upload_cpu_ms, color="#c0392b",
                label="of it loading (CPU time)")
    axes.plot(standing.seconds, standing.milliseconds, color="#2e7d32", linewidth=2,
              label="the same place, nothing to load")
    axes.axhline(2 * flight.frame_ms.median(), color="#555555", linestyle="--", label="twice the median")
    title = "generating" if kind == "generating" else "from a save"
    # Higher than all frames, with room for the legend.
    axes.set(title=f"{title}, view distance {distance}", xlabel="s", ylabel="ms", xlim=(0, SECONDS),
             ylim=(0, 1.6 * flight.frame_ms.max()))
    axes.legend(loc="upper left", frameon=False)


def main(folder):
    matplotlib.use("svg")
    with matplotlib.rc_context(STYLE):
        figure, grid = matplotlib.pyplot.subplots(2, 2, figsize=(10, 7.6), layout="constrained")
        for axes, name in zip(grid.flat, FLIGHTS):
            draw(axes, folder, name)
        figure.savefig(folder / "flight.svg", metadata={"Date": None})


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    try:
        main(pathlib.Path(sys.argv[1]))
    except (OSError, ValueError) as error:
        sys.exit(f"flight_plot: {sys.argv[1]}: {error}")
    except AttributeError as error:  # a column
        sys.exit(f"flight_plot: {sys.argv[1]}: no flight: {error}")
