"""Textures of blocks that people build with: boards, masonry, glass, wool, fittings. Used by paint_textures.py."""
from texture_tools import (BARK, GOLD, IRON, SIZE, STONE, WOOD, Image, Patches, bled, cobbles, hash01, mix, ramp,
                           settled, smooth, tone)

# From shadow to light, the cut wood of each tree.
BOARDS = {
    "oak": WOOD,
    "birch": ramp("a08a5e b69f70 c8b284 d6c296 e2d1a8 eadcb8"),
    "spruce": ramp("54391f 664728 775432 86613c 946e47 a27b53"),
    "pine": ramp("8c5a2e a16b39 b57c46 c58c54 d29b63 dcaa74"),
    "acacia": ramp("8a4423 9e5029 b05d31 bf6a3b cb7846 d58755"),
    "willow": ramp("5f5c39 716e47 827f55 928f63 a19e72 b0ad82"),
    "palm": ramp("a9834a be975b cfa96c dcb97d e6c78e eed49f"),
}
CLAY = ramp("6a2f22 7d3828 8f4330 a04e39 b05b44 c06a51")
MORTAR = (176, 166, 148)
COLORS = {
    "white": (226, 226, 220),
    "red": (170, 44, 38),
    "orange": (216, 122, 36),
    "yellow": (230, 196, 66),
    "green": (84, 128, 44),
    "cyan": (38, 130, 138),
    "blue": (54, 74, 160),
    "purple": (116, 54, 152),
    "brown": (108, 72, 42),
    "black": (34, 34, 38),
}
GLASS_COLORS = ("white", "red", "orange", "yellow", "green", "blue", "purple")


def scaled(color: tuple, share: float) -> tuple:
    return tuple(max(0, min(255, round(c * share))) for c in color)


# --- Wood --------------------------------------------------------------------------------------------------

def boards(colors: list, seed: int) -> Image:
    """Four boards, each with its own tone and grain; joints are staggered."""
    def shade(x, y):
        board = y // 4
        if y % 4 == 3 or (x + 7 * board + 3) % SIZE == 0:
            return mix(colors[0], (0, 0, 0), 0.15)
        grain = smooth(seed + board, x, y, 3, 16) - 0.5
        light = 0.06 if y % 4 == 0 else 0
        return tone(colors, 0.5 + light + 0.25 * (hash01(seed + 9, board) - 0.5) + 0.5 * grain)
    return Image(shade)


def ladder() -> Image:
    def shade(x, y):
        if x in (2, 3, 12, 13):
            return tone(WOOD, 0.35 + 0.3 * (x % 2) + 0.2 * (hash01(701, x, y) - 0.5))
        if y % 4 in (1, 2) and 1 < x < 14:
            return tone(WOOD, (0.7 if y % 4 == 1 else 0.3) + 0.15 * (hash01(702, x, y) - 0.5))
        return None
    return bled(Image(shade))


def door(has_window: bool) -> Image:
    """Upright boards in a frame; hinges at the left, and a handle below or a window of four panes above."""
    def shade(x, y):
        if x in (0, 15) or (y == 0 and has_window) or (y == 15 and not has_window):
            return tone(WOOD, 0.15 + 0.1 * hash01(711, x, y))
        if has_window and 3 <= x <= 12 and 3 <= y <= 10:
            is_bar = x in (3, 7, 8, 12) or y in (3, 10) or y == 6
            return tone(WOOD, 0.1) if is_bar else mix((150, 190, 205), (200, 226, 232), hash01(712, x, y))
        if x % 5 == 0:
            return tone(WOOD, 0.05)
        return tone(WOOD, 0.45 + 0.4 * (smooth(713 + x // 5, x, y, 16, 3) - 0.5))
    image = Image(shade)
    image.stamp(1, 12 if has_window else 3, "iiii", {"i": IRON[1]})
    if not has_window:
        image.stamp(12, 1, "gg gk", {"g": GOLD[3], "k": IRON[0]})
    return image


def bookshelf() -> Image:
    colors = [(122, 44, 36), (52, 78, 120), (66, 104, 58), (142, 108, 48), (98, 60, 112), (60, 60, 66)]

    def shade(x, y):
        if y % 8 == 7 or x in (0, 15):
            return tone(WOOD, 0.55 + 0.2 * (hash01(721, x, y) - 0.5))
        book = (x - 1) // 2 + 7 * (y // 8)
        if y % 8 < 1 + int(3 * hash01(722, book)):
            return tone(BARK, 0.05)
        band = 1.25 if y % 8 == 4 else 1.0
        return scaled(colors[int(6 * hash01(723, book))], band * (0.85 + 0.3 * ((x - 1) % 2)))
    return Image(shade)


def workbench(is_top: bool) -> Image:
    """Boards with a frame; on the top a grid, on the sides tools."""
    planks = boards(BOARDS["oak"], 640)

    def shade(x, y):
        color = planks[x, y][:3]
        is_frame = x in (0, 15) or y in (0, 15)
        is_line = is_top and (x in (5, 10) or y in (5, 10)) or not is_top and y == 4
        is_tool = not is_top and (x in (4, 11) and 6 < y < 13 or y in (7, 8) and x in (3, 5, 10, 12))
        return scaled(color, 0.45 if is_tool else 0.6 if is_frame else 0.75 if is_line else 1)
    return Image(shade)


# --- Masonry -----------------------------------------------------------------------------------------------

def cobble() -> Image:
    image = cobbles(Patches(741, 4, 4, 0.8, 0.1, 0.25), STONE, 0.6, 0.9)
    return settled(image, (122, 120, 116))


def courses(width: int, height: int, colors: list, joint: tuple, seed: int) -> Image:
    """Stones of one size, every other course moved by half a stone, lit from above."""
    def shade(x, y):
        row = y // height
        along = x + (row % 2) * width // 2
        if y % height == height - 1 or along % width == width - 1:
            return scaled(joint, 0.94 + 0.12 * hash01(seed, x, y))
        stone = (along // width) % (SIZE // width)
        edge = 0.12 if y % height == 0 else -0.08 if y % height == height - 2 else 0
        value = 0.5 + edge + 0.35 * (hash01(seed + 1, stone, row) - 0.5) + 0.3 * (hash01(seed + 2, x, y) - 0.5)
        return tone(colors, value)
    return Image(shade)


def smooth_stone() -> Image:
    def shade(x, y):
        return tone(STONE, 0.62 + 0.22 * (smooth(761, x, y, 8, 8) - 0.5) + 0.12 * (hash01(762, x, y) - 0.5))
    return settled(Image(shade), (140, 138, 134))


def roof_tiles() -> Image:
    """Courses of rounded tiles that overlap: each hangs lower in its middle."""
    def shade(x, y):
        row = y // 4
        across = (x + 2 * (row % 2)) % 4
        depth = (y % 4) / 3
        round_off = (0.0, 0.18, 0.14, -0.14)[across]
        if across == 3 and y % 4 == 3:
            return CLAY[0]
        value = 0.35 + 0.35 * depth + round_off + 0.2 * (hash01(771, (x + 2 * (row % 2)) // 4, row) - 0.5)
        return tone(CLAY, value - (0.35 if y % 4 == 0 else 0))
    return Image(shade)


def straw(colors: list, seed: int, is_upright: bool) -> Image:
    def shade(x, y):
        across, along = (x, y) if is_upright else (y, x)
        value = 0.5 + 0.55 * (hash01(seed, across) - 0.5) + 0.4 * (smooth(seed + 1, across, along, 16, 4) - 0.5)
        return tone(colors, value)
    return Image(shade)


STRAW = ramp("7c6130 957739 aa8b45 bd9f53 cdb162 dcc374")
HAY = ramp("9c7c22 b4922c c8a638 d8b848 e6c95a f0d870")


def hay_side() -> Image:
    image = straw(HAY, 791, False)
    for y in range(SIZE):
        for x in (3, 12):
            image[x, y] = mix((112, 60, 34), (150, 84, 50), hash01(793, x, y))
    return image


def hay_top() -> Image:
    def shade(x, y):
        return tone(HAY, 0.45 + 0.8 * (hash01(794, x, y) - 0.5))
    return settled(Image(shade), (206, 174, 72))


def plaster() -> Image:
    def shade(x, y):
        return scaled((226, 218, 202), 0.97 + 0.06 * smooth(781, x, y, 5, 5) - 0.04 * hash01(782, x, y))
    return Image(shade)


def iron() -> Image:
    def shade(x, y):
        rivet = (x % 8 in (1, 6)) and (y % 8 in (1, 6))
        seam = 0.75 if x % 8 == 7 or y % 8 == 7 else 1.0
        return scaled((96, 98, 104), seam * ((1.3 if rivet else 1.0) + 0.1 * (hash01(783, x, y) - 0.5)))
    return Image(shade)


# --- Glass and wool ----------------------------------------------------------------------------------------

def glass() -> Image:
    """A pale frame and two glints; the rest is hole."""
    def shade(x, y):
        if x in (0, 15) or y in (0, 15):
            return scaled((196, 220, 224), 0.95 + 0.1 * hash01(801, x, y))
        if (x + y in (9, 10) and 2 < x < 7) or (x + y == 21 and 9 < x < 13):
            return 226, 240, 242
        return None
    return bled(Image(shade))


def colored_glass(color: tuple) -> Image:
    def shade(x, y):
        is_frame = x in (0, 15) or y in (0, 15)
        return (*scaled(color, 1.0 if is_frame else 1.1), 210 if is_frame else 120)
    return Image(shade)


def wool(color: tuple, seed: int) -> Image:
    """Tufts in staggered rows."""
    def shade(x, y):
        tuft = (x + 2 * (y // 2 % 2)) % 4
        value = 1.06 - 0.09 * (tuft == 3) - 0.1 * (y % 2) + 0.12 * (hash01(seed, x, y) - 0.5)
        return scaled(color, value)
    return Image(shade)


# --- Light -------------------------------------------------------------------------------------------------

def torch() -> Image:
    """The stick is the middle two columns; its flame lies eight and nine texels over the bottom."""
    def shade(x, y):
        height = SIZE - 1 - y
        if height >= 8:
            return (255, 214, 120, 255) if height >= 9 else (255, 160, 60, 220)
        return (*tone(WOOD, 0.25 + 0.3 * (x % 2) + 0.2 * (hash01(821, x, y) - 0.5)), 0)
    return Image(shade)


def lantern(is_top: bool) -> Image:
    """Warm panes between iron bars; the lantern is the six texels in the middle."""
    def shade(x, y):
        height = SIZE - 1 - y
        is_bar = x in (5, 10) or (y in (5, 10) if is_top else height in (0, 7, 8, 9))
        if is_bar or is_top and (x < 5 or x > 10):
            return (*scaled((70, 66, 66), 0.9 + 0.2 * hash01(831, x, y)), 0)
        warm = mix((255, 176, 80), (255, 232, 160), 1 - min(1, abs(x - 7.5) / 3))
        return (*warm, 255)
    return Image(shade)


TEXTURES = {
    **{f"{wood}_planks": (lambda c=colors, s=31 * k: boards(c, 640 + s), "opaque", True)
       for k, (wood, colors) in enumerate(BOARDS.items())},
    "workbench_top": (lambda: workbench(True), "opaque", False),
    "workbench_side": (lambda: workbench(False), "opaque", False),
    "ladder": (ladder, "test", True),
    "door_lower": (lambda: door(False), "opaque", False),
    "door_upper": (lambda: door(True), "opaque", False),
    "bookshelf_side": (bookshelf, "opaque", True),
    "cobble": (cobble, "opaque", True),
    "stone_bricks": (lambda: courses(8, 8, STONE, (92, 90, 88), 751), "opaque", True),
    "bricks": (lambda: courses(8, 4, CLAY, MORTAR, 755), "opaque", True),
    "smooth_stone": (smooth_stone, "opaque", True),
    "roof_tiles": (roof_tiles, "opaque", True),
    "thatch": (lambda: straw(STRAW, 785, True), "opaque", True),
    "hay_side": (hay_side, "opaque", True),
    "hay_top": (hay_top, "opaque", True),
    "plaster": (plaster, "opaque", True),
    "iron": (iron, "opaque", True),
    "glass": (glass, "test", True),
    **{f"{name}_glass": (lambda c=COLORS[name]: colored_glass(c), "blend", True) for name in GLASS_COLORS},
    **{f"{name}_wool": (lambda c=color, s=k: wool(c, 811 + s), "opaque", True)
       for k, (name, color) in enumerate(COLORS.items())},
    "torch": (torch, "glow", False),
    "lantern_side": (lambda: lantern(False), "glow", False),
    "lantern_top": (lambda: lantern(True), "glow", False),
}
