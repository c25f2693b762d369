"""Compares all views of one world: chunks, history, a copy, bots, windows."""
import dataclasses
import hashlib
import json
import re
import subprocess

import numpy

from . import GENERATOR
from .bots import is_kept

# Chunks around a window's player, of its 6, whose edits the server sends completely.
SURE_CHUNKS = 4
CHUNK = 16
HISTORY_LINE = re.compile(r"\S+ \S+ (?P<player>.+) at (?P<x>-?\d+) (?P<y>-?\d+) (?P<z>-?\d+): (?P<before>\S+) to (?P<after>\S+)$")


def output_of(program, *arguments):
    return subprocess.run([program, *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def history_problems(postgres):
    left = postgres.query("SELECT newest, saved, (SELECT count(*) FROM terrane.edits), "
                          "(SELECT count(*) FROM terrane.servers) FROM terrane.history").split("|")
    good = left[0] == left[1] == left[2] and left[3] == "0"
    return [] if good else [f"newest, saved, rows of the history, servers: {left}"]


def read_history(program, url):
    """Position to its changes (block, player), newest first, and the number of all changes."""
    changes, count = {}, 0
    for line in output_of(program, "history", "--world", url, "--limit", 10**9, "--each-block").splitlines():
        if found := HISTORY_LINE.match(line):
            count += 1
            changes.setdefault(tuple(int(found[k]) for k in "xyz"), []).append((found["after"], found["player"]))
    return changes, count


@dataclasses.dataclass
class Land:
    """Blocks of an area of chunks: ids[x, y, z], from the area's corner on."""
    area: tuple
    ids: numpy.ndarray
    names: dict  # by id

    def place(self, pos):
        return pos[0] - self.area[0] * CHUNK, pos[1] - self.area[1] * CHUNK, pos[2]

    def has(self, pos):
        x, y, _ = self.place(pos)
        return 0 <= x < self.ids.shape[0] and 0 <= y < self.ids.shape[1]

    def block(self, pos):
        return self.names[int(self.ids[self.place(pos)])]

    def digest(self):
        return hashlib.sha256(self.ids.tobytes()).hexdigest()[:16]

    def part(self, area):
        begin, end = self.place((area[0] * CHUNK, area[1] * CHUNK, 0)), self.place((area[2] * CHUNK, area[3] * CHUNK, 0))
        return dataclasses.replace(self, area=area, ids=self.ids[begin[0]:end[0], begin[1]:end[1]])

    def with_blocks(self, blocks):
        """A copy with other blocks, by position and name; positions outside are skipped."""
        numbers = {name: number for number, name in self.names.items()}
        changed = dataclasses.replace(self, ids=self.ids.copy())
        for pos, name in blocks.items():
            if changed.has(pos):
                changed.ids[changed.place(pos)] = numbers[name]
        return changed


def read_land(program, area, folder, *world):
    file = folder / "land.npy"
    output_of(program, "dump", "--what", "blocks", "--area", ",".join(map(str, area)), "-o", file, *world)
    ids = numpy.load(file)
    file.unlink()
    return Land(area, ids, {block["id"]: block["name"] for block in json.loads(output_of(program, "blocks", "--json"))})


def area_of(positions):
    chunks = [(x // CHUNK, y // CHUNK) for x, y, _ in positions]
    return (min(x for x, _ in chunks), min(y for _, y in chunks), max(x for x, _ in chunks) + 1, max(y for _, y in chunks) + 1)


def compare_window(window, world, generated):
    """Differences between the window's knowledge and the world, and the number of edited blocks around it."""
    if not window.edits_file.exists():
        return [f"{window.name} ended outside the world"], 0
    (x, y), known = window.known()
    x0, y0, x1, y1 = world.area
    area = (max(x0, x - SURE_CHUNKS), max(y0, y - SURE_CHUNKS), min(x1, x + SURE_CHUNKS + 1), min(y1, y + SURE_CHUNKS + 1))
    if area[0] >= area[2] or area[1] >= area[3]:
        return [f"{window.name} is far from all edits"], 0
    there, before = world.part(area), generated.part(area)
    wrong = numpy.argwhere(before.with_blocks(known).ids != there.ids)
    problems = [f"{window.name}: {len(wrong)} blocks are not as in the world, first {wrong[0].tolist()}"] if len(wrong) else []
    return problems, int((there.ids != before.ids).sum())


def compare_worlds(program, postgres, folder, windows, bots):
    """Returns counts of compared blocks, and problems."""
    url, problems = postgres.url(), []
    history, count = read_history(program, url)
    area = area_of(history)
    world = read_land(program, area, folder, "--world", url)
    generated = read_land(program, area, folder, "--generator", GENERATOR)
    replayed = generated.with_blocks({pos: changes[0][0] for pos, changes in history.items()})
    output_of(program, "copy", url, folder / "copy.sqlite")
    copy = read_land(program, area, folder, "--world", folder / "copy.sqlite")
    digests = {"chunks": world.digest(), "history": replayed.digest(), "copy": copy.digest()}
    if len(set(digests.values())) != 1:
        differ = numpy.argwhere(replayed.ids != world.ids)
        problems.append(f"digests differ: {digests}; {len(differ)} blocks, first {differ[:5].tolist()}")
    lost = [pos for pos, name in bots.kept.items() if not is_kept(history.get(pos, []), name)]
    if lost:
        problems.append(f"{len(lost)} of {len(bots.kept)} blocks that bots were told are kept are lost: {lost[:5]}")
    around = {}
    for window in windows:
        found, around[window.name] = compare_window(window, world, generated)
        problems += found
    checked = subprocess.run([program, "check", url], capture_output=True, text=True, check=False)
    if checked.returncode != 0:
        problems.append(checked.stdout)
    return {"digests": digests, "area_chunks": (area[2] - area[0]) * (area[3] - area[1]), "changed_blocks": count,
            "kept_by_bots": len(bots.kept), "lost": len(lost), "edited_blocks_around_windows": around}, problems
