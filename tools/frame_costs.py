#!/usr/bin/env python3
"""Prints what a frame costs by preset and view distance, and what the horizon costs, as two Markdown tables.

    frame_costs.py PROGRAM [--rounds N] [--size WxH] [--scene NAME] [--quick]

Every round runs all command lines once, in turn, so that a slow minute affects all of them; a figure is the median of the
rounds, a ratio the median of the ratios within rounds, with the minimum and maximum. Run nothing else meanwhile.
--quick: one round of small images, to see that it works."""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

PRESETS = ("minimal", "low", "medium", "high", "ultra", "thesis")
VIEW_DISTANCES = (8, 16, 32)
HORIZONS = (0, 128, 256, 512, 1024, 2048, 4096)
FRAMES = 7


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--size", default="1280x720")
    parser.add_argument("--scene", default="landscape")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    if options.quick:
        options.rounds, options.size = 1, "64x36"
    return options


def render(options, *arguments):
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [options.program.resolve(), "render", "--scene", options.scene, "--size", options.size, "--frames", str(FRAMES),
             "--json", "-o", f"{folder}/image.png", *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{options.program} render {' '.join(map(str, arguments))} failed: {done.stderr.strip()}")
    return json.loads(done.stdout)


def measure(options):
    """Results of all rounds by command line: (preset, view distance, horizon); None: the preset's own horizon."""
    lines = [(preset, distance, None) for distance in VIEW_DISTANCES for preset in PRESETS]
    lines += [("low", 16, horizon) for horizon in HORIZONS]
    results = {line: [] for line in lines}
    for _ in range(options.rounds):
        for preset, distance, horizon in lines:
            more = () if horizon is None else ("--horizon", horizon)
            results[preset, distance, horizon].append(
                render(options, "--preset", preset, "--view-distance", distance, *more))
            print(".", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    return results


def median(runs, value):
    return statistics.median(map(value, runs))


def ratio(runs, base, value):
    """Of pairs of one round: median (minimum to maximum)."""
    ratios = [value(run) / value(other) for run, other in zip(runs, base)]
    return f"{statistics.median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f})"


def frame(run):
    return run["milliseconds"]["frame"]


def row(*cells):
    return f"| {' | '.join(map(str, cells))} |"


def preset_table(results):
    lines = [row("preset", "V", "frame, ms", "opaque triangles, thousands"), "|---|---|---|---|"]
    for preset in PRESETS:
        for distance in VIEW_DISTANCES:
            runs = results[preset, distance, None]
            triangles = median(runs, lambda run: run["triangles"]["opaque"])
            lines.append(row(preset, distance, f"{median(runs, frame):.0f}", f"{triangles / 1000:.0f}"))
    return "\n".join(lines)


def horizon_table(results):
    base = results["low", 16, 0]
    lines = [row("horizon, chunks", "loading, ratio", "frame, ratio", "tiles made", "opaque triangles, thousands",
                 "quads on the GPU, MB", "process at its peak, MB"), "|---" * 7 + "|"]
    for horizon in HORIZONS:
        runs = results["low", 16, horizon]
        lines.append(row(
            horizon or "none", ratio(runs, base, lambda run: run["milliseconds"]["load"]), ratio(runs, base, frame),
            f"{median(runs, lambda run: run['tasks']['tile']['count']):,.0f}",
            f"{median(runs, lambda run: run['triangles']['opaque']) / 1000:.0f}",
            f"{median(runs, lambda run: run['bytes']['quads_gpu']) / 1e6:.1f}",
            f"{median(runs, lambda run: run['bytes']['process_peak']) / 1e6:.0f}"))
    return "\n".join(lines)


def main():
    options = parse()
    results = measure(options)
    print(f"{options.scene}, {options.size}, {options.rounds} rounds\n\n{preset_table(results)}\n\n"
          f"Preset low, V=16:\n\n{horizon_table(results)}")


if __name__ == "__main__":
    main()
