#!/usr/bin/env python3
"""Checks calls of the package for leaks: prints resident memory before and after 10,000 calls.

    PYTHONPATH=build/python tools/python_leak.py [ROUNDS]   a round is 10 calls; 1,000 by default
"""
import gc
import os
import sys

import numpy as np
import terrane

CALLS_OF_ROUND = 10
ROUNDS_OF_WORLD = 20  # rounds per World, whose block types take 0.2 s to load


def resident_bytes():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def play_round(world, number):
    """One call of each kind; positions repeat, so that caches fill during warm-up."""
    x, y = 7 * (number % 8), 5 * (number % 4)
    blocks = world.blocks((x, y, 60, x + 40, y + 40, 100))
    world.light((x, y, 70, x + 8, y + 8, 90))
    world.heights((x, y, x + 64, y + 64))
    world.surface((x, y, x + 256, y + 256), 8)
    world.chunk(number % 8, 0, number % 3)
    world.chunks([(0, 0), (1, number % 4)])
    world.set_blocks(x, y, 200, np.where(blocks[:2] > 0, 0, number % 2).astype(np.uint16))
    world.digest((0, 0, 2, 2))
    try:
        world.blocks((0, 0, 0, 0))
    except terrane.Error:
        pass
    world.block_id("stone")
    if number % ROUNDS_OF_WORLD == 0:
        with terrane.World(seed=number, generator="flat", threads=1) as other:
            other.chunk(0, 0)


def growth(rounds, warm_rounds):
    """Resident bytes after warm-up, and after the given number of rounds."""
    world = terrane.World(seed=1, generator="overworld", threads=2)
    for number in range(warm_rounds):
        play_round(world, number)
    gc.collect()
    before = resident_bytes()
    for number in range(rounds):
        play_round(world, number)
    gc.collect()
    return before, resident_bytes()


def main():
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    before, after = growth(rounds, max(rounds // 10, 30))
    print(f"{rounds * CALLS_OF_ROUND} calls: {before / 2**20:.1f} MiB before, {after / 2**20:.1f} MiB after")


if __name__ == "__main__":
    main()
