#!/usr/bin/env python3
"""Writes random cubes of blocks with their light as NumPy files, to train models with.

    PYTHONPATH=build/python examples/python/training_cubes.py -o cubes [--count 1000] [--side 64]

Each file cubes/NNNN.npz has 50 cubes:
    blocks  uint8 [n, z, y, x]       ids; `names` has the block of each
    light   uint8 [n, z, y, x, 2]    levels of 4 bits: sun | red << 4, green | blue << 4
    corners int64 [n, 3]             x, y, z of each cube
    names   str [ids]
Cubes contain the surface of the ground, anywhere within 16 km of the origin. One thread per CPU core works on files.
"""
import argparse
import os
import pathlib
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import terrane

CUBES_OF_FILE = 50
REACH = 16_000  # blocks; small enough that many cubes share the generator's cached rivers


def random_corner(world, random, side):
    x, y = (int(n) for n in random.integers(-REACH, REACH, 2))
    ground = int(world.heights((x, y, x + 1, y + 1), ground=True)[0, 0])
    return x, y, int(np.clip(ground - random.integers(side), 0, 256 - side))


def packed(light):
    """Four levels of 4 bits as two bytes."""
    return light[..., ::2] | light[..., 1::2] << 4


def write_file(world, path, seed, count, side):
    random = np.random.default_rng(seed)
    corners = np.array([random_corner(world, random, side) for _ in range(count)])
    blocks = np.empty((count, side, side, side), np.uint8)
    light = np.empty((count, side, side, side, 2), np.uint8)
    for k, (x, y, z) in enumerate(corners.tolist()):
        area = (x, y, z, x + side, y + side, z + side)
        blocks[k] = world.blocks(area)
        light[k] = packed(world.light(area))
    np.savez_compressed(path, blocks=blocks, light=light, corners=corners, names=np.array(world.block_names))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("cubes"))
    parser.add_argument("--generator", default="continents", choices=terrane.generators())
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--side", type=int, default=64)
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    options = parser.parse_args()

    options.output.mkdir(parents=True, exist_ok=True)
    world = terrane.World(options.seed, options.generator, threads=1)
    assert len(world.block_names) <= 256, "ids fit a byte"
    start, worked = time.perf_counter(), time.process_time()
    with ThreadPoolExecutor(options.threads) as pool:
        files = [pool.submit(write_file, world, options.output / f"{first // CUBES_OF_FILE:04}.npz", [options.seed, first],
                             min(CUBES_OF_FILE, options.count - first), options.side)
                 for first in range(0, options.count, CUBES_OF_FILE)]
        for file in files:
            file.result()
    size = sum(file.stat().st_size for file in options.output.glob("*.npz"))
    print(f"{options.count} cubes in {time.perf_counter() - start:.1f} s ({time.process_time() - worked:.1f} s of the processor), "
          f"{size / 2**20:.0f} MiB")


if __name__ == "__main__":
    main()
