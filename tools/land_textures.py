"""Paints more textures of terrain: trees by kind, rocks, soils, plants. Used by paint_textures.py, which has the table
of all textures and explains alpha."""
import math

from texture_tools import (ALL, BLADE, CREAM, GRASS, NO_GLOW, SIZE, STEM, WOOD, Image, Patches, apart, bled,
                           cobbles, hash01, mix, ramp, scattered, settled, smooth, tone)

BIRCH_BARK = ramp("8f8a80 b3aea2 c9c5b8 d8d5ca e4e2d9 efeee8")
SPRUCE_BARK = ramp("2e231d 3d2e25 4c3a2f 5a463a 695346 786254")
PINE_BARK = ramp("5a3322 734330 8a543a 9f6647 b27a58 c4906e")
ACACIA_BARK = ramp("4c443b 5e554a 70665a 82786a 948a7b a69d8e")
WILLOW_BARK = ramp("37301f 48402c 5a5039 6c6147 7f7357 928668")
PALM_BARK = ramp("6b5336 826744 987c54 ac9066 bfa47a d0b88f")
DEAD_BARK = ramp("6a645a 7f786d 938c80 a59e92 b6b0a5 c8c3b9")
PALE_WOOD = ramp("a08a5c b89f6c cbb27e dac392 e6d3a8 f0e1be")
RED_WOOD = ramp("7c4a30 945b3b a96d48 bc8058 ce956c dcaa83")
GREY_WOOD = ramp("77705f 8a8371 9c9583 ada795 beb9a8 cecabc")
BIRCH_LEAF = ramp("476b2c 5c8236 739a42 8db253 a9c86b c6dc8c")
SPRUCE_LEAF = ramp("1d3b2d 274a36 315a40 3f6c4b 517f59 6a946c")
PINE_LEAF = ramp("2a4a2c 365c34 45703d 568449 6b9959 86ae6e")
ACACIA_LEAF = ramp("4d5f2a 617534 778b40 8ea150 a6b665 c0cb82")
WILLOW_LEAF = ramp("4b672f 608039 789846 92af57 adc56e c9d98e")
PALM_LEAF = ramp("2f5a26 3f7030 52873b 6a9e49 86b65c a8cd78")
MAPLE_LEAF = ramp("6e1f16 902a18 b33c1c d05624 e5782f f2a04a")
ASPEN_LEAF = ramp("8a5f12 b07f18 cf9e24 e2b838 efce57 f8e58a")
BLOSSOM = ramp("a8607a c97f99 dd9cb3 ecb8cb f5d3df fdeef3")
FIR_LEAF = ramp("17323a 1f4046 2a5254 38665f 4c7d70 6b9a86")
OLIVE_LEAF = ramp("4f5a45 667258 7f8a6d 99a386 b3bba2 ced3bf")
KAPOK_LEAF = ramp("143f22 1c5229 276733 367d3d 4f964c 79b465")
PALE_BARK = ramp("8e877c a59d90 b8b0a2 c8c1b3 d6d0c3 e4dfd4")
PEELED = ramp("8c7a62 a3907a b8a68e c9baa2 d8ccb6 e6dcca")
CANE = ramp("5a7a2c 6f9035 86a642 9dba54 b4cb6c cedd90")
MOSS = ramp("36491f 435926 526a2e 627b37 748d43 8aa055")
PEBBLE = (ramp("5b5a5c 6d6c6c 7e7d7b 8f8d89 a09d98 b2aea8"), ramp("5e5147 72635a 84756b 97887c aa9a8e bcaea2"),
          ramp("6f6a60 827d72 958f84 a8a296 bab4a8 ccc7bc"))
CLAY = ramp("848b99 9198a5 9ea5b1 abb1bb b8bdc6 c6cad1")
MUD = ramp("2f251d 3a2e24 46382c 524335 604f40 70604f")
ICE = ramp("8fb6dc a3c6e6 b5d3ee c6dff4 d8eaf8 ecf6fd")
RED_SAND = ramp("9c5227 aa5d2d b86934 c4753d cf8249 da9059")
SANDSTONE = ramp("a98d62 b89c6f c6ab7e d2b98d dec69c e8d3ad")
RED_SANDSTONE = ramp("7c3f20 8f4a27 a0552e b06137 bd6f43 c97e52")
TERRACOTTA = ramp("9c6a4c ac7858 bb8766 c89676 d4a688 dfb79b")
BASALT = ramp("2c2c31 38383d 444449 505055 5d5d61 6d6d70")
LIMESTONE = ramp("9a9382 aaa492 b9b3a2 c6c1b1 d2cebf dedacd")
DRY = ramp("7d6b33 937f3d a8934a bca65a cdb970 decc8c")
REED = ramp("3f5a2c 527037 678644 7f9b54 99b069 b5c585")
FERN = ramp("24502a 2f6331 3d763a 4f8a46 669e55 83b36b")
HEATHER = ramp("5c2f63 753f7c 8f5295 a869ad c083c2 d8a3d6")
TWIG = ramp("4f3c28 624b33 765c40 8a6e4e a0835f b69a74")
BELL = ramp("2f3f9c 4257bd 5c74d6 8299ea aebdf6")
QUARTZ = ramp("3d4fa8 5670cc 7698e6 9cc0f4 c4e2fb f0fbff")
RED_CORAL = ramp("8c2430 a8303a c24045 d85652 e87265 f59683")
YELLOW_CORAL = ramp("9c6a14 b5811d cb982a dcae3c eac356 f5d97e")
SEAGRASS = ramp("1f4a33 2a5d3d 377048 478455 5b9966 76ae7c")
CAP = ramp("6e1f1a 872a21 a03729 b74833 ca5d40 da7752")
LAVA = ramp("6a1206 a8240a d8460f f2741a fba52f ffdc7a")
COAL = ramp("17171a 222226 2d2d31 3a3a3f 4a4a50 63636a")
COPPER = ramp("7a3f24 9a5230 b9683f cf8155 5f9c86 7cb8a0")
RUST = ramp("7d5038 97654a b07c5e c79674 d8ae8d e8c9ab")
NUGGET = ramp("8c6410 b58519 d8a827 edc545 f8de73 fff1b0")
GILL = ramp("a8977c b9a98d c9ba9f d7cab1 e3d9c3 eee7d6")


# --- Bark, rings and leaves ---------------------------------------------------------------------------------

def upright(lying: Image) -> Image:
    """Patches are laid in rows: turned, they run up a trunk."""
    return Image(lambda x, y: lying[y, x])


def plates(seed: int, columns: int, rows: int, colors: list, mean: tuple) -> Image:
    """Bark of plates, rows of them around the trunk and columns along it, with deep gaps."""
    stones = Patches(seed, columns, rows, 0.7, 0.6, 0.4)
    return settled(upright(cobbles(stones, colors, spread=0.35, gap=0.32, lit=0.16)), mean)


def furrows(seed: int, count: int, bend: float, colors: list, mean: tuple) -> Image:
    """Bark of long ridges that bend as they run up; one side of each is lit."""
    def shade(x, y):
        at = x * count / SIZE + bend * (smooth(seed, x, y, 2, 3) - 0.5)
        across = at % 1  # count is whole, so that ridges meet over the border
        ridge = 0.9 - 0.75 * across if across > 0.25 else 0.1 + 2.4 * across
        return tone(colors, ridge + 0.3 * (smooth(seed + 1, x, y, 8, 4) - 0.5)
                    + 0.12 * (hash01(seed + 2, x, y) - 0.5))
    return settled(Image(shade), mean)


def birch_log_side():
    def shade(x, y):
        return tone(BIRCH_BARK, 0.68 + 0.35 * (smooth(401, x, y, 4, 6) - 0.5) + 0.1 * (hash01(402, x, y) - 0.5))
    image = Image(shade)
    for left, top, rows in ((1, 1, "kkk.. .ggg."), (9, 3, "gkkkk ..gg."), (4, 6, "kk. .gg"), (12, 8, "kkkg gg.."),
                            (2, 10, "gkkkg .gg.."), (8, 12, "kk g."), (14, 13, "kkg .g."), (6, 14, "gg")):
        image.stamp(left, top, rows, {"k": (58, 52, 48), "g": (150, 144, 134)})
    return settled(image, (199, 195, 184), 0.4)


def spruce_log_side():
    return plates(411, 4, 4, SPRUCE_BARK, (78, 60, 48))


def pine_log_side():
    return plates(421, 2, 3, PINE_BARK, (142, 90, 62))


def acacia_log_side():
    return furrows(431, 4, 2.2, ACACIA_BARK, (116, 106, 92))


def willow_log_side():
    return furrows(449, 4, 0.7, WILLOW_BARK, (98, 87, 64))


def palm_log_side():
    """Old fronds leave rings of scars, ragged at their lower rim."""
    def shade(x, y):
        along = (y + int(2.2 * smooth(451, x, 0, 8, 1))) % 4
        return tone(PALM_BARK, (0.9, 0.62, 0.5, 0.12)[along] + 0.22 * (hash01(452, x, y // 4) - 0.5)
                    + 0.1 * (hash01(453, x, y) - 0.5))
    return settled(Image(shade), (156, 128, 88))


def dead_log_side():
    """Wood without bark: long grain, and cracks that begin and end."""
    def shade(x, y):
        crack = smooth(462, x, y, 16, 3) > 0.84
        return tone(DEAD_BARK, 0.5 + 0.5 * (smooth(461, x, y, 16, 3) - 0.5) + 0.1 * (hash01(463, x, y) - 0.5)
                    - (0.4 if crack else 0))
    return settled(Image(shade), (148, 141, 129))


def rings(bark: Image, seed: int, colors: list, width=2.0, contrast=0.3) -> Image:
    """The end of a log: a rim of bark, rings of years inside it."""
    def shade(x, y):
        u, v = abs(x - 7.5), abs(y - 7.5)
        if max(u, v) > 7:
            return bark[x, y]
        radius = 0.75 * math.hypot(u, v) + 0.25 * max(u, v) + 1.2 * (smooth(seed, x, y, 4, 4) - 0.5)
        ring = 0.72 if radius % width < 0.5 * width else 0.72 - contrast
        return tone(colors, ring - 0.025 * radius + 0.12 * (hash01(seed + 1, x, y) - 0.5))
    return Image(shade)


def palm_log_top():
    """A palm has no rings of years: fibres, denser and darker outward."""
    bark = palm_log_side()

    def shade(x, y):
        u, v = abs(x - 7.5), abs(y - 7.5)
        if max(u, v) > 7:
            return bark[x, y]
        radius = math.hypot(u, v)
        fibre = hash01(456, x, y) < 0.12 + 0.03 * radius
        return tone(PALE_WOOD, 0.72 - 0.035 * radius - (0.35 if fibre else 0) + 0.1 * (hash01(457, x, y) - 0.5))
    return Image(shade)


def clumps(seed: int, grid: int, size: float, colors: list, stretch=(1.0, 1.0), slope=0.08) -> Image:
    """Leaf clumps from the back (small, dark) to the front, each lit from the upper left."""
    image, points = Image(), scattered(seed, grid, grid, 0.55)
    count = len(points)
    for depth, number in enumerate(sorted(range(count), key=lambda number: hash01(seed + 3, number))):
        share = depth / count
        reach = size * (0.74 if share < 0.3 else 1.0)
        for x, y in ALL:
            dx, dy = apart((x, y), points[number])
            wide = math.hypot(dx * stretch[0], dy * stretch[1])
            if wide + 1.1 * (hash01(seed + 4, x, y) - 0.5) < reach:
                light = 0.3 + 0.4 * share - slope * (dx + dy)
                image[x, y] = tone(colors, light + 0.2 * (hash01(seed + 5, x, y) - 0.5))
    return bled(image)


def birch_leaves():
    return clumps(471, 5, 1.62, BIRCH_LEAF, slope=0.11)


def acacia_leaves():
    """Fine leaflets in flat layers."""
    return clumps(491, 4, 1.9, ACACIA_LEAF, stretch=(0.72, 1.35))


def sprays(seed: int, colors: list, marks: tuple, grid: int, mean: tuple) -> Image:
    """Small drawings of needles laid over each other, the dark ones first; letters a to f are a ramp's."""
    image, points = Image(), scattered(seed, grid, grid, 0.7)
    order = sorted(range(len(points)), key=lambda number: hash01(seed + 1, number))
    for depth, number in enumerate(order):
        shift = -2 if 3 * depth < len(order) else -1 if 3 * depth < 2 * len(order) else 0
        key = {letter: colors[max(0, k + shift)] for k, letter in enumerate("abcdef")}
        left, top = (int(c // 1) for c in points[number])
        image.stamp(left - 3, top - 2, marks[int(len(marks) * hash01(seed + 2, number))], key)
    return settled(bled(image), mean)


def spruce_leaves():
    """Twigs hang to both sides and carry short needles: drooping fans."""
    fans = ("...e... ..ded.. .dcdcd. dc.c.cb c..b..b", "...e.. ..dedc .dcdcb c.c.cb ..b..b")
    return sprays(481, SPRUCE_LEAF, fans, 5, (47, 88, 66))


def pine_leaves():
    """Long needles stand around the end of each twig, as stars."""
    stars = ("e..f..d .e.e.d. ..ded.. cdcccbb ..cbb.. .c.b.a. c..b..a", ".e..d. e.ed.c .edc.. dccbba ..cba. .c.b.a")
    return sprays(487, PINE_LEAF, stars, 4, (66, 108, 60))


def willow_leaves():
    """Strands of narrow leaves that hang, with gaps between them."""
    def shade(x, y):
        strand = (x + int(1.6 * smooth(502, x, y, 4, 2))) % SIZE
        phase = (y + int(SIZE * hash01(503, strand))) % SIZE
        if hash01(504, strand) < 0.75 and phase % 8 < 2 + 3 * hash01(505, strand, phase // 8):
            return None
        light = (0.85, 0.62, 0.42)[(y + 2 * strand) % 3] + 0.35 * (hash01(506, strand) - 0.5)
        return tone(WILLOW_LEAF, light - 0.15)
    return bled(Image(shade))


def palm_leaves():
    """Fronds laid over each other: leaflets stand aslant on both sides of a rib that is light."""
    fronds = ("e.....d. fe..ed.. .fe.dc.. ..ffc... eddfecc. .cc.fdb. .b..cfb. b...b.fb",
              ".d.....e ..de..ef ..cd.ef. ...cff.. .ccefdde .bdf.cc. .bfc..b. bf.b...b")
    return sprays(515, PALM_LEAF, fronds, 4, (92, 146, 66))


def maple_leaves():
    """Leaves of three points, laid over each other."""
    leaves = ("..e.... .e.f.e. ..efe.. feefeed .deedc. ..cdb.. ...c...", "...e... .f.e.d. eefeedd .deedc. d.cdc.b ...b...",
              "e..f.. .eefed ..feed feedc. .dc.cb ..b...")
    return sprays(701, MAPLE_LEAF, leaves, 4, (190, 80, 36))


def aspen_leaves():
    """Small round leaves that hang apart."""
    return clumps(711, 6, 1.35, ASPEN_LEAF, slope=0.14)


def cherry_leaves():
    """Blossoms of five petals in bunches, a few dark twigs between them."""
    flowers = (".ef.. feefe .fafe .efee .e.f.", "..fe. .feef efaee eefe. .fe..", ".e.f. eefee .eafe .fee.")
    image = sprays(721, BLOSSOM, flowers, 5, (226, 168, 190))
    for x, y in ALL:
        if image[x, y][3] and hash01(725, x, y) < 0.035:
            image[x, y] = TWIG[1]
    return image


def fir_leaves():
    """Flat twigs with short needles on both sides of a rib."""
    twigs = ("d.e.d.. .dedc.. dddfddd .cdedb. c.ced.b ..c.b..", "..d.e.d ..cded. ddfdddc .dedcb. c.dcb.b ..b.c..")
    return sprays(731, FIR_LEAF, twigs, 5, (44, 84, 80))


def olive_leaves():
    """Narrow leaves, aslant both ways, some with their silver side up."""
    leaves = ("....fe ...fe. ..fd.. .ed... dc....", "fe.... .fe... ..ed.. ...dc. ....cb", "..e. .fe. .ed. .dc. .c..", "ffed.. ..ddcb")
    return sprays(741, OLIVE_LEAF, leaves, 5, (128, 140, 108))


def kapok_leaves():
    """Broad pointed leaves that shine, each with a light rib."""
    leaves = ("...d.... ..dfd... .ddfed.. ddefeddc .dcfedcc ..ccecb. ...cb...", "....d... ...efd.. ..defdd. .ddefddc cdcefcc. .bccdb.. ..bc....")
    return sprays(751, KAPOK_LEAF, leaves, 4, (52, 106, 50))


def pale_log_side():
    """Smooth bark that comes off in upright patches; the wood below it is warmer. Short lines across it."""
    def shade(x, y):
        patch = smooth(761, x, y, 4, 2) * 0.7 + smooth(762, x, y, 8, 4) * 0.3
        colors = PEELED if patch > 0.6 else PALE_BARK
        rim = -0.22 if patch <= 0.6 < smooth(761, x - 1, y, 4, 2) * 0.7 + smooth(762, x - 1, y, 8, 4) * 0.3 else 0
        return tone(colors, 0.55 + 0.35 * (smooth(763, x, y, 6, 2) - 0.5) + 0.1 * (hash01(764, x, y) - 0.5) + rim)
    image = Image(shade)
    for left, top, width in ((2, 2, 3), (9, 5, 2), (13, 9, 3), (5, 11, 2), (10, 14, 3)):
        image.stamp(left, top, "k" * width, {"k": PALE_BARK[0]})
    return settled(image, (184, 177, 164), 0.6)


def bamboo_side():
    """A cane: round in light, a node with its ring once a block, dark below it."""
    def shade(x, y):
        across = (0.2, 0.42, 0.6, 0.74, 0.82, 0.74, 0.62, 0.48)[(x - 4) % 8]
        ring = {2: 0.24, 3: -0.42, 4: -0.14}.get(y, 0.0)
        return tone(CANE, across + ring + 0.12 * (smooth(771, x, y, 16, 2) - 0.5) + 0.05 * (hash01(772, x, y) - 0.5))
    return settled(Image(shade), (132, 162, 66), 0.2)


def bamboo_top():
    """The end of a cane: a rim around a hollow."""
    def shade(x, y):
        radius = max(abs(x - 7.5), abs(y - 7.5))
        if radius > 3:
            return tone(CANE, 0.62)
        if radius > 2:
            return tone(CREAM, 0.7)
        return tone(CANE, 0.05 + 0.08 * hash01(775, x, y))
    return Image(shade)


# --- Soil and rock ------------------------------------------------------------------------------------------

def moss():
    return settled(cobbles(Patches(527, 5, 4, 1.0, 0.2, 0.9), MOSS, spread=0.3, gap=0.12, lit=0.1), (84, 106, 46))


def mossy_stone(rock: Image) -> Image:
    """Moss in the stone's hollows, with a shadow below its rim."""
    cover = moss()

    def share(x, y):
        return smooth(531, x % SIZE, y % SIZE, 4, 4) * 0.65 + smooth(532, x % SIZE, y % SIZE, 8, 8) * 0.35

    def shade(x, y):
        if share(x, y) > 0.5:
            return cover[x, y][:3]
        return mix(rock[x, y][:3], (30, 34, 22), 0.35 if share(x, y - 1) > 0.5 else 0.0)
    return settled(Image(shade), (108, 116, 84), 0.5)


def gravel():
    """Rounded pebbles of three kinds of rock."""
    patches = Patches(541, 5, 5, 0.75, 0.1, 0.9)

    def shade(x, y):
        cell, (u, v) = patches.cell[x, y], patches.offset[x, y]
        colors = PEBBLE[int(3 * hash01(545, cell))]
        value = 0.56 + 0.3 * (hash01(546, cell) - 0.5) - 0.35 * (u + v) + 0.1 * (hash01(547, x, y) - 0.5)
        return tone(colors, value - (0.3 if patches.gap(x, y) else 0))
    return settled(Image(shade), (128, 122, 114))


def clay():
    def shade(x, y):
        layer = smooth(551, x, y, 2, 8) * 0.6 + smooth(552, x, y, 4, 16) * 0.4
        return tone(CLAY, 0.22 + 0.56 * layer + 0.1 * (hash01(553, x, y) - 0.5))
    return settled(Image(shade), (164, 170, 180))


def mud():
    """Soft lumps with wet lights."""
    lumps = cobbles(Patches(561, 3, 4, 0.9, 0.1, 0.9), MUD, spread=0.3, gap=0.12, lit=0.08)

    def shade(x, y):
        wet = smooth(565, x, y, 8, 8) > 0.8
        return mix(lumps[x, y][:3], (118, 110, 98), 0.4) if wet else lumps[x, y][:3]
    return settled(Image(shade), (76, 61, 48))


def ice():
    """Cracks run through it as pale lines: where bent waves meet."""
    def shade(x, y):
        u, v = (2 * math.pi * a / SIZE for a in (x, y))
        waves = math.sin(u + 2 * v + 1.3 * math.sin(u)) + math.sin(2 * u - v + 1.6 * math.sin(v + 2))
        crack = max(0.0, 1 - 3.2 * abs(waves))
        depth = smooth(571, x, y, 4, 4)
        return tone(ICE, 0.3 + 0.3 * depth + 0.26 * crack + 0.06 * (hash01(572, x, y) - 0.5))
    return settled(Image(shade), (178, 208, 236), 0.9)


def strata(seed: int, colors: list, mean: tuple, layers: tuple) -> Image:
    """Layers of rock (height, tone), the upper rim of each lit, the lower in shadow; they bend a little."""
    rows = [(step, height, value) for height, value in layers for step in range(height)]
    assert len(rows) == SIZE

    def shade(x, y):
        step, height, value = rows[(y + int(1.6 * smooth(seed, x, 0, 4, 1))) % SIZE]
        rim = 0.12 if step == 0 else -0.16 if step == height - 1 and height > 1 else 0
        grain = 0.24 * (smooth(seed + 1, x, y, 5, 16) - 0.5) + 0.1 * (hash01(seed + 2, x, y) - 0.5)
        return tone(colors, value + rim + grain)
    return settled(Image(shade), mean, 0.55)


def slab(seed: int, colors: list, mean: tuple) -> Image:
    """The top of layered rock: wide flat pieces, hardly parted."""
    return settled(cobbles(Patches(seed, 2, 3, 0.9, 0.5, 0.9), colors, spread=0.2, gap=0.14, lit=0.06), mean)


def sandstone_side():
    return strata(581, SANDSTONE, (192, 165, 120), ((4, 0.6), (2, 0.42), (5, 0.66), (1, 0.3), (4, 0.52)))


def red_sandstone_side():
    return strata(585, RED_SANDSTONE, (158, 80, 43), ((3, 0.62), (4, 0.46), (1, 0.24), (5, 0.6), (3, 0.42)))


def terracotta():
    return strata(589, TERRACOTTA, (196, 146, 114), ((5, 0.55), (3, 0.66), (4, 0.48), (4, 0.6)))


def basalt_side():
    """Upright columns, each with its own tone, broken across here and there."""
    def shade(x, y):
        column = (x + int(1.4 * smooth(591, x, y, 2, 2))) % SIZE // 4
        across = (x + int(1.4 * smooth(591, x, y, 2, 2))) % 4
        value = (0.78, 0.56, 0.46, 0.12)[across] + 0.2 * (hash01(592, column) - 0.5)
        joint = (y + int(SIZE * hash01(593, column))) % SIZE
        value -= 0.3 if joint == 0 else -0.1 if joint == 1 else 0
        return tone(BASALT, value + 0.12 * (hash01(594, x, y) - 0.5))
    return settled(Image(shade), (60, 60, 66))


def basalt_top():
    return settled(cobbles(Patches(597, 3, 4, 0.25, 0.0, 0.0), BASALT, spread=0.24, gap=0.3, lit=0.14), (80, 80, 84))


def limestone():
    """Pale beds with fine upright cracks."""
    return settled(cobbles(Patches(607, 2, 4, 0.9, 0.5, 0.9), LIMESTONE, spread=0.24, gap=0.15, lit=0.1),
                   (194, 189, 174))


# --- Plants -------------------------------------------------------------------------------------------------

def blades(rows: tuple, colors: list) -> Image:
    """Blades (x, height, lean): upright from the bottom row, lighter to the tip, which bends aside."""
    image = Image()
    for x, height, lean in rows:
        for step in range(height):
            share = step / max(1, height - 1)
            bend = lean if share > 0.8 else int(lean / 2) if share > 0.5 else 0
            image[x + bend, SIZE - 1 - step] = tone(colors, 0.1 + 0.85 * share)
    return bled(image)


def tall_grass():
    greens = [mix(a, b, 0.5) for a, b in zip(GRASS, BLADE)]
    return blades(((0, 7, 0), (1, 11, -1), (2, 9, 0), (3, 14, 2), (4, 8, 0), (5, 15, -1), (6, 10, 0), (7, 13, 2),
                   (8, 16, 0), (9, 9, 0), (10, 14, -2), (11, 11, 2), (12, 15, 1), (13, 8, 0), (14, 12, -1),
                   (15, 6, 0)), greens)


def savanna_grass():
    return blades(((0, 6, 0), (1, 9, -1), (3, 13, -2), (4, 7, 0), (5, 10, 2), (6, 15, -1), (8, 12, 2), (9, 7, 0),
                   (10, 16, 1), (11, 9, -2), (12, 13, 2), (14, 10, 1), (15, 5, 0)), DRY)


def fern():
    """Fronds that rise and bend over; leaflets stand on both sides and get shorter to the tip."""
    fronds = (".......f........ ......fee....... ..f..e.fe.d..f.. .fee..efd...fed. ..fdedeeddcdfd.. .e..dfdfdcdfd.c. "
              "fed..dfedcfd.cdd .dee.cfedfd.cdc. ..dfe.cfefc.fd.. e..dfecfefccfd.. dd..dffefecfd..c .dcc.cfeefcfc.cc "
              "..cdc.cfefc.cc.. ...ccfdfefdcb... ....bccfecbb.... ......bdcb......")
    return bled(Image().stamp(0, 0, fronds, dict(zip("bcdef", FERN))))


def reeds():
    """Stalks as high as the block, some with brown spikes."""
    image = blades(((1, 10, -1), (2, 14, 0), (4, 16, 0), (5, 9, 1), (7, 13, -1), (8, 16, 0), (10, 11, 0),
                    (11, 15, 1), (13, 16, 0), (14, 10, 1)), REED)
    for x, top in ((4, 1), (8, 3), (13, 0)):
        image.stamp(x - 1, top, ".t. .bs .bs .bs .ds .d.", {"t": REED[4], "b": TWIG[3], "s": TWIG[1], "d": TWIG[0]})
    return image


def heather():
    """A low bush of twigs under spikes of small flowers."""
    image = blades(((2, 6, 0), (4, 8, 0), (6, 7, 0), (7, 9, 0), (9, 8, 0), (11, 9, 0), (13, 6, 0)),
                   [mix(a, b, 0.5) for a, b in zip(STEM, TWIG)])
    spike = "..f. .ed. .dce ecd. .dcb ccb. .ba."
    for left, top in ((0, 8), (11, 8), (5, 7), (8, 5), (2, 5)):
        image.stamp(left, top, spike, dict(zip("abcdef", HEATHER)))
    return bled(Image(lambda x, y: image[x, y] if image[x, y][3] else None))


def dead_bush():
    twigs = ("a......a....b... .a..b..a...b..a. .ba..b.ab.b..ab. ..bb..bb.cb.bb.. b..cb..bc.bcb..b "
             ".bb.cc.c.bcb..b. ...bbcbcccb.cb.. .....ccccc.cb... ..bb..cdcccb.... ....bccddc...... "
             "......cdd....... ......cdd.......")
    return bled(Image().stamp(0, 4, twigs, dict(zip("abcd", (TWIG[5], TWIG[4], TWIG[3], TWIG[1])))))


def bluebell():
    image = Image()
    for y in range(4, SIZE):
        image[7 + (1 if y < 8 else 0), y] = STEM[3] if y % 3 else STEM[2]
    image.stamp(3, 11, "d....... cd...d.d cb..d.c. .bc.cdc. ..bcccb.", dict(zip("bcd", STEM[1:])))
    for left, top in ((8, 2), (4, 4), (9, 5), (4, 8), (10, 9)):
        image.stamp(left, top, "cd. bcd bab", dict(zip("abcd", BELL)))
    return bled(image)


def crystal():
    """Three prisms of light; their edges shine in full, their feet little."""
    rows = ("......f......... .....efe........ .....edf..f..... .....ede.efd.... .....edd.edd.... "
            "....eedd.edd.... .f..eddcced..... efd.eddcced.... eddceddccdd..e.. eddceddccddcefd. "
            ".ddcedcccdccedd. .dccddccbdccedc. ..ccddcbbdccddc. ..cbdccbbccbdc.. ...bccbbbbbbcb.. ...abbaaaabba...")
    key = {letter: (*color, alpha) for letter, color, alpha in
           zip("abcdef", QUARTZ, (NO_GLOW, 150, 180, 205, 230, 255))}
    return bled(Image().stamp(0, 0, " ".join(row[:16] for row in rows.split()), key))


def lava():
    """Plates of a dark skin that drift apart; what shows between them glows."""
    plates = Patches(651, 3, 3, 0.8, 0.5, 0.8)

    def shade(x, y):
        heat = 0.62 + 0.5 * (smooth(653, x, y, 4, 4) - 0.5) + (0.35 if plates.gap(x, y) else 0)
        color = tone(LAVA, heat + 0.08 * (hash01(654, x, y) - 0.5))
        return (*color[:3], round(255 * max(0.35, min(1.0, heat))))
    return Image(shade)


def crystal_rock():
    """Facets of a dense druse, each lit its own way; the brightest glow."""
    facets = Patches(661, 4, 4, 0.9, 0.5, 0.7)

    def shade(x, y):
        u, v = facets.offset[x, y]
        tilt = hash01(662, facets.cell[x, y]) - 0.5
        light = 0.5 + 0.6 * tilt + 0.9 * (u * tilt - v * 0.5) - (0.25 if facets.gap(x, y) else 0)
        color = mix(tone(QUARTZ, light)[:3], (150, 90, 200), 0.35)
        return (*color[:3], round(150 * max(0.0, min(1.0, light))))
    return Image(shade)


def ore(rock, colors):
    """Rock with angular grains."""
    key = dict(zip("abcdef", colors))
    image = Image(lambda x, y: rock[x, y])
    for left, top, rows in ((1, 2, ".cd. bded acdc .ab."), (9, 1, ".de. bcd. .ab."), (5, 8, ".dc.. bedca .acb."),
                            (12, 9, ".d bec ab."), (1, 11, "dc bea .b"), (9, 13, "cde bc.")):
        image.stamp(left, top, rows, key)
    return image


# --- Sea and giant mushrooms --------------------------------------------------------------------------------

def coral_red():
    """The ridges of a brain coral: level lines of a soft field."""
    def shade(x, y):
        ridge = abs(2 * (2.4 * smooth(619, x, y, 6, 6) % 1) - 1)
        return tone(RED_CORAL, 0.1 + 0.72 * ridge + 0.08 * (hash01(611, x, y) - 0.5))
    return settled(Image(shade), (196, 66, 68))


def coral_yellow():
    """Polyps: small cups beside each other, lit from the upper left."""
    cups = Patches(615, 4, 4, 0.45, 0.0, 0.9)

    def shade(x, y):
        u, v = cups.offset[x, y]
        reach = math.hypot(u, v)
        rim = 0.3 if reach < 0.22 else 0.68 if reach < 0.42 else 0.45
        return tone(YELLOW_CORAL, rim - 0.28 * (u + v) - (0.2 if cups.gap(x, y) else 0))
    return settled(Image(shade), (206, 160, 56))


def seagrass():
    """A meadow on the sea floor from above: leaves that lie with the current."""
    def shade(x, y):
        strand = (3 * y + x + int(3 * smooth(621, x, y, 3, 3))) // 2
        light = 0.5 + 0.5 * (hash01(622, strand % 24, (x + y // 3) // 4 % 4) - 0.5)
        return tone(SEAGRASS, light + 0.14 * (hash01(623, x, y) - 0.5))
    return settled(Image(shade), (62, 118, 78))


def mushroom_stem():
    def shade(x, y):
        return tone(GILL, 0.5 + 0.6 * (smooth(631, x, y, 8, 2) - 0.5) + 0.12 * (hash01(632, x, y) - 0.5))
    return settled(Image(shade), (208, 194, 168))


def mushroom_cap():
    """Pale flakes on a soft red skin."""
    image = Image(lambda x, y: tone(CAP, 0.5 + 0.4 * (smooth(641, x, y, 4, 4) - 0.5) + 0.1 * (hash01(642, x, y) - 0.5)))
    for left, top, rows in ((2, 1, ".ww. wwwq .wqq"), (10, 4, "ww. wwq .qq"), (5, 9, ".w. wwq qq."), (13, 11, "wwq wqq"),
                            (9, 14, "wq"), (1, 7, "wq")):
        image.stamp(left, top, rows, {"w": CREAM[5], "q": CREAM[3]})
    return settled(image, (170, 80, 60), 0.3)


TEXTURES = {
    "birch_log_side": (birch_log_side, "opaque", True),
    "birch_log_top": (lambda: rings(birch_log_side(), 405, PALE_WOOD), "opaque", True),
    "birch_leaves": (birch_leaves, "test", True),
    "spruce_log_side": (spruce_log_side, "opaque", True),
    "spruce_log_top": (lambda: rings(spruce_log_side(), 415, WOOD, 1.6), "opaque", True),
    "spruce_leaves": (spruce_leaves, "test", True),
    "pine_log_side": (pine_log_side, "opaque", True),
    "pine_log_top": (lambda: rings(pine_log_side(), 425, PALE_WOOD, 2.6), "opaque", True),
    "pine_leaves": (pine_leaves, "test", True),
    "acacia_log_side": (acacia_log_side, "opaque", True),
    "acacia_log_top": (lambda: rings(acacia_log_side(), 435, RED_WOOD), "opaque", True),
    "acacia_leaves": (acacia_leaves, "test", True),
    "willow_log_side": (willow_log_side, "opaque", True),
    "willow_log_top": (lambda: rings(willow_log_side(), 445, WOOD, 2.4), "opaque", True),
    "willow_leaves": (willow_leaves, "test", True),
    "palm_log_side": (palm_log_side, "opaque", True),
    "palm_log_top": (palm_log_top, "opaque", True),
    "palm_leaves": (palm_leaves, "test", True),
    "dead_log_side": (dead_log_side, "opaque", True),
    "dead_log_top": (lambda: rings(dead_log_side(), 465, GREY_WOOD, 2.0, 0.4), "opaque", True),
    "maple_leaves": (maple_leaves, "test", True),
    "aspen_leaves": (aspen_leaves, "test", True),
    "cherry_leaves": (cherry_leaves, "test", True),
    "fir_leaves": (fir_leaves, "test", True),
    "olive_leaves": (olive_leaves, "test", True),
    "kapok_leaves": (kapok_leaves, "test", True),
    "pale_log_side": (pale_log_side, "opaque", True),
    "pale_log_top": (lambda: rings(pale_log_side(), 767, PALE_WOOD, 2.2), "opaque", True),
    "bamboo_side": (bamboo_side, "opaque", False),
    "bamboo_top": (bamboo_top, "opaque", False),
    "moss": (moss, "opaque", True),
    "gravel": (gravel, "opaque", True),
    "clay": (clay, "opaque", True),
    "mud": (mud, "opaque", True),
    "ice": (ice, "opaque", True),
    "sandstone_side": (sandstone_side, "opaque", True),
    "sandstone_top": (lambda: slab(583, SANDSTONE, (210, 187, 144)), "opaque", True),
    "red_sandstone_side": (red_sandstone_side, "opaque", True),
    "red_sandstone_top": (lambda: slab(587, RED_SANDSTONE, (176, 96, 55)), "opaque", True),
    "terracotta": (terracotta, "opaque", True),
    "basalt_side": (basalt_side, "opaque", True),
    "basalt_top": (basalt_top, "opaque", True),
    "limestone": (limestone, "opaque", True),
    "tall_grass": (tall_grass, "test", False),
    "savanna_grass": (savanna_grass, "test", False),
    "fern": (fern, "test", False),
    "reeds": (reeds, "test", False),
    "heather": (heather, "test", False),
    "dead_bush": (dead_bush, "test", False),
    "bluebell": (bluebell, "test", False),
    "crystal": (crystal, "test+glow", False),
    "lava": (lava, "glow", True),
    "crystal_rock": (crystal_rock, "glow", True),
    "coral_red": (coral_red, "opaque", True),
    "coral_yellow": (coral_yellow, "opaque", True),
    "seagrass": (seagrass, "opaque", True),
    "mushroom_stem": (mushroom_stem, "opaque", True),
    "mushroom_cap": (mushroom_cap, "opaque", True),
}
