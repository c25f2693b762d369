#!/usr/bin/env python3
"""Paints the project's own 16x16 texture set, one RGBA PNG per texture.

Usage: paint_textures.py OUT_DIR            paints every texture into OUT_DIR
       paint_textures.py --list             prints the file names and paints nothing
       paint_textures.py --sheet FILE.png   paints one image of them all (8x, wrapping ones tiled 3x3)

This script and the textures it paints are CC0: everything is drawn here from scratch. The same script
always gives the same pixels, because the only source of variety is hash01(); the seeds are picked by eye,
for stones so even that none stands out where a texture repeats.

The meaning of alpha depends on the texture's kind (see TEXTURES): opaque = 255; test = 0 or 255; glow = share
of light the texel emits; test+glow = 0 hole, 128 no glow, 255 full glow; blend = coverage; tint = share of the tint
that the texel takes.
"""
import argparse
import math
import pathlib
import struct
import sys
import zlib

sys.dont_write_bytecode = True  # the build runs this script: nothing is written into the source tree
import building_textures as building  # noqa: E402
import item_textures as items  # noqa: E402
import land_textures as land  # noqa: E402
from texture_tools import (ALL, BARK, BLADE, CACTUS, CREAM, DIRT, EMBER, GOLD, GRASS, IRON, LAGOON, LEAF,  # noqa: E402
                           NO_GLOW, SAND, SIZE, SNOW, STEM, STONE, WOOD, Image, Patches, apart, bled, cobbles, hash01,
                           mix, ramp, scattered, settled, smooth, tone)

# --- Ground ------------------------------------------------------------------------------------------------

def stone():
    patches = Patches(1033, 2, 4, 0.8, 0.5, 0.8)

    def shade(x, y):
        """Each cell is a chiselled facet: a plane that tilts its own way, so one side of it is lighter."""
        cell, (u, v) = patches.cell[x, y], patches.offset[x, y]
        tilt_x, tilt_y = (hash01(1043 + k, cell) - 0.75 for k in (0, 1))
        value = 0.5 + 0.35 * (hash01(1045, cell) - 0.5) + 0.5 * (u * tilt_x + v * tilt_y)
        value += 0.1 * (hash01(1046, x, y) - 0.5)
        return tone(STONE, value + (-0.2 if patches.gap(x, y) else 0.12 if patches.lit(x, y) else 0))
    return settled(Image(shade), (128, 126, 120))


def dirt():
    return settled(cobbles(Patches(1070, 4, 4, 0.7, 0.6, 0.9), DIRT, spread=0.35, gap=0.22), (134, 96, 60))


def grass_top():
    return settled(cobbles(Patches(1074, 4, 4, 0.7, 0.7, 0.9), GRASS, spread=0.3, gap=0.2), (95, 135, 50))


def sand(colors=tuple(SAND), mean=(216, 196, 142)):
    def shade(x, y):
        """Ripples that run aslant and are bent by soft noise; grain keeps them from reading as stripes."""
        phase = (3 * y + x) / SIZE + 1.1 * smooth(41, x, y, 3, 3)
        ripple = abs(2 * (phase % 1) - 1)
        return tone(colors, 0.34 + 0.3 * ripple + 0.22 * (hash01(42, x, y) - 0.5))
    return settled(Image(shade), mean)


def snow():
    def shade(x, y):
        drift = smooth(51, x, y, 3, 3) * 0.6 + smooth(52, x, y, 6, 6) * 0.4
        return tone(SNOW, 0.24 + 0.66 * drift + 0.12 * (hash01(53, x, y) - 0.5))
    return settled(Image(shade), (238, 242, 248), 1.0)


def grass_side() -> Image:
    """Dirt over which the grass hangs as a ragged fringe. Deep, so that a hillside keeps the color of its ground.
    The grass takes the tint, the dirt does not."""
    soil, cover, depth = dirt(), grass_top(), [9 + int(4 * smooth(61, x, 0, 16, 1)) for x in range(SIZE)]

    def shade(x, y):
        if y >= depth[x]:
            return (*mix(soil[x, y][:3], (40, 24, 20), 0.35 if y == depth[x] else 0.0), 0)
        return mix(cover[x, y][:3], GRASS[0], 0.45 if y == depth[x] - 1 else 0.0)
    return Image(shade)


def glowing_ore():
    """Stone that gives no light, with nuggets that glow more towards their bright hearts."""
    key = {"a": (*EMBER[1], 120), "b": (*EMBER[2], 200), "c": (*EMBER[3], 255), "d": (*EMBER[5], 255)}
    rock = stone()
    image = Image(lambda x, y: (*rock[x, y][:3], 0))
    for left, top, rows in ((2, 1, ".bb. bcdb acdc .ab."), (10, 4, ".cb. cdcb .bca"),
                            (5, 9, ".bc.. bddca .acba"), (13, 11, ".b bc cb")):
        image.stamp(left, top, rows, key)
    return image


# --- Trees and cacti ---------------------------------------------------------------------------------------

def oak_log_side():
    """Bark plates are the cobbles' tall kin: the staggered rows are turned to run upright."""
    lying = cobbles(Patches(81, 2, 4, 0.7, 0.6, 0.4), BARK, spread=0.35, gap=0.35, lit=0.16)
    return settled(Image(lambda x, y: lying[y, x]), (92, 66, 43))


def oak_log_top():
    bark = oak_log_side()

    def shade(x, y):
        u, v = abs(x - 7.5), abs(y - 7.5)
        if max(u, v) > 7:
            return bark[x, y]
        radius = 0.75 * math.hypot(u, v) + 0.25 * max(u, v) + 1.2 * (smooth(91, x, y, 4, 4) - 0.5)
        ring = 0.72 if radius % 2 < 1 else 0.42
        return tone(WOOD, ring - 0.025 * radius + 0.12 * (hash01(92, x, y) - 0.5))
    return Image(shade)


def planks(x: int, y: int) -> tuple:
    """Boards four texels high, each with its own tone and grain, dark in the joints."""
    board = y // 4
    if y % 4 == 3 or (x + 5 * board) % 11 == 10:
        return WOOD[0]
    grain = smooth(331 + board, x, y, 3, 16) - 0.5
    return tone(WOOD, 0.45 + 0.25 * (hash01(335, board) - 0.5) + 0.45 * grain)


def chest(lock: bool):
    """Boards in a frame of dark beams; the sides have a seam under the lid, and a lock on it."""
    def shade(x, y):
        edge = min(x, y, 15 - x, 15 - y)
        if edge < 2:
            return tone(BARK, 0.75 - 0.3 * edge + 0.25 * (hash01(341, x, y) - 0.5))
        return planks(x, y)
    image = Image(shade)
    if lock:
        image.stamp(2, 5, " ".join(["d" * 12]), {"d": BARK[0]})
        image.stamp(6, 3, "gggg gyyg gkkg gkkg gggg", {"g": GOLD[1], "y": GOLD[4], "k": IRON[0]})
    return image


def oak_leaves():
    """Round leaf clumps, each lit from the upper left, painted from the back (small, dark) to the front."""
    image, clumps = Image(), scattered(307, 4, 4, 0.55)
    for depth, number in enumerate(sorted(range(16), key=lambda number: hash01(310, number))):
        size, light = 1.65 if depth < 5 else 2.25, 0.33 + 0.023 * depth
        for x, y in ALL:
            dx, dy = apart((x, y), clumps[number])
            if math.hypot(dx, dy) + 1.1 * (hash01(311, x, y) - 0.5) < size:
                image[x, y] = tone(LEAF, light - 0.08 * (dx + dy) + 0.18 * (hash01(312, x, y) - 0.5))
    return bled(image)


def cactus_side():
    def shade(x, y):
        if x in (0, 15):  # an open rim where only spines poke out, every 8 rows, left and right in turn
            return CREAM[4] if (y * 3 + x) % 8 == 2 else None
        rib = (0.2, 0.55, 0.8, 0.6, 0.35)[(x + 3) % 5]  # across one rib: groove, lit crest, shaded flank
        return tone(CACTUS, rib + 0.2 * (smooth(111, x, y, 8, 4) - 0.5))
    image = Image(shade)
    for x, first in ((4, 1), (9, 4), (14, 7)):
        for y in (first, first + 8):
            image[x, y], image[x, y + 1] = CREAM[5], CACTUS[1]
    return bled(image)


def cactus_top():
    def shade(x, y):
        u, v = x - 7.5, y - 7.5
        reach = max(abs(u), abs(v))
        rib = 0.25 if abs(abs(u) - abs(v)) < 1 else 0
        return tone(CACTUS, 0.75 - 0.04 * reach - rib + 0.15 * (hash01(121, x, y) - 0.5))
    image = Image(shade)
    for x, y in ((2, 7), (5, 3), (10, 2), (13, 8), (12, 12), (6, 12), (5, 8), (9, 6)):
        image[x, y], image[x, y + 1] = CREAM[5], CACTUS[1]
    return image


def cactus_bottom():
    flesh = [mix(a, b, 0.3) for a, b in zip(CREAM, CACTUS)]

    def shade(x, y):
        u, v = abs(x - 7.5), abs(y - 7.5)
        if max(u, v) > 6 or u + v > 11:
            return tone(CACTUS, 0.25 if max(u, v) > 7 else 0.5)
        ring = 0.72 if math.hypot(u, v) % 3 < 2 else 0.5
        return tone(flesh, ring + 0.2 * (hash01(126, x, y) - 0.5))
    return Image(shade)


# --- Plants ------------------------------------------------------------------------------------------------

def blade(image: Image, x: int, height: int, colors: list, lean: int = 0) -> None:
    """One upright blade from the bottom row, lighter to its tip, which lean moves aside by a texel."""
    for step in range(height):
        share = step / max(1, height - 1)
        image[x + (lean if share > 0.6 else 0), SIZE - 1 - step] = tone(colors, 0.15 + 0.8 * share)


def grass_tuft():
    image = Image()
    for x, height, lean in ((1, 5, -1), (2, 7, 0), (4, 8, -1), (5, 5, 0), (6, 11, 0), (7, 7, 0),
                            (9, 9, 0), (10, 12, 0), (11, 6, 0), (13, 9, 1), (14, 5, 1)):
        blade(image, x, height, BLADE, lean)
    return bled(image)


def stalk(top: int) -> Image:
    image = Image()
    for y in range(top, SIZE):
        image[7, y], image[8, y] = STEM[3], STEM[1]
    return image


LEAVES = {"a": STEM[1], "b": STEM[2], "c": STEM[3], "d": STEM[4]}


def poppy():
    image = stalk(8).stamp(3, 11, "d..... cd..dc .cb.cb ..b.b.", LEAVES)
    key = dict(zip("defgk", [*ramp("8c1a1c b5261f d63a26 ee5c38"), (48, 26, 34)]))
    return bled(image.stamp(4, 3, "..gggf.. .gffefg. gffeeffe ffekkefe feekkeed .dfeefd. ..dded..", key))


def oxeye_daisy():
    image = stalk(9).stamp(4, 11, "d.... cd..c .cb.d ..bc.", LEAVES)
    key = dict(zip("swWyo", ramp("b9c4cf e2e6e6 ffffff f2c63c d19a24")))
    petals = "..W.Ww.. W.WsWw.w .WwWwsw. WWsyywWW swwyosww .wsswWw. w.wW.s.s ..ws.ws."
    return bled(image.stamp(4, 2, petals, key))


def blue_orchid():
    image = stalk(5).stamp(4, 12, "d...... cd...d. .cb.bc. ..bab..", LEAVES)
    key = dict(zip("abcw", ramp("1c5fa8 2b8bd6 56b8ee d6f2ff")))
    for left, top in ((6, 2), (3, 4), (9, 5), (4, 8), (9, 9)):
        image.stamp(left, top, "bc. cwb .ba", key)
    return bled(image)


def wheat(stage: int):
    """Four stalks with shorter leaves beside them; from the third stage (2) on they carry ears."""
    image, grain = Image(), ".y. ygo .g. ygo .g. ygo .o."
    height, leaf, ear = ((5, 4, ""), (9, 6, ""), (12, 6, grain[:19]), (15, 6, grain))[stage]
    colors = STEM if stage < 2 else [mix(a, b, (stage - 1) / 2) for a, b in zip(STEM, GOLD)]
    key = {"y": colors[5], "g": colors[4], "o": colors[2]}
    for x, lower in ((2, 2), (6, 0), (9, 3), (13, 1)):
        lower = min(lower, stage + 1)
        blade(image, x - 1, leaf - lower, colors[:-1])
        blade(image, x + 1, leaf - 2 + lower // 2, colors[:-1])
        blade(image, x, height - lower, colors[:-1])
        image.stamp(x - 1, SIZE - height + lower, ear, key)
    return bled(image)


def mushroom(rows: str, cap: list, stem=(CREAM[2], CREAM[4]), stem_alpha=255):
    """Letters: r s t u = cap from shadow to light, p q = stem's shadow and light, w = pale spot."""
    key = dict(zip("rstuw", [*cap, CREAM[5]]))
    key.update({letter: (*color, stem_alpha) for letter, color in zip("pq", stem)})
    lines = rows.split()
    return bled(Image().stamp((SIZE - len(lines[0])) // 2, SIZE - len(lines), rows, key))


def red_mushroom():
    return mushroom("..ttuu.. .twwuut. stwttuts swtttwws rsttswsr .rrrrrr. ...qp... ...qp... ..qqpp..",
                    ramp("7d1a1c a8241f cc3626 e65a3c"))


def brown_mushroom():
    return mushroom("...tuut... .ttuuttts. sttttttssr rrssssrrrr ....qp.... ....qp.... ...qqpp...",
                    ramp("5c3d2a 7d5638 9a7049 b88d60"))


def glowing_mushroom():
    """Caps give all their light (alpha 255), stems give none."""
    rows = ("..tuut.... .tuuutts.. rsttttssr. ...qp..tu. ...qp.tuts .u.qp.rssr tts.qp.qp. rsr.qp.qp. "
            ".q..qpqp..")
    return mushroom(rows, LAGOON[2:], ramp("5b8f86 a9cfc0"), NO_GLOW)


# --- Lamps, glass, water -----------------------------------------------------------------------------------

def lamp(light: tuple):
    """A dark lead frame holds a round pane in the middle and four panes in the corners."""
    def shade(x, y):
        u, v = abs(x - 7.5), abs(y - 7.5)
        reach = math.hypot(u, v)
        if max(u, v) > 7 or (min(u, v) < 1 and reach > 4) or 4 < reach < 5.2:
            return (*IRON[min(x, y) == 0], 0)  # the outer upper and left rim is the lighter of the two
        return (*mix(light, (255, 255, 250), max(0.0, 0.55 - 0.055 * reach)), 255)
    return Image(shade)


def cyan_glass():
    def shade(x, y):
        """A bevelled frame, a near-clear pane, and across it a wide and a thin streak of reflected sky."""
        if min(x, y) == 0 or max(x, y) == 15:
            return (150, 232, 238, 170) if min(x, y) == 0 else (92, 196, 208, 170)
        if x + y in (10, 11, 14) and 2 < x < 12 and 2 < y < 12:
            return (214, 250, 250, 170)
        return (110, 214, 224, 70)
    return Image(shade)


def water():
    def shade(x, y):
        """Light gathers in a soft net of lines, as on the floor of a shallow pool: where bent waves meet."""
        u, v = (2 * math.pi * a / SIZE for a in (x, y))
        waves = (math.sin(2 * u + v + 1.4 * math.sin(2 * v + 1)) + math.sin(2 * v - u + 1.4 * math.sin(2 * u))
                 + math.sin(3 * u - 2 * v + math.sin(u + v)))
        net = max(0.0, 1 - 0.8 * abs(waves))
        return (*mix((28, 92, 138), (52, 122, 164), net), 219 + round(7 * net))
    return settled(Image(shade), (34, 98, 146))


def white_water(columns: int, rows: int):
    """Falling water: streaks of different brightness, long where there are few `rows`; as many of both is foam."""
    def shade(x, y):
        fine = smooth(611, x, y, columns, rows) - 0.5
        wide = smooth(612, x, y, columns // 2, rows) - 0.5
        value = min(1, max(0, 0.66 + 0.9 * fine + 0.7 * wide))
        return (*mix((150, 194, 218), (252, 254, 255), value), 196 + round(56 * value))
    return Image(shade)


def missing():
    return Image(lambda x, y: (255, 0, 255) if (x // 4 + y // 4) % 2 else (0, 0, 0))


# --- The set -----------------------------------------------------------------------------------------------

# name: (painter, kind of alpha, whether it repeats across a wall)
TEXTURES = {
    "stone": (stone, "opaque", True),
    "dirt": (dirt, "opaque", True),
    "grass_top": (grass_top, "opaque", True),
    "grass_side": (grass_side, "tint", True),
    "sand": (sand, "opaque", True),
    "snow": (snow, "opaque", True),
    "glowing_ore": (glowing_ore, "glow", True),
    "oak_log_side": (oak_log_side, "opaque", True),
    "oak_log_top": (oak_log_top, "opaque", True),
    "oak_leaves": (oak_leaves, "test", True),
    "grass_tuft": (grass_tuft, "test", False),
    "blue_orchid": (blue_orchid, "test", False),
    "poppy": (poppy, "test", False),
    "oxeye_daisy": (oxeye_daisy, "test", False),
    "wheat_0": (lambda: wheat(0), "test", False),
    "wheat_1": (lambda: wheat(1), "test", False),
    "wheat_2": (lambda: wheat(2), "test", False),
    "wheat": (lambda: wheat(3), "test", False),
    "red_mushroom": (red_mushroom, "test", False),
    "brown_mushroom": (brown_mushroom, "test", False),
    "glowing_mushroom": (glowing_mushroom, "test+glow", False),
    "cactus_side": (cactus_side, "test", True),
    "cactus_top": (cactus_top, "opaque", True),
    "cactus_bottom": (cactus_bottom, "opaque", True),
    "chest_top": (lambda: chest(False), "opaque", False),
    "chest_side": (lambda: chest(True), "opaque", False),
    "lamp_white": (lambda: lamp((255, 230, 190)), "glow", True),
    "lamp_red": (lambda: lamp((226, 40, 34)), "glow", True),
    "lamp_green": (lambda: lamp((52, 186, 60)), "glow", True),
    "lamp_blue": (lambda: lamp((44, 98, 232)), "glow", True),
    "cyan_glass": (cyan_glass, "blend", True),
    "water": (water, "blend", True),
    "white_water_side": (lambda: white_water(8, 1), "blend", True),
    "white_water_top": (lambda: white_water(8, 8), "blend", True),
    "red_sand": (lambda: sand(land.RED_SAND, (186, 106, 60)), "opaque", True),
    "mossy_stone": (lambda: land.mossy_stone(stone()), "opaque", True),
    "coal_ore": (lambda: land.ore(stone(), land.COAL), "opaque", True),
    "copper_ore": (lambda: land.ore(stone(), land.COPPER), "opaque", True),
    "iron_ore": (lambda: land.ore(stone(), land.RUST), "opaque", True),
    "gold_ore": (lambda: land.ore(stone(), land.NUGGET), "opaque", True),
    **land.TEXTURES,
    **building.TEXTURES,
    **items.TEXTURES,
    "missing": (missing, "opaque", True),
}


def png(width: int, height: int, rgba: bytes) -> bytes:
    """An RGBA8 PNG file; every row is led by a 0, the filter that leaves the row as it is."""
    def chunk(tag: bytes, body: bytes) -> bytes:
        return struct.pack(">I", len(body)) + tag + body + struct.pack(">I", zlib.crc32(tag + body))
    rows = b"".join(b"\0" + rgba[4 * width * y:4 * width * (y + 1)] for y in range(height))
    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)  # 8 bits a channel, color type 6: RGBA
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9))
            + chunk(b"IEND", b""))


def seen(rgba: tuple, kind: str, x: int, y: int) -> bytes:
    """A texel as the sheet shows it: holes and blended texels over a grey checker of 4x4 texels."""
    cover = {"blend": rgba[3] / 255, "test": rgba[3] / 255, "test+glow": float(rgba[3] > 0)}.get(kind, 1.0)
    under = (118, 124, 120) if (x // 4 + y // 4) % 2 else (104, 110, 106)
    return bytes((*mix(under, rgba[:3], cover), 255))


def sheet(columns: int = 7, scale: int = 8) -> bytes:
    """Cells of 3x3 textures: a wrapping texture fills its cell, nine of the others share one."""
    cells = [[name] * 9 for name in TEXTURES if TEXTURES[name][2]]
    single = [name for name in TEXTURES if not TEXTURES[name][2]]
    cells += [single[i:i + 9] for i in range(0, len(single), 9)]
    painted = {name: paint() for name, (paint, _, _) in TEXTURES.items()}
    pitch = 3 * SIZE + 1  # one texel between cells
    width, height, texels = columns * pitch, -(-len(cells) // columns) * pitch, {}
    for cell, place, name in ((c, p, name) for c, names in enumerate(cells) for p, name in enumerate(names)):
        left, top = cell % columns * pitch + place % 3 * SIZE, cell // columns * pitch + place // 3 * SIZE
        for x, y in ALL:
            texels[left + x, top + y] = seen(painted[name][x, y], TEXTURES[name][1], x, y)
    blank = bytes((40, 42, 44, 255))
    rows = (b"".join(texels.get((x, y), blank) * scale for x in range(width)) * scale for y in range(height))
    return png(width * scale, height * scale, b"".join(rows))


def icon(size: int = 128) -> bytes:
    """A block of grass seen from above a corner."""
    top, side, half = TEXTURES["grass_top"][0](), TEXTURES["grass_side"][0](), size / 2

    def texel(x: int, y: int) -> bytes:
        u, v = (x + 0.5 - half) / half, (y + 0.5) / half  # -1…1 to the right, 0…2 downward
        a, b = v + u / 2 - 0.5, v - u / 2 - 0.5  # along the edges of the top face
        if max(abs(a), abs(b)) < 0.5:
            return bytes((*top[int((a + 0.5) * SIZE), int((b + 0.5) * SIZE)][:3], 255))
        depth = v - 1 + abs(u) / 2  # below the front edges of the top face
        if 0 <= depth < 1 and abs(u) < 1:
            color = side[int((u % 1) * SIZE), int(depth * SIZE)][:3]
            return bytes((*(int(c * (0.82 if u < 0 else 0.62)) for c in color), 255))
        return bytes(4)

    return png(size, size, b"".join(texel(x, y) for y in range(size) for x in range(size)))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", nargs="?", type=pathlib.Path, help="folder for the textures")
    parser.add_argument("--list", action="store_true", help="print the file names, paint nothing")
    parser.add_argument("--sheet", type=pathlib.Path, metavar="FILE.png", help="paint a sheet of them all")
    parser.add_argument("--icon", type=pathlib.Path, metavar="FILE.png", help="paint the icon of the program")
    args = parser.parse_args()
    if not (args.out or args.list or args.sheet or args.icon):
        parser.error("an output folder is needed")
    if args.list:
        print(*(f"{name}.png" for name in TEXTURES), sep="\n")
        return
    if args.sheet:
        args.sheet.write_bytes(sheet())
    if args.icon:
        args.icon.write_bytes(icon())
    if args.out:
        args.out.mkdir(parents=True, exist_ok=True)
        for name, (paint, _, _) in TEXTURES.items():
            image = paint()
            data = b"".join(bytes(image[at]) for at in ALL)
            (args.out / f"{name}.png").write_bytes(png(SIZE, SIZE, data))


if __name__ == "__main__":
    main()
