#!/usr/bin/env python3
"""Makes an animation: a vertical section through the ground that moves over the terrain, with the map above it.

    PYTHONPATH=build/python examples/python/cave_flight.py -o caves.mp4   or .gif

Needs matplotlib, and ffmpeg for .mp4.
"""
import argparse

import matplotlib
import numpy as np
import terrane

matplotlib.use("Agg")
from matplotlib import animation, colors, pyplot  # noqa: E402

WIDTH, AHEAD = 480, 240  # blocks: width, and length of the flight
FRAMES, FRAMES_A_SECOND = 60, 12
# Colors by words in names of blocks; the first match counts.
COLORS = {"air": "#bcd9f2", "water": "#2f6fb5", "lava": "#ff7a1a", "grass": "#5d9b3c", "leaves": "#3c7a34", "log": "#6a4a2a",
          "sand": "#dcc98c", "snow": "#f4f7fa", "ice": "#b9dcee", "dirt": "#7a5a3a", "gravel": "#9a9490", "ore": "#c79a3a",
          "glow": "#ffe27a", "granite": "#8d6f66", "stone": "#77777c", "clay": "#a3a8b5", "mud": "#5a4a3c"}


def color_of(name):
    return next((color for word, color in COLORS.items() if word in name), "#8a8178")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", default="caves.mp4")
    parser.add_argument("--generator", default="overworld", choices=terrane.generators())
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--at", type=int, nargs=2, default=(0, 0), metavar=("X", "Y"))
    options = parser.parse_args()

    world = terrane.World(options.seed, options.generator)
    x, y = options.at
    heights = world.heights((x, y, x + WIDTH, y + AHEAD))
    palette = colors.ListedColormap([color_of(name) for name in world.block_names])
    count = len(world.block_names)

    figure, (above, below) = pyplot.subplots(2, 1, figsize=(9.6, 9.92), dpi=75, layout="constrained",
                                             height_ratios=(AHEAD, 256))
    top = world.surface((x, y, x + WIDTH, y + AHEAD))
    shade = colors.LightSource(315, 50).shade_rgb(palette(top)[..., :3], heights.astype(float), vert_exag=1.5)
    extent = (x, x + WIDTH, y, y + AHEAD)
    above.imshow(shade, origin="lower", extent=extent)
    above.set(title=f"{options.generator}, seed {options.seed}", ylabel="y")
    line = above.axhline(y, color="red", linewidth=1.5)
    cut = below.imshow(np.zeros((256, WIDTH)), origin="lower", extent=(x, x + WIDTH, 0, 256), cmap=palette, vmin=-0.5,
                       vmax=count - 0.5, interpolation="nearest")
    below.set(xlabel="x", ylabel="z")

    def show(frame):
        here = y + frame * AHEAD // FRAMES
        line.set_ydata([here, here])
        cut.set_data(world.blocks((x, here, x + WIDTH, here + 1))[:, 0])
        return line, cut

    is_gif = options.output.endswith(".gif")
    writer = (animation.PillowWriter if is_gif else animation.FFMpegWriter)(fps=FRAMES_A_SECOND)
    animation.FuncAnimation(figure, show, frames=FRAMES).save(options.output, writer=writer)
    print(f"{options.output}: {FRAMES} frames")


if __name__ == "__main__":
    main()
