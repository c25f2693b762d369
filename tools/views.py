#!/usr/bin/python3
"""Finds cameras for kinds of views (a skyline at dawn, a waterfall from its foot …) and prints commands that draw them.

tools/views.py [KIND …] [--seed N] [--radius BLOCKS] [--images FOLDER]   # after cmake --build build --target terrane_python

For each kind of the table KINDS, places with the wanted subject are found in heights, biomes and blocks of the land.
Around each, cameras are tried on a coarse image of depths that is computed from the heights alone. The best are drawn
as small images, and those with the best scores are printed. The same arguments give the same cameras.
Needs NumPy and, for --images, Pillow (Debian: python3-numpy python3-pil)."""
import argparse
import dataclasses
import math
import pathlib
import sys
import typing

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
FIELD_OF_VIEW = 70  # degrees, vertical; as terrane render has it
COLUMNS, ROWS = 96, 54  # of images of depths
FAR = 16384
BANDS = (0, 60, 250, 1000, 4000, FAR)  # blocks: depths that an image should show side by side
THUMBNAIL = (320, 180)
CAVE_ROWS = 32  # and columns: rays through blocks are slower
CAVE_REACH = 112  # blocks from the middle of a room


# Land -----------------------------------------------------------------------------------------------------------------


class Land:
    """A square of land in columns `step` blocks wide; arrays are [y, x]."""

    def __init__(self, world, center, radius, step):
        x, y = (int(v) // step * step for v in center)
        self.x0, self.y0, self.step, self.cells = x - radius, y - radius, step, 2 * radius // step
        area = (self.x0, self.y0, x + radius, y + radius)
        self.top = world.heights(area, step).astype(np.float32)
        self.block = world.surface(area, step)
        self.biome = world.biomes(area, step)
        names, biomes = world.block_names, world.biome_names
        self.sea_biomes = {"deep ocean", "ocean", "kelp forest", "reef"}
        self.is_water = np.isin(self.block, [k for k, name in enumerate(names) if name in ("water", "white_water", "ice")])
        self.numbers = {name: k for k, name in enumerate(biomes)}
        self.block_numbers = {name: k for k, name in enumerate(names)}
        self.is_sea = self.is_water & self.is_biome(*self.sea_biomes)

    def is_biome(self, *names):
        return np.isin(self.biome, [self.numbers[name] for name in names if name in self.numbers])

    def is_block(self, *names):
        return np.isin(self.block, [self.block_numbers[name] for name in names if name in self.block_numbers])

    def cells_of(self, blocks):
        return max(1, round(blocks / self.step))

    def index(self, x, y):
        """Indices of places, and whether they are on this land."""
        i, j = np.floor((y - self.y0) / self.step).astype(int), np.floor((x - self.x0) / self.step).astype(int)
        inside = (i >= 0) & (j >= 0) & (i < self.cells) & (j < self.cells)
        return np.clip(i, 0, self.cells - 1), np.clip(j, 0, self.cells - 1), inside

    def place(self, i, j):
        return self.x0 + (j + 0.5) * self.step, self.y0 + (i + 0.5) * self.step


def shifted(values, di, dj):
    """values[i + di, j + dj], the nearest one beyond the edges."""
    i = np.clip(np.arange(values.shape[0]) + di, 0, values.shape[0] - 1)
    j = np.clip(np.arange(values.shape[1]) + dj, 0, values.shape[1] - 1)
    return values[np.ix_(i, j)]


def highest_around(values, cells):
    """The largest value within a square."""
    for axis in ((1, 0), (0, 1)):
        reach = 1  # of the window, doubled as long as it fits
        window = values
        while 2 * reach <= cells:
            window = np.maximum(window, shifted(window, axis[0] * reach, axis[1] * reach))
            reach *= 2
        rest = cells + 1 - reach
        window = np.maximum(window, shifted(window, axis[0] * rest, axis[1] * rest))
        values = np.maximum(window, shifted(window, -axis[0] * cells, -axis[1] * cells))
    return values


def relief(land, blocks):
    return highest_around(land.top, land.cells_of(blocks)) + highest_around(-land.top, land.cells_of(blocks))


def share_around(mask, cells):
    """The mean over a square; of a mask, the share in which it is set."""
    padded = np.pad(mask.astype(np.float64), ((cells + 1, cells), (cells + 1, cells)), mode="edge")
    sums = padded.cumsum(0).cumsum(1)
    side = 2 * cells + 1
    return (sums[side:, side:] - sums[:-side, side:] - sums[side:, :-side] + sums[:-side, :-side]) / side**2


def sides_above(land, blocks, height):
    """How many of eight sides have land of that height over a place, within a distance."""
    count = np.zeros(land.top.shape, dtype=np.float32)
    for k in range(8):
        angle = k * math.pi / 4
        side = np.maximum.reduce([
            shifted(land.top, round(land.cells_of(share * blocks) * math.sin(angle)),
                    round(land.cells_of(share * blocks) * math.cos(angle))) for share in (0.3, 0.5, 0.75, 1)])
        count += side - land.top > height
    return count


# Subjects: a value for each column, 0 where there is none. ------------------------------------------------------------


def rivers(land):
    return land.is_water & ~land.is_sea


def peaks(land):
    isolated = land.top >= highest_around(land.top, land.cells_of(1500))
    return np.where(isolated & (land.top > 900), relief(land, 2000) - 600, 0).clip(0)


def valley_rivers(land):
    return np.where(rivers(land) & (land.top > 8), sides_above(land, 900, 250) - 3, 0).clip(0)


def bays(land):
    return np.where(land.is_sea, sides_above(land, 1000, 300) - 3, 0).clip(0)


def falls(land):
    """Water next to lower water."""
    water = rivers(land)
    lowest = np.where(water, land.top, np.inf)
    for di, dj in ((0, 1), (1, 0), (0, -1), (-1, 0), (1, 1), (1, -1), (-1, 1), (-1, -1)):
        reach = land.cells_of(6)
        lowest = np.minimum(lowest, np.where(shifted(water, reach * di, reach * dj), shifted(land.top, reach * di, reach * dj),
                                             np.inf))
    drop = np.where(water, land.top - lowest, 0)
    return np.where(np.isfinite(drop) & (drop >= 5), drop * share_around(water, land.cells_of(10)), 0)


def canyons(land):
    """Floors below walls of badlands."""
    below = highest_around(land.top, land.cells_of(128)) - land.top
    return np.where(land.is_biome("badlands"), below - 90, 0).clip(0) * share_around(
        land.is_biome("badlands"), land.cells_of(400))


def volcanoes(land):
    isolated = land.top >= highest_around(land.top, land.cells_of(1500))
    return np.where(isolated & land.is_biome("lava field", "rocks", "snow") & (land.top > 450),
                    share_around(land.is_biome("lava field"), land.cells_of(500)), 0)


def towers(land):
    tall = land.top - share_around(land.top, land.cells_of(150)) > 20
    is_rock = share_around(land.is_block("limestone"), land.cells_of(64)) > 0.03
    return np.where(tall & is_rock & ~land.is_water, share_around(land.is_sea, land.cells_of(300)), 0)


def meadow_ground(land):
    return land.is_biome("alpine meadow") & land.is_block("grass")


def meadows(land):
    grown = (share_around(meadow_ground(land), land.cells_of(100)) - 0.4).clip(0)
    return np.where(meadow_ground(land), grown * (relief(land, 3000) - 500), 0).clip(0)


def flower_beds(land):
    """Grass without gaps: a third of it has flowers."""
    return np.where(meadow_ground(land), share_around(meadow_ground(land), land.cells_of(12)), 0)


def river_mouths(land):
    sea = share_around(land.is_sea, land.cells_of(500))
    wet = share_around(rivers(land) & (land.top < 4), land.cells_of(250))
    return np.where(rivers(land) & (land.top < 4) & (sea > 0.1), wet * np.minimum(sea, 0.5), 0)


def arms(land):
    """Shores between water and flats at the level of the sea, where many are side by side: arms of deltas."""
    flat = ~land.is_water & (land.top < 3)
    shore = np.logical_or.reduce([flat & shifted(land.is_water, *side) for side in ((0, 1), (1, 0), (0, -1), (-1, 0))])
    return share_around(shore, land.cells_of(70)) * (share_around(land.is_sea, land.cells_of(250)) > 0.05)


# Kinds ----------------------------------------------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True)
class Kind:
    """A kind of view. Ranges of criteria are (none below, best from, best to, none above)."""
    text: str
    subject: typing.Callable  # of coarse land
    time: float
    distance: tuple  # of the camera from the subject, blocks
    above: tuple  # heights of the camera above ground or water that are tried
    fine: tuple = (1024, 4)  # radius and step of finer land around the subject
    fine_subject: typing.Callable | None = None  # moves the subject on the finer land
    stands: str = "anywhere"  # or on "land", "water"
    aim: float = 0  # blocks over the subject to which the camera looks
    yaw: float | None = None  # wanted direction, degrees
    lowest_ground: float = -512  # of the camera's place, z
    highest_ground: float = 1792
    wanted: typing.Callable = rivers  # what the image should show
    criteria: dict = dataclasses.field(default_factory=dict)


def wants(**own):
    """Criteria of most views, and those of a kind."""
    return {"sky": (0.08, 0.25, 0.42, 0.65), "bands": (1, 3, 5, 6), "rough": (0.3, 2, 30, 60), "near": (-1, 0, 0.3, 0.6),
            "visible": (-0.5, 1, 1, 2), "pitch": (-24, -14, 6, 16)} | own


def high_land(land):
    return land.top > 700


def sea_and_cliffs(land):
    return land.is_sea


KINDS = {
    "skyline": Kind("a skyline at dawn from 12 km", peaks, 0.222, (10500, 12500), (15, 60), wanted=high_land, aim=-300,
                    yaw=180, highest_ground=150,
                    criteria=wants(wanted=(0.005, 0.04, 0.4, 0.6), rough=(0.2, 1.2, 30, 60), open=(0.6, 0.97, 1, 2))),
    "valley": Kind("a valley with its river", valley_rivers, 0.36, (350, 900), (60, 140), stands="land", aim=60,
                   criteria=wants(wanted=(0.001, 0.02, 0.3, 0.5))),
    "fjord": Kind("a bay between walls of rock", bays, 0.62, (300, 1200), (8, 70, 140), aim=80, wanted=sea_and_cliffs,
                  criteria=wants(wanted=(0.05, 0.15, 0.4, 0.6), rough=(1, 4, 30, 60))),
    "waterfall": Kind("a waterfall from its foot", falls, 0.45, (14, 40), (3, 6), (128, 1), falls, aim=1,
                      criteria=wants(wanted=(0.02, 0.08, 0.4, 0.6), bands=(0, 2, 5, 6), near=(-1, 0.2, 0.6, 0.95),
                                     sky=(0.02, 0.12, 0.4, 0.6))),
    "canyon": Kind("a canyon from its rim", canyons, 0.33, (80, 300), (4, 10), (1024, 4), canyons, stands="land", aim=20,
                   wanted=lambda land: land.is_biome("badlands"),
                   criteria=wants(wanted=(0.1, 0.3, 0.8, 1), over=(30, 90, 250, 400), pitch=(-30, -20, 6, 16))),
    "volcano": Kind("a volcano", volcanoes, 0.66, (1200, 3600), (15, 60), aim=-150, yaw=180,
                    wanted=lambda land: land.is_biome("lava field"),
                    criteria=wants(wanted=(0.03, 0.1, 0.5, 0.8), open=(0.2, 0.7, 1, 2))),
    "karst": Kind("a bay with towers of limestone", towers, 0.3, (150, 600), (5, 25), stands="water", aim=-10,
                  wanted=lambda land: land.is_block("limestone"), criteria=wants(wanted=(0.01, 0.05, 0.4, 0.7))),
    "meadow": Kind("an alpine meadow with flowers", meadows, 0.4, (8, 20), (2, 4), (256, 1), flower_beds, stands="land", aim=2,
                   highest_ground=560, wanted=meadow_ground,  # below the clouds
                   criteria=wants(wanted=(0.05, 0.25, 0.55, 0.75), rough=(1, 4, 30, 60), near=(0, 0.15, 0.45, 0.7))),
    "cave": Kind("a great cave with crystals, fungi and lava", None, 0.5, (0, 0), (0,),  # find_caves()
                 criteria={"bands": (0, 3, 5, 6), "near": (-1, 0, 0.15, 0.4), "glow": (0, 0.02, 0.08, 0.2),
                           "glowing": (0, 3, 3, 4), "far": (0, 50, 100, 200)}),
    "river": Kind("a delta at dusk", river_mouths, 0.775, (150, 450), (40, 80), (768, 4), arms, yaw=0, aim=-10,
                  wanted=lambda land: arms(land) > 0.12, criteria=wants(wanted=(0.02, 0.2, 0.7, 0.9))),
}

# Of small images.
IMAGE_CRITERIA = {"contrast": (0.1, 0.4, 0.85, 1), "colors": (0.02, 0.12, 0.6, 1), "detail": (0.005, 0.03, 0.12, 0.3),
                  "light": (0.08, 0.3, 0.6, 0.85)}


# Scores ---------------------------------------------------------------------------------------------------------------


def share_within(value, criterion):
    """0 to 1: how well a value fits (none below, best from, best to, none above)."""
    low, best_from, best_to, high = criterion
    if value < best_from:
        return max(0.0, (value - low) / (best_from - low))
    return 1.0 if value <= best_to else max(0.0, (high - value) / (high - best_to))


def score(values, criteria):
    """The geometric mean: nothing makes up for what is missing."""
    shares = [max(share_within(values[name], criterion), 1e-3) for name, criterion in criteria.items()]
    return math.exp(sum(map(math.log, shares)) / len(shares))


@dataclasses.dataclass(frozen=True)
class Camera:
    position: tuple
    yaw: float
    pitch: float


def cast(lands, camera):
    """Distances [ROWS, COLUMNS] to the land, infinite for the sky, and the places that are seen; from the finest land
    to the coarsest."""
    x, y, z = camera.position
    half = math.tan(math.radians(FIELD_OF_VIEW / 2))
    across = (np.arange(COLUMNS) + 0.5) / COLUMNS * 2 - 1
    up = 1 - (np.arange(ROWS) + 0.5) / ROWS * 2
    aside = np.arctan(across * half * COLUMNS / ROWS)
    azimuth = math.radians(camera.yaw) - aside
    distance = np.geomspace(4, FAR, 240)
    px, py = x + np.cos(azimuth)[:, None] * distance, y + np.sin(azimuth)[:, None] * distance
    height = np.full(px.shape, -np.inf, dtype=np.float32)
    for land in reversed(lands):
        i, j, inside = land.index(px, py)
        height = np.where(inside, land.top[i, j] + 1, height)
    slope = np.maximum.accumulate((height - z) / distance, axis=1)  # [COLUMNS, distances]
    elevation = math.radians(camera.pitch) + np.arctan(up * half)
    wanted = np.tan(np.clip(elevation, -1.5, 1.5))
    hit = slope[:, None, :] >= wanted[None, :, None]
    first = hit.argmax(axis=2)
    is_land = hit.any(axis=2)
    column = np.arange(COLUMNS)[:, None]
    depth = np.where(is_land, distance[first], np.inf)
    return depth.T, px[column, first].T, py[column, first].T


def depth_values(lands, camera, subject, kind):
    """What the image of depths shows, for the criteria of a kind."""
    depth, px, py = cast(lands, camera)
    is_land = np.isfinite(depth)
    wanted = np.zeros(depth.shape, dtype=bool)
    for land in reversed(lands):
        i, j, inside = land.index(px, py)
        wanted = np.where(inside, kind.wanted(land)[i, j], wanted)
    skyline = (~is_land).sum(axis=0) / ROWS * FIELD_OF_VIEW
    top = depth[np.minimum((~is_land).sum(axis=0), ROWS - 1), np.arange(COLUMNS)]  # distance of the skyline
    bands = sum(np.mean((depth >= low) & (depth < high)) > 0.03 for low, high in zip(BANDS, BANDS[1:]))
    sx, sy = subject
    distance = math.hypot(sx - camera.position[0], sy - camera.position[1])
    seen = np.hypot(px - sx, py - sy)[is_land]
    near_subject = max(24.0, 0.03 * distance)
    return {"sky": 1 - is_land.mean(), "bands": bands, "rough": float(np.std(skyline)), "near": np.mean(depth < 25),
            "wanted": np.mean(wanted & is_land), "visible": float(seen.size > 0 and seen.min() < near_subject), "pitch": camera.pitch,
            "over": camera.position[2] - stand(lands, sx, sy)[0], "open": np.mean(top > 0.6 * distance)}


def image_values(image):
    """Contrast, colors, detail and mean light of an image, 0 to 1."""
    rgb = image.astype(np.float32) / 255
    light = rgb @ np.array([0.2126, 0.7152, 0.0722], dtype=np.float32)
    low, high = np.percentile(light, (3, 97))
    # D. Hasler, S. Süsstrunk, Measuring Colourfulness in Natural Images, 2003
    red_green, yellow_blue = rgb[..., 0] - rgb[..., 1], (rgb[..., 0] + rgb[..., 1]) / 2 - rgb[..., 2]
    colors = math.hypot(red_green.std(), yellow_blue.std()) + 0.3 * math.hypot(red_green.mean(), yellow_blue.mean())
    detail = np.abs(np.diff(light, axis=0)).mean() + np.abs(np.diff(light, axis=1)).mean()
    return {"contrast": high - low, "colors": colors, "detail": detail, "light": light.mean()}


# Cameras --------------------------------------------------------------------------------------------------------------


def best_places(values, land, count, apart):
    """The places with the largest values, none near another; those of equal value in order."""
    values, places = values.copy(), []
    cells = land.cells_of(apart)
    while len(places) < count and values.max() > 0:
        i, j = np.unravel_index(values.argmax(), values.shape)
        places.append(land.place(i, j))
        values[max(0, i - cells):i + cells + 1, max(0, j - cells):j + cells + 1] = 0
    return places


def stand(lands, x, y):
    """The highest column around a place, and whether it is water."""
    for land in lands:
        i, j, inside = land.index(np.array([x]), np.array([y]))
        if inside[0]:
            near = slice(max(0, i[0] - 1), i[0] + 2), slice(max(0, j[0] - 1), j[0] + 2)
            return float(land.top[near].max()), bool(land.is_water[i[0], j[0]])
    return None


def cameras_around(kind, lands, subject):
    sx, sy = subject
    ground = stand(lands, sx, sy)
    for distance in np.linspace(*kind.distance, 3):
        for turn in range(0, 360, 20):
            if kind.yaw is not None and abs((turn - kind.yaw + 180) % 360 - 180) > 40:
                continue
            x = sx - distance * math.cos(math.radians(turn))
            y = sy - distance * math.sin(math.radians(turn))
            below = stand(lands, x, y)
            if below is None or not kind.lowest_ground <= below[0] <= kind.highest_ground or (kind.stands != "anywhere" and (kind.stands == "water") != below[1]):
                continue
            for above in kind.above:
                z = below[0] + 1 + above
                pitch = math.degrees(math.atan2(ground[0] + kind.aim - z, max(distance, 1)))
                yield Camera((round(x, 1), round(y, 1), round(z, 1)), float(turn), round(min(max(pitch, -28), 18), 1))


def find_cameras(kind, world, coarse, count):
    """The best cameras of a kind by their images of depths, one a subject, the best first."""
    found = []
    for place in best_places(kind.subject(coarse), coarse, count, 1500):
        fine = Land(world, place, *kind.fine)
        subjects = best_places(kind.fine_subject(fine), fine, 2, 40) if kind.fine_subject else [place]
        lands = [fine, coarse]
        tried = [(score(depth_values(lands, camera, subject, kind), kind.criteria), camera)
                 for subject in subjects for camera in cameras_around(kind, lands, subject)]
        if tried:
            found.append(max(tried, key=lambda entry: entry[0]))
    return sorted(found, key=lambda entry: -entry[0])


def great_rooms(world, count):
    """Places in the highest rooms under the ground: height, and x, y, z of the lowest air; none near another."""
    air = world.block_id("air")
    rooms = []
    for cx, cy in ((cx, cy) for cx in range(-60, 60, 4) for cy in range(-60, 60, 4)):
        is_open = world.chunk(cx, cy) == air
        ground = is_open.shape[0] - 1 - np.argmax(~is_open[::-1], axis=0)
        roofed = is_open & (np.arange(is_open.shape[0])[:, None, None] < ground - 6)
        run, best, at = np.zeros((16, 16), dtype=int), 0, None
        for z in np.flatnonzero(roofed.any(axis=(1, 2))):
            run = np.where(roofed[z], run + 1, 0) if roofed[z - 1].any() else roofed[z].astype(int)
            if run.max() > best:
                best = int(run.max())
                y, x = np.unravel_index(run.argmax(), run.shape)
                at = (16 * cx + int(x), 16 * cy + int(y), world.bottom + int(z) - best + 1)
        if at and best >= 12:
            rooms.append((best, at))
    apart = []
    for height, at in sorted(rooms, reverse=True):
        if len(apart) < count and all(math.dist(at, other) > 72 for _, other in apart):
            apart.append((height, at))
    return apart


def cast_in_cave(blocks, is_open, start, camera, reach):
    """Of rays that fill the image: distances to blocks, `reach` without one, and the blocks [z, y, x] that are hit."""
    half = math.tan(math.radians(FIELD_OF_VIEW / 2))
    up, across = (v.ravel() * half for v in np.mgrid[1 - 1 / CAVE_ROWS:-1:-2 / CAVE_ROWS, -1 + 1 / CAVE_ROWS:1:2 / CAVE_ROWS])
    across = across * COLUMNS / ROWS
    yaw, pitch = math.radians(camera.yaw), math.radians(camera.pitch)
    ahead, rise = math.cos(pitch) - up * math.sin(pitch), math.sin(pitch) + up * math.cos(pitch)
    way = np.stack([rise, ahead * math.sin(yaw) - across * math.cos(yaw), ahead * math.cos(yaw) + across * math.sin(yaw)])
    way /= np.sqrt((way**2).sum(axis=0))
    depth, hit = np.full(rise.size, float(reach)), np.zeros(rise.size, dtype=blocks.dtype)
    rays = np.arange(rise.size)  # that have hit nothing yet
    for distance in np.arange(0.5, reach):
        at = np.floor(np.array(start)[:, None] + way[:, rays] * distance).astype(int)
        inside = ((at >= 0) & (at < np.array(blocks.shape)[:, None])).all(axis=0)
        rays, (z, y, x) = rays[inside], at[:, inside]
        closed = ~is_open[z, y, x]
        depth[rays[closed]], hit[rays[closed]] = distance, blocks[z[closed], y[closed], x[closed]]
        rays = rays[~closed]
    return depth, hit


@dataclasses.dataclass(frozen=True)
class CaveBox:
    """Blocks around a great room, [z, y, x] from a corner."""
    corner: tuple
    blocks: np.ndarray
    is_open: np.ndarray
    glowing: tuple  # numbers of blocks: crystals, fungi, lava


def cave_cameras(box, room, height):
    """Cameras at the side of a room that look across its highest place."""
    x, y, z = (v - c for v, c in zip(room, box.corner))
    for turn in range(0, 360, 20):
        ahead = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        for head in (height // 4, height // 2):
            back = 0
            while back < CAVE_REACH - 2 and box.is_open[z + head, y - round(back * ahead[1]), x - round(back * ahead[0])]:
                back += 1
            back = max(0, back - 4)
            place = room[0] + 0.5 - back * ahead[0], room[1] + 0.5 - back * ahead[1], room[2] + head + 0.5
            yield Camera(tuple(round(v, 1) for v in place), float(turn), -8.0)


def cave_values(box, camera):
    """What an image of depths of a cave shows, for its criteria."""
    start = [v - c for v, c in zip(camera.position, box.corner)][::-1]
    depth, hit = cast_in_cave(box.blocks, box.is_open, start, camera, 2 * CAVE_REACH)
    shares = [float(np.isin(hit, blocks).mean()) for blocks in box.glowing]
    bands = sum(np.mean((depth >= low) & (depth < 2 * low)) > 0.05 for low in (8, 16, 32, 64, 128))
    return {"bands": bands, "near": np.mean(depth < 8), "far": float(np.percentile(depth, 90)), "glow": sum(shares),
            "glowing": sum(min(1, share / 0.01) for share in shares)}


def find_caves(kind, world, count):
    """The best camera of each great room, by what its image of depths shows; the best first."""
    number = {name: k for k, name in enumerate(world.block_names)}
    glowing = (number["crystal"], number["crystal_rock"]), (number["glowing_mushroom"],), (number["lava"],)
    found = []
    for height, (x, y, z) in great_rooms(world, count):
        corner = x - CAVE_REACH, y - CAVE_REACH, max(z - 16, world.bottom)
        blocks = world.blocks(corner + (x + CAVE_REACH, y + CAVE_REACH, z + 140))
        box = CaveBox(corner, blocks, blocks == number["air"], glowing)
        tried = [(score(cave_values(box, camera), kind.criteria), camera) for camera in cave_cameras(box, (x, y, z), height)]
        found.append(max(tried, key=lambda entry: entry[0]))
    return sorted(found, key=lambda entry: -entry[0])


def lifted(world, camera):
    """The camera above the blocks of full detail around it."""
    x, y, z = camera.position
    cx, cy = math.floor(x), math.floor(y)
    top = int(world.heights((cx - 2, cy - 2, cx + 3, cy + 3)).max())
    return dataclasses.replace(camera, position=(x, y, max(z, top + 2.6)))


def draw(world, camera, kind):
    horizon = 1024 if max(kind.distance) > 4000 else 512
    return world.render(camera.position, camera.yaw, camera.pitch, THUMBNAIL, time=kind.time, view_distance=4,
                        horizon=horizon, preset="low")


def command_of(world, name, camera, time):
    at = ",".join(f"{v:g}" for v in camera.position)
    return (f"terrane render --generator {world.generator} --seed {world.seed} --at={at} "
            f"--look={camera.yaw:g},{camera.pitch:g} --time {time:g} --preset high --size 1280x720 -o {name}.png")


def run(arguments):
    import terrane
    world = terrane.World(arguments.seed, arguments.generator)
    coarse = Land(world, (0, 0), arguments.radius, 32)
    for name in arguments.kinds or KINDS:
        kind = KINDS[name]
        found = (find_caves(kind, world, 3 * arguments.drawn) if name == "cave" else find_cameras(
            kind, world, coarse, arguments.subjects))[:arguments.drawn]
        views = []
        for fit, camera in found:
            camera = camera if name == "cave" else lifted(world, camera)
            image = draw(world, camera, kind)
            views.append((math.sqrt(fit * score(image_values(image), IMAGE_CRITERIA)), camera, image))
        views.sort(key=lambda view: -view[0])
        print(f"# {name}: {kind.text}; {len(found)} drawn")
        for k, (value, camera, image) in enumerate(views[:arguments.best]):
            print(f"{value:.3f} {command_of(world, name, camera, kind.time)}", flush=True)
            if arguments.images:
                import PIL.Image
                arguments.images.mkdir(parents=True, exist_ok=True)
                PIL.Image.fromarray(image).save(arguments.images / f"{name}_{k}.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kinds", nargs="*", metavar="KIND", help=f"of {', '.join(KINDS)}; none: all")
    parser.add_argument("--generator", default="wilderness")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--radius", type=int, default=16384, help="blocks around 0, 0 in which subjects are searched")
    parser.add_argument("--subjects", type=int, default=12, help="places looked at for each kind")
    parser.add_argument("--drawn", type=int, default=6, help="small images drawn for each kind")
    parser.add_argument("--best", type=int, default=2, help="cameras printed for each kind")
    parser.add_argument("--images", type=pathlib.Path, help="folder for the small images")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build")
    arguments = parser.parse_args()
    unknown = [name for name in arguments.kinds if name not in KINDS]
    if unknown:
        parser.error(f"no such kind: {', '.join(unknown)}")
    sys.path.insert(0, str(arguments.build / "python"))
    run(arguments)


if __name__ == "__main__":
    main()
