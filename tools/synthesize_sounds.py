#!/usr/bin/env python3
"""Synthesizes the project's own sounds: 16-bit mono WAV files of 22,050 Hz, made from noise and damped sines.

Usage: synthesize_sounds.py OUT_DIR   writes every sound into OUT_DIR
       synthesize_sounds.py --list    prints the file names and writes nothing

A file is NAME_N.wav: the program plays sounds by NAME, N is one of its variants. Materials have NAME MATERIAL_step,
MATERIAL_place and MATERIAL_break; water_loop and wind_loop repeat without a seam. This script and the sounds are CC0.
"""
import math
import pathlib
import sys

sys.dont_write_bytecode = True  # the build runs this script: nothing is written into the source tree
from sound_tools import (add, band, bubble, decay, finished, generator_of, grains, low, mixed,  # noqa: E402
                         noise, ring, samples, scaled, swell, without_offset, write)


def thump(rng, frequency, time):
    """A soft blow: low noise."""
    return decay(low(noise(rng, samples(5 * time)), frequency), time, 0.002)


def click(rng, frequency, time, q=1.2):
    return decay(band(noise(rng, samples(5 * time)), frequency, q), time, 0.0005)


def falling(share):
    return (1 - share) ** 1.5


def varied(rng, modes, spread=0.04):
    return [(f * rng.uniform(1 - spread, 1 + spread), t, level * rng.uniform(0.8, 1.2)) for f, t, level in modes]


# --- Materials: sounds of steps, placing and breaking -------------------------------------------------------

def stone(rng, kind):
    grit = {"step": 9, "place": 7, "break": 42}[kind]
    seconds = {"step": 0.16, "place": 0.18, "break": 0.42}[kind]
    knock = ring(varied(rng, [(640, 0.012, 0.5), (1180, 0.010, 0.4), (2100, 0.006, 0.3)]), 0.1)
    debris = grains(rng, seconds * 0.85, grit, (900, 4200), (0.003, 0.012), falling)
    body = {"step": 0.5, "place": 1.0, "break": 1.1}[kind]
    return mixed(seconds, (thump(rng, 260, 0.022), 2.2 * body), (knock, 0.8 * body),
                 (click(rng, 1700, 0.008), 1.2 * body), (debris, 0.9 if kind != "place" else 0.4, 0.01))


WOOD = [(175, 0.05, 0.9), (320, 0.042, 0.8), (545, 0.03, 0.5), (910, 0.02, 0.35), (1430, 0.012, 0.2)]


def wood(rng, kind):
    seconds = {"step": 0.2, "place": 0.26, "break": 0.45}[kind]
    blow = mixed(seconds, (ring(varied(rng, WOOD), seconds), 0.5), (click(rng, 1100, 0.006), 0.8),
                 (thump(rng, 190, 0.02), 1.0))
    if kind != "break":
        return blow
    crack = grains(rng, 0.26, 22, (700, 3200), (0.002, 0.007), falling, 1.5)
    return mixed(seconds, (blow, 1.0), (crack, 1.0), (ring(varied(rng, WOOD, 0.1), 0.3), 0.35, 0.09))


def earth(rng, kind):
    seconds = {"step": 0.18, "place": 0.2, "break": 0.34}[kind]
    crumbs = grains(rng, seconds * 0.8, {"step": 14, "place": 10, "break": 40}[kind], (350, 1500), (0.004, 0.014),
                    falling, 1.2)
    return mixed(seconds, (thump(rng, 300, 0.035), 2.2), (low(decay(noise(rng, samples(seconds)), 0.04), 900), 0.5),
                 (crumbs, 0.6))


def sand(rng, kind):
    seconds = {"step": 0.24, "place": 0.28, "break": 0.4}[kind]
    hiss = swell(band(noise(rng, samples(seconds)), 3400, 0.6), 0.22)
    fine = grains(rng, seconds * 0.85, {"step": 30, "place": 34, "break": 60}[kind], (2200, 7000), (0.001, 0.004),
                  falling, 1.5)
    return mixed(seconds, (hiss, 0.5), (fine, 0.7), (thump(rng, 260, 0.03), 1.2))


def grass(rng, kind):
    seconds = {"step": 0.2, "place": 0.24, "break": 0.34}[kind]
    rustle = grains(rng, seconds * 0.8, {"step": 26, "place": 34, "break": 60}[kind], (2500, 7500), (0.003, 0.016),
                    lambda share: math.sin(math.pi * min(1.0, share + 0.15)), 1.0)
    return mixed(seconds, (rustle, 0.9), (thump(rng, 320, 0.028), 1.1 if kind == "step" else 0.6))


GLASS = [(1850, 0.05, 0.6), (2930, 0.04, 0.6), (4310, 0.03, 0.5), (5740, 0.02, 0.4), (7300, 0.015, 0.2)]


def glass(rng, kind):
    if kind != "break":
        seconds, level = (0.2, 0.45) if kind == "step" else (0.28, 1.0)
        return mixed(seconds, (ring(varied(rng, GLASS), seconds), 0.5 * level), (thump(rng, 420, 0.014), 1.2),
                     (click(rng, 3500, 0.004), 0.6))
    shards = [0.0] * samples(0.6)
    for _ in range(34):
        share = rng.random() ** 1.8
        modes = [(rng.uniform(2400, 9000), rng.uniform(0.012, 0.06), rng.uniform(0.2, 1)) for _ in range(2)]
        add(shards, ring(modes, 0.18), int(share * samples(0.45)), 1 - 0.7 * share)
    return mixed(0.62, (click(rng, 4200, 0.02, 0.7), 1.6), (shards, 0.35), (thump(rng, 600, 0.012), 1.0))


def wool(rng, kind):
    seconds = {"step": 0.18, "place": 0.2, "break": 0.26}[kind]
    soft = swell(low(noise(rng, samples(seconds * 0.8)), 420), 0.18)
    cloth = swell(band(noise(rng, samples(seconds * 0.7)), 1500, 0.8), 0.3)
    return mixed(seconds, (soft, 1.8), (cloth, 0.5 if kind == "break" else 0.2))


METAL = [(418, 0.11, 0.5), (1012, 0.13, 0.6), (1734, 0.1, 0.5), (2665, 0.08, 0.45), (3910, 0.05, 0.3)]


def metal(rng, kind):
    seconds = {"step": 0.26, "place": 0.36, "break": 0.5}[kind]
    tone = ring(varied(rng, METAL), seconds)
    rattle = grains(rng, 0.3, 14 if kind == "break" else 0, (1500, 5000), (0.002, 0.006), falling)
    return mixed(seconds, (tone, 0.28 if kind == "step" else 0.5), (click(rng, 2400, 0.006), 1.0),
                 (thump(rng, 240, 0.02), 1.2), (rattle, 0.7))


def snow(rng, kind):
    seconds = {"step": 0.26, "place": 0.24, "break": 0.36}[kind]
    crunch = grains(rng, seconds * 0.75, {"step": 70, "place": 50, "break": 90}[kind], (900, 3000), (0.002, 0.006),
                    lambda share: math.sin(math.pi * min(1.0, 0.2 + 0.8 * share)), 1.0)
    return mixed(seconds, (crunch, 0.9), (low(swell(noise(rng, samples(seconds * 0.8)), 0.3), 500), 0.9))


MATERIALS = {"stone": stone, "wood": wood, "earth": earth, "sand": sand, "grass": grass, "glass": glass, "wool": wool,
             "metal": metal, "snow": snow}
VARIANTS = {"step": 3, "place": 2, "break": 2}
PEAKS = {"step": 0.5, "place": 0.7, "break": 0.8}


# --- Water, wind, the user interface -----------------------------------------------------------------------

def bubbles(rng, seconds, count, frequencies):
    total = [0.0] * samples(seconds)
    for _ in range(count):
        drop = bubble(rng, frequencies, rng.uniform(0.03, 0.12))
        add(total, drop, int(rng.random() * (len(total) - len(drop))), rng.uniform(0.2, 1))
    return total


def water_splash(rng):
    spray = decay(band(noise(rng, samples(0.7)), 2600, 0.5), 0.14, 0.012)
    body = decay(low(noise(rng, samples(0.5)), 480), 0.09, 0.008)
    return mixed(0.8, (body, 2.0), (spray, 0.9), (bubbles(rng, 0.6, 26, (380, 1500)), 0.3, 0.12))


def water_swim(rng):
    wash = swell(band(noise(rng, samples(0.6)), 900, 0.6), 0.35)
    return mixed(0.65, (wash, 1.2), (bubbles(rng, 0.5, 9, (300, 900)), 0.5, 0.1))


def water_place(rng):
    return mixed(0.45, (bubbles(rng, 0.4, 16, (350, 1300)), 0.5),
                 (decay(band(noise(rng, samples(0.4)), 1500, 0.6), 0.08, 0.01), 0.7))


def water_loop(rng):
    """A brook: noise of two colors, and bubbles that go around the end."""
    count = samples(4)
    total = [0.0] * count
    add(total, band(noise(rng, count), 620, 0.5, turns=2), gain=0.26)
    add(total, band(noise(rng, count), 2600, 0.6, turns=2), gain=0.07)
    for _ in range(260):
        add(total, bubble(rng, (320, 1900), rng.uniform(0.02, 0.1)), int(rng.random() * count),
            0.42 * rng.random() ** 2, wraps=True)
    return total


def wind_loop(rng):
    """Noise through bands whose levels rise and fall in whole turns of the loop."""
    count = samples(8)
    total = [0.0] * count
    source = low(noise(rng, count), 1800, turns=2)
    for frequency, q, level in ((180, 0.8, 1.6), (330, 1.6, 1.2), (560, 2.5, 0.7), (950, 3.0, 0.3)):
        voice = band(source, frequency, q, turns=2)
        turns = [(rng.randint(1, 4), rng.random() * 2 * math.pi) for _ in range(3)]
        for k in range(count):
            wave = sum(math.sin(2 * math.pi * n * k / count + phase) for n, phase in turns) / 3
            total[k] += level * (0.6 + 0.4 * wave) * voice[k]
    return total


def ui_click(rng):
    return mixed(0.06, (ring([(1250, 0.006, 0.6), (2600, 0.004, 0.3)], 0.06), 1), (click(rng, 3000, 0.002), 0.3))


def table():
    """File name without its ending: a function that makes the samples."""
    sounds = {}
    for material, make in MATERIALS.items():
        for kind, count in VARIANTS.items():
            for number in range(1, count + 1):
                sounds[f"{material}_{kind}_{number}"] = (
                    lambda rng, make=make, kind=kind: finished(make(rng, kind), PEAKS[kind]))
    for number in (1, 2):
        sounds[f"water_splash_{number}"] = lambda rng: finished(water_splash(rng), 0.8)
        sounds[f"water_swim_{number}"] = lambda rng: finished(water_swim(rng), 0.45)
        sounds[f"water_place_{number}"] = lambda rng: finished(water_place(rng), 0.6)
    sounds["water_loop_1"] = lambda rng: scaled(without_offset(water_loop(rng)), 0.5)
    sounds["wind_loop_1"] = lambda rng: scaled(without_offset(wind_loop(rng)), 0.6)
    sounds["ui_click_1"] = lambda rng: finished(ui_click(rng), 0.4)
    return sounds


def main():
    sounds = table()
    if sys.argv[1:] == ["--list"]:
        print("\n".join(f"{name}.wav" for name in sounds))
        return
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for name, make in sounds.items():
        write(pathlib.Path(sys.argv[1]) / f"{name}.wav", make(generator_of(name)))


if __name__ == "__main__":
    main()
