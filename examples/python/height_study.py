#!/usr/bin/env python3
"""Compares the terrain of two generators: distribution of heights and slopes, and power spectrum.

    PYTHONPATH=build/python examples/python/height_study.py -o heights.png [--generators continents overworld]

Heights are read 8 blocks apart, over 16 by 16 km. Needs matplotlib.
"""
import argparse

import matplotlib
import numpy as np
import terrane

matplotlib.use("Agg")
from matplotlib import colors, pyplot  # noqa: E402

STEP = 8  # blocks from one column to the next
SIDE = 2048  # columns
MEAN = 4  # columns per side; slopes use mean heights, since single heights are integers
NEAR = 1024  # blocks per side of the map of single columns
SEA_LEVEL = 80


def slopes(heights):
    """Slope in degrees and mean height of squares of MEAN columns."""
    means = heights.reshape(SIDE // MEAN, MEAN, SIDE // MEAN, MEAN).mean((1, 3))
    along_y, along_x = np.gradient(means, STEP * MEAN)
    return np.degrees(np.arctan(np.hypot(along_x, along_y))), means


def radial_spectrum(heights):
    """Wavelengths in blocks, and the mean power over all directions at each."""
    window = np.hanning(len(heights))
    waves = np.fft.rfft2((heights - heights.mean()) * window[:, None] * window)
    power = np.abs(waves) ** 2 / heights.size
    cycles = np.hypot(np.fft.fftfreq(len(heights))[:, None], np.fft.rfftfreq(len(heights)))  # a column
    edges = np.geomspace(4 / SIDE, 0.5, 40)
    number = np.digitize(cycles.ravel(), edges)
    sums = np.bincount(number, power.ravel(), len(edges) + 1)[1:-1]
    counts = np.bincount(number, minlength=len(edges) + 1)[1:-1]
    return STEP / np.sqrt(edges[:-1] * edges[1:]), sums / np.maximum(counts, 1)


def draw_map(axes, title, heights, step):
    shade = colors.LightSource(315, 45).hillshade(heights.astype(float), vert_exag=2, dx=step, dy=step)
    extent = (0, len(heights) * step / 1000, 0, len(heights) * step / 1000)
    shown = axes.imshow(heights, cmap="gist_earth", vmin=20, vmax=230, origin="lower", extent=extent)
    axes.imshow(shade, cmap="gray", alpha=0.35, origin="lower", extent=extent)
    axes.set(title=title, xlabel="x, 1,000 blocks", ylabel="y, 1,000 blocks")
    return shown


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", default="heights.png")
    parser.add_argument("--generators", nargs=2, default=["continents", "overworld"], choices=terrane.generators())
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()

    figure, axes = pyplot.subplots(2, 3, figsize=(18, 11), layout="constrained")
    curve, steepness, spectrum = axes[1]
    for number, name in enumerate(options.generators):
        world = terrane.World(options.seed, name)
        heights = world.heights((0, 0, SIDE * STEP, SIDE * STEP), STEP, ground=True)
        shown = draw_map(axes[0][number], f"{name}: height of the ground, z", heights, STEP)
        share = np.linspace(100, 0, heights.size)
        curve.plot(share[::997], np.sort(heights, axis=None)[::997], label=name)
        degrees, means = slopes(heights)
        steepness.hist(degrees[means > SEA_LEVEL], np.linspace(0, 70, 71), density=True, histtype="step", label=name)
        spectrum.loglog(*radial_spectrum(heights), label=name)
    middle = SIDE * STEP // 2
    near = world.heights((middle, middle, middle + NEAR, middle + NEAR))
    draw_map(axes[0][2], f"{name}: from {middle}, {middle} on, with trees and water", near, 1)
    figure.colorbar(shown, ax=axes[0], shrink=0.8)

    curve.axhline(SEA_LEVEL, color="steelblue", linewidth=0.8, linestyle="--", label="sea level")
    curve.set(title="Hypsometric curve", xlabel="share of the land that lies higher, %", ylabel="z of the ground")
    steepness.set(title="Slopes of the land above the sea", xlabel="degrees", ylabel="density", yscale="log")
    spectrum.set(title="Power spectrum", xlabel="wavelength, blocks", ylabel="mean power")
    spectrum.invert_xaxis()
    for chart in axes[1]:
        chart.grid(alpha=0.3)
        chart.legend()
    figure.savefig(options.output, dpi=80)
    print(f"{options.output}: {SIDE}² columns of each generator")


if __name__ == "__main__":
    main()
