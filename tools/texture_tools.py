"""Building blocks of textures: hash, color ramps, images, patches. Used by paint_textures.py."""
import math

SIZE = 16
ALL = [(x, y) for y in range(SIZE) for x in range(SIZE)]  # every texel; row 0 is the top of a block's side
NO_GLOW = 128  # alpha of a solid texel without glow in test+glow textures


# --- Small tools: hash, color ramps, images ---------------------------------------------------------------

def hash01(seed: int, x: int, y: int = 0) -> float:
    """An even share in [0, 1) for each (seed, x, y); the mixing steps are MurmurHash3's finalizer."""
    h = (seed * 0x9E3779B1 ^ x * 0x85EBCA77 ^ y * 0xC2B2AE3D) & 0xFFFFFFFF
    h = (h ^ h >> 16) * 0x85EBCA6B & 0xFFFFFFFF
    h = (h ^ h >> 13) * 0xC2B2AE35 & 0xFFFFFFFF
    return (h ^ h >> 16) / 2**32


def smooth(seed: int, x: float, y: float, columns: int, rows: int) -> float:
    """Soft noise in [0, 1) that wraps around the texture, with columns x rows hills."""
    u, v = x * columns / SIZE, y * rows / SIZE
    i, j = int(u // 1), int(v // 1)
    fu, fv = ((f * f * (3 - 2 * f)) for f in (u - i, v - j))
    a, b, c, d = (hash01(seed, (i + p) % columns, (j + q) % rows) for q in (0, 1) for p in (0, 1))
    return (a + (b - a) * fu) * (1 - fv) + (c + (d - c) * fu) * fv


def ramp(text: str) -> list:
    """Colors from shadow to light; shadows lean to cool, lights to warm, so that shading stays lively."""
    return [tuple(bytes.fromhex(word)) for word in text.split()]


STONE = ramp("5d5d60 6c6c6c 797874 84827b 8f8c84 9d998e")
DIRT = ramp("5a3c2b 6d4932 7c5639 8a6340 98704a a98157")
GRASS = ramp("3d6428 4a7429 57802e 638c33 739a3b 86ab48")
SAND = ramp("c0a477 ccb384 d4bf90 dac899 e2d1a4 ebddb4")
SNOW = ramp("c9d6ea d9e3f1 e6edf6 eff3f9 f7f9fc ffffff")
BARK = ramp("33241b 443022 553d29 654a30 765838 886845")
WOOD = ramp("8a6238 a0763f b4894d c39a5a d0a968 dcb97a")
LEAF = ramp("33592f 437036 56863c 6b9a45 84ae52 a2c365")
STEM = ramp("2f5a2a 3d7030 4f8537 669a41 84b152 a6c86c")
CACTUS = ramp("2f5a22 3f7227 4f852a 609630 74a638 8bb747")
BLADE = ramp("416b2c 517e36 628f3f 75a148 88b053 9dc063")
GOLD = ramp("8a6420 a67c26 c29530 d9ae3e ecc758 f8e08a")
EMBER = ramp("6e1c1e 922625 ad3029 cf4a2c ec7436 ffb45c")
LAGOON = ramp("1f5f5a 2f7d74 429584 56ac97 84cdb6 c4f2dd")
CREAM = ramp("8d7a62 a89678 c4b390 d8caa8 e9dfc2 f6f0dc")
IRON = ramp("28242a 343037")


def tone(colors: list, value: float) -> tuple:
    """The ramp's color for a value in 0 … 1 (0.5 is the ramp's middle; values beyond are held)."""
    return colors[max(0, min(len(colors) - 1, int(value * len(colors) // 1)))]


def mix(a: tuple, b: tuple, share: float) -> tuple:
    return tuple(round(p + (q - p) * share) for p, q in zip(a, b))


class Image:
    """16x16 texels whose coordinates wrap; shade(x, y) gives RGB or RGBA, or None for a hole."""

    def __init__(self, shade=lambda x, y: None):
        self.texels = {}
        for x, y in ALL:
            self[x, y] = shade(x, y)

    def __getitem__(self, at):
        return self.texels[at[0] % SIZE, at[1] % SIZE]

    def __setitem__(self, at, color):
        rgba = (0, 0, 0, 0) if color is None else (*color, 255)[:4]
        self.texels[at[0] % SIZE, at[1] % SIZE] = rgba

    def stamp(self, left: int, top: int, rows: str, key: dict) -> "Image":
        """Places a little drawing: rows are parted by blanks, '.' leaves what is there."""
        for y, row in enumerate(rows.split()):
            for x, letter in enumerate(row):
                if letter != ".":
                    self[left + x, top + y] = key[letter]
        return self


def settled(image: Image, mean: tuple, level=0.7) -> Image:
    """Shifts all colors so that the average is as asked: from afar only the average is seen.

    First it takes away a share (level) of what is light or dark over a wide area (9x9 texels): such areas
    would show as a pattern where a texture repeats.
    """
    def average(colors):
        return [sum(channel) / len(colors) for channel in zip(*colors)]
    near, whole = range(-4, 5), average([image[at] for at in ALL])

    def shade(x, y):
        wide = average([image[x + i, y + j] for i in near for j in near])
        color = (image[x, y][c] - level * (wide[c] - whole[c]) + mean[c] - whole[c] for c in range(3))
        return (*(max(0, min(255, round(value))) for value in color), image[x, y][3])
    return Image(shade)


def bled(image: Image) -> Image:
    """Gives holes the colors around them, ring by ring: mip-maps then get no dark fringes."""
    colors = {at: image[at][:3] for at in ALL if image[at][3]}
    while colors and len(colors) < len(ALL):
        ring = {}
        for x, y in (at for at in ALL if at not in colors):
            around = [((x + i) % SIZE, (y + j) % SIZE) for i in (-1, 0, 1) for j in (-1, 0, 1)]
            near = [colors[at] for at in around if at in colors]
            if near:
                ring[x, y] = tuple(round(sum(channel) / len(near)) for channel in zip(*near))
        colors.update(ring)
    return Image(lambda x, y: (*colors[x, y], image[x, y][3]))


# --- Patches: the irregular stones that soil, grass, rock and bark are laid from ---------------------------

def scattered(seed: int, columns: int, rows: int, shake: float) -> list:
    """The points of a grid whose odd rows are staggered, each moved by up to half of shake grid steps."""
    points = []
    for j, i in ((j, i) for j in range(rows) for i in range(columns)):
        dx, dy = (shake * (hash01(seed + k, i, j) - 0.5) for k in (1, 2))
        points.append(((i + 0.5 * (j % 2) + dx) * SIZE / columns, (j + dy) * SIZE / rows))
    return points


def apart(at: tuple, point: tuple) -> tuple:
    """The shortest way from point to texel on the wrapping square."""
    return tuple((a - b + SIZE / 2) % SIZE - SIZE / 2 for a, b in zip(at, point))


class Patches:
    """Splits the wrapping square into irregular cells around the points of a shaken, staggered grid.

    A texel belongs to the nearest point; square (0 … 1) blends round distance to that of a box, and tilt
    turns each cell's box its own way, like stones laid by hand.
    """

    def __init__(self, seed: int, columns: int, rows: int, shake: float, square: float, tilt: float):
        self.seed, self.cell, self.offset = seed, {}, {}
        points = scattered(seed, columns, rows, shake)
        for at in ALL:
            found = []
            for number, point in enumerate(points):
                dx, dy = apart(at, point)
                turn = tilt * (hash01(seed + 5, number) - 0.5)
                u, v = (dx + turn * dy) * columns / SIZE, (dy - turn * dx) * rows / SIZE
                box, disc = max(abs(u), abs(v)), math.hypot(u, v)
                found.append((disc + (box - disc) * square, number, (u, v)))
            _, self.cell[at], self.offset[at] = min(found)

    def same(self, x: int, y: int, i: int, j: int) -> bool:
        return self.cell[x, y] == self.cell[(x + i) % SIZE, (y + j) % SIZE]

    def gap(self, x: int, y: int) -> bool:
        """A cell's right and lower rim is the gap to the next one: one texel wide, in shadow."""
        return not (self.same(x, y, 1, 0) and self.same(x, y, 0, 1))

    def lit(self, x: int, y: int) -> bool:
        """A cell's upper and left rim catches the light, which comes from the upper left everywhere."""
        return not (self.same(x, y, -1, 0) and self.same(x, y, 0, -1))


def cobbles(patches: Patches, colors: list, spread: float, gap: float, lit=0.12) -> Image:
    """Soft rounded stones: each has its own tone, a lit rim, a darker gap and a little grain."""
    def shade(x, y):
        value = 0.52 + spread * (hash01(patches.seed + 3, patches.cell[x, y]) - 0.5)
        value += 0.12 * (hash01(patches.seed + 4, x, y) - 0.5)
        return tone(colors, value + (-gap if patches.gap(x, y) else lit if patches.lit(x, y) else 0))
    return Image(shade)
