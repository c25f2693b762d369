#!/usr/bin/env python3
"""Compares the speed of World.blocks() with `terrane generate`: the same area, in turn; prints medians and their ratio.

    PYTHONPATH=build/python tools/python_speed.py PROGRAM [--generator NAME] [--radius R] [--threads N] [--rounds N]
"""
import argparse
import json
import statistics
import subprocess
import time

import terrane


def seconds_of_program(options):
    done = subprocess.run([options.program, "generate", "--backend", "cpu", "--json", "--radius", str(options.radius),
                           "--generator", options.generator, "--threads", str(options.threads)], capture_output=True,
                          text=True, check=True)
    return json.loads(done.stdout)["seconds"]


def seconds_of_package(options):
    world = terrane.World(generator=options.generator, threads=options.threads)
    low, end = -16 * options.radius, 16 * (options.radius + 1)
    start = time.perf_counter()
    world.blocks((low, low, end, end))
    return time.perf_counter() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--generator", default="continents")
    parser.add_argument("--radius", type=int, default=32)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--rounds", type=int, default=7)
    options = parser.parse_args()
    program, package = [], []
    for _ in range(options.rounds):
        program.append(seconds_of_program(options))
        package.append(seconds_of_package(options))
    chunks = (2 * options.radius + 1) ** 2
    for name, seconds in (("terrane generate", program), ("World.blocks", package)):
        middle = statistics.median(seconds)
        print(f"{name}: {chunks / middle:.0f} chunks/s ({middle:.3f} s, {min(seconds):.3f} to {max(seconds):.3f})")
    ratios = [b / a for a, b in zip(program, package)]
    print(f"World.blocks takes {statistics.median(package) / statistics.median(program):.3f} of the time "
          f"(median of pairs {statistics.median(ratios):.3f})")


if __name__ == "__main__":
    main()
