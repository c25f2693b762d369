#!/usr/bin/env python3
"""Prints the cost of each pass of a frame with each preset, as a Markdown table.

    pass_costs.py PROGRAM [--runs N] [--frames N] [--size WxH] [--view-distance N] [--scene NAME]

Runs PROGRAM render --json for every preset, N times in turn, so that a slow minute affects all of them. A number is the
median over runs of the median over frames, in milliseconds of the GPU. The last row is the sum of a preset's passes
relative to low: `relativeCost` of terrane/render/frame/render_options.cpp."""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile

PRESETS = ("minimal", "low", "medium", "high", "ultra", "thesis")
# As `terrane render --json` names them.
PASSES = ("cull", "shadow map", "surfaces", "depth pyramid", "cull again", "surfaces again", "fill holes", "sky",
          "ambient occlusion", "shade", "peel", "shade layers", "god rays", "depth of field", "final")


def measure(options, preset, image):
    """Milliseconds by pass, and of a frame of wall time."""
    done = subprocess.run(
        [options.program, "render", "--scene", options.scene, "--size", options.size, "--preset", preset,
         "--view-distance", str(options.view_distance), "--frames", str(options.frames), "--json", "-o", image],
        capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{options.program} render --preset {preset} failed: {done.stderr.strip()}")
    result = json.loads(done.stdout)
    return result["passes"], result["milliseconds"]["frame"]


def median_runs(options):
    """Medians of the runs by preset: milliseconds by pass, and of a frame."""
    runs = {preset: [] for preset in PRESETS}
    with tempfile.TemporaryDirectory() as folder:
        image = os.path.join(folder, "image.png")
        for _ in range(options.runs):
            for preset in PRESETS:
                runs[preset].append(measure(options, preset, image))
    medians = {}
    for preset, measured in runs.items():
        names = {name for passes, _ in measured for name in passes}
        passes = {name: statistics.median(passes.get(name, 0) for passes, _ in measured) for name in names}
        medians[preset] = passes, statistics.median(frame for _, frame in measured)
    return medians


def cell(milliseconds):
    """Empty if a pass does nothing."""
    if milliseconds < 0.05:
        return ""
    return f"{milliseconds:.1f}" if milliseconds < 10 else f"{milliseconds:.0f}"


def row(name, cells):
    return f"| {' | '.join([name, *cells])} |"


def table(medians):
    known = {name for passes, _ in medians.values() for name in passes}
    names = [name for name in PASSES if name in known] + sorted(known - set(PASSES))
    sums = {preset: sum(passes.values()) for preset, (passes, _) in medians.items()}
    lines = [row("pass", PRESETS), "|---" * (len(PRESETS) + 1) + "|"]
    lines += [row(name, [cell(medians[preset][0].get(name, 0)) for preset in PRESETS]) for name in names
              if any(cell(passes.get(name, 0)) for passes, _ in medians.values())]
    lines.append(row("all passes", [cell(sums[preset]) for preset in PRESETS]))
    lines.append(row("frame, wall time", [cell(medians[preset][1]) for preset in PRESETS]))
    lines.append(row("all passes, low is 1", [f"{sums[preset] / sums['low']:.2f}" for preset in PRESETS]))
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--frames", type=int, default=9)
    parser.add_argument("--size", default="1280x720")
    parser.add_argument("--view-distance", type=int, default=8)
    parser.add_argument("--scene", default="landscape")
    options = parser.parse_args()
    print(table(median_runs(options)))


if __name__ == "__main__":
    main()
