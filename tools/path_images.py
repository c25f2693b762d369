#!/usr/bin/env python3
"""Draws the views of docs/rays.md with the path tracer and with the rasterizer, and prints how far apart they are.

    tools/path_images.py [--program build/terrane] [--samples 64] [--size 640x360] [--only NAME,...] FOLDER

FOLDER gets NAME_path.png, NAME_quads.png and, in docs/images' form, NAME.jpg (ImageMagick). Samples are kept in
NAME.samples, so a second run with more of them goes on. Needs the example program `village` beside the program.
"""
import argparse
import json
import pathlib
import subprocess

import numpy

HAMLET, HALL = "hamlet.sqlite", "hall.sqlite"
WORLDS = {HAMLET: ["3466,-1690"], HALL: ["3440,-1650", "hall"]}
OVERWORLD = ["--generator", "overworld"]
VIEWS = {
    "glade": [*OVERWORLD, "--at=-87.5,-87.5,88.6", "--look=180,-3", "--time=0.36"],
    "forest": ["--generator", "wilderness", "--at=-800,3560,85", "--look=150,-12", "--time=0.4"],
    "cave": ["--world", HALL, "--at=3424,-1650,63.5", "--look=0,-18", "--time=0", "--horizon=0"],
    "village": ["--world", HAMLET, "--at=3395,-1712,92", "--look=30,-14", "--time=0.9", "--horizon=128"],
    "hall": ["--world", HALL, "--at=3428.5,-1650,86", "--look=0,-6", "--time=0.42", "--horizon=128"],
    "water": [*OVERWORLD, "--at=-180,60,104", "--look=152,-20", "--time=0.42", "--horizon=256"],
    "dawn": ["--at=3650,-2100,200", "--look=62,-9", "--time=0.225"],
}
# What the path tracer does not draw.
QUADS = ["--preset=high", "--clouds=off", "--god-rays=off", "--bloom=off"]


def linear(path: pathlib.Path) -> numpy.ndarray:
    """Linear light of a PNG file: tone.glsl backwards, up to the brightness where it ends in white."""
    size = subprocess.run(["identify", "-format", "%h %w", path], check=True, capture_output=True, text=True).stdout
    pixels = subprocess.run(["convert", path, "-depth", "8", "rgb:-"], check=True, capture_output=True).stdout
    stored = numpy.frombuffer(pixels, numpy.uint8).reshape(*map(int, size.split()), 3) / 255
    color = numpy.where(stored <= 0.04045, stored / 12.92, ((stored + 0.055) / 1.055) ** 2.4)
    over = numpy.clip((color - 0.6) / 0.4, 0, 1 - 1e-3)
    return numpy.where(color > 0.6, 0.6 - 0.4 * numpy.log1p(-over), color) / 0.92


def luminance(color: numpy.ndarray) -> numpy.ndarray:
    return color @ numpy.array([0.2126, 0.7152, 0.0722])


def draw(arguments: argparse.Namespace, name: str, renderer: str, options: list) -> dict:
    output = arguments.folder / f"{name}_{renderer}.png"
    command = [arguments.program, "render", "--renderer", renderer, "--size", arguments.size, "--view-distance=16", "--adaptation=off",
               "--json", "-o", output, *VIEWS[name], *options]
    text = subprocess.run([str(part) for part in command], check=True, capture_output=True, text=True,
                          cwd=arguments.folder).stdout
    return json.loads(text.splitlines()[-1])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=pathlib.Path("build/terrane"))
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--size", default="640x360")
    parser.add_argument("--only", default=",".join(VIEWS))
    parser.add_argument("folder", type=pathlib.Path)
    arguments = parser.parse_args()
    arguments.program = arguments.program.resolve()
    arguments.folder = arguments.folder.resolve()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for world, place in WORLDS.items():
        if not (arguments.folder / world).exists():
            subprocess.run([arguments.program.parent / "village", world, *place], check=True, cwd=arguments.folder)
    print("| view | mean luminance | mean difference | 99th percentile | rasterizer / path tracer | seconds |")
    print("|---|---|---|---|---|---|")
    for name in arguments.only.split(","):
        draw(arguments, name, "quads", QUADS)
        traced = draw(arguments, name, "path", [f"--samples={arguments.samples}", f"--resume={name}.samples"])
        subprocess.run(["convert", f"{name}_path.png", "-quality", "88", f"{name}.jpg"], check=True,
                       cwd=arguments.folder)
        truth, drawn = (luminance(linear(arguments.folder / f"{name}_{kind}.png")) for kind in ("path", "quads"))
        apart = numpy.abs(truth - drawn)
        print(f"| {name} | {truth.mean():.3f} | {apart.mean():.3f} | {numpy.percentile(apart, 99):.2f} "
              f"| {drawn.mean() / truth.mean():.2f} | {traced['milliseconds']['draw'] / 1000:.0f} |", flush=True)


if __name__ == "__main__":
    main()
