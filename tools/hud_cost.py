#!/usr/bin/env python3
"""Measures the cost of the hotbar, the compass, the arm and the position overlay: shows and hides them in turn in a window
on a virtual display, and compares frame times. Usage: hud_cost.py PROGRAM [ROUNDS]

Prints the median frame of all rounds with and without them, in milliseconds. Needs Xvfb and xdotool."""
import csv
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import child_processes
import virtual_display

SIZE = (1280, 720)
SECONDS = 4       # of each turn
SETTLE = 0.7      # ignored after a key
COMPLETE = 30     # until the view is complete


def main():
    program, rounds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 10
    with tempfile.TemporaryDirectory() as folder, virtual_display.Display(SIZE) as display:
        environment = {**os.environ, "DISPLAY": display.name, "XDG_CONFIG_HOME": folder, "XDG_DATA_HOME": folder}
        process = child_processes.start(
            [os.path.abspath(program), "play", "--no-save", "--seed", "1", "--preset", "low", "--view-distance", "8", "--horizon",
             "0", "--size", f"{SIZE[0]}x{SIZE[1]}", "--collect-perf-data", "perf.csv", "--sound-volume", "0"],
            cwd=folder, env=environment, stderr=subprocess.DEVNULL)
        while not (window := display.xdotool("search", "--onlyvisible", "--name", "^Terrane$")):
            if process.poll() is not None:
                sys.exit(f"hud_cost: the program ended with {process.returncode}")
            time.sleep(0.2)
        display.xdotool("windowmove", window, 0, 0, "windowfocus", window)
        start = time.monotonic()
        time.sleep(COMPLETE)
        display.xdotool("key", "F7")  # position overlay
        turns, shown = [], True
        for _ in range(2 * rounds):
            begin = time.monotonic() - start
            time.sleep(SECONDS)
            turns.append((begin + SETTLE, time.monotonic() - start - SETTLE, shown))
            display.xdotool("key", "F8")
            shown = not shown
        process.terminate()
        process.wait(60)
        rows = list(csv.DictReader(pathlib.Path(folder, "perf.csv").read_text(encoding="ascii").splitlines()))
    frames = {True: [], False: []}
    for row in rows:
        at = float(row["time_s"])
        for begin, end, is_shown in turns:
            if begin < at < end:
                frames[is_shown].append(float(row["frame_ms"]))
    with_hud, without = statistics.median(frames[True]), statistics.median(frames[False])
    print(f"with {with_hud:.2f} ms ({len(frames[True])} frames), without {without:.2f} ms ({len(frames[False])}): "
          f"{with_hud - without:+.2f} ms")


if __name__ == "__main__":
    main()
