"""One world, looked at from all sides: chunks, history, a copy, bots, windows."""
import hashlib
import json
import re
import subprocess

import numpy

# Of a window's 6 chunks those around, which the server tells completely.
SURE_CHUNKS = 4
HISTORY_LINE = re.compile(r"\S+ \S+ (?P<player>.+) at (?P<x>-?\d+) (?P<y>-?\d+) (?P<z>-?\d+): (?P<before>\S+) to (?P<after>\S+)$")


def history_problems(postgres):
    left = postgres.query("SELECT newest, saved, (SELECT count(*) FROM terrane.edits), "
                          "(SELECT count(*) FROM terrane.servers) FROM terrane.history").split("|")
    good = left[0] == left[1] == left[2] and left[3] == "0"
    return [] if good else [f"newest, saved, rows of the history, servers: {left}"]


def output_of(program, *arguments):
    return subprocess.run([program, *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def read_history(program, url):
    """Position to (last block, who), and the number of changes."""
    last, count = {}, 0
    for line in output_of(program, "history", "--world", url, "--limit", 10**9).splitlines():
        if found := HISTORY_LINE.match(line):
            count += 1
            last.setdefault(tuple(int(found[k]) for k in "xyz"), (found["after"], found["player"]))
    return last, count


class Land:
    """Blocks of an area of chunks, as names; z runs fastest in the dumped file."""

    def __init__(self, program, area, folder, name, *world):
        self.area = area
        file = folder / f"{name}.npy"
        output_of(program, "dump", "--what", "blocks", "--area", ",".join(map(str, area)), "-o", file, *world)
        self.ids = numpy.load(file)
        file.unlink()
        blocks = json.loads(output_of(program, "blocks", "--json"))
        self.names = {block["id"]: block["name"] for block in blocks}
        self.numbers = {block["name"]: block["id"] for block in blocks}

    def place(self, pos):
        return pos[0] - self.area[0] * 16, pos[1] - self.area[1] * 16, pos[2]

    def block(self, pos):
        return self.names[int(self.ids[self.place(pos)])]

    def digest(self):
        return hashlib.sha256(self.ids.tobytes()).hexdigest()[:16]


def area_of(positions):
    chunks = [(x >> 4, y >> 4) for x, y, _ in positions]
    return (min(x for x, _ in chunks), min(y for _, y in chunks), max(x for x, _ in chunks) + 1, max(y for _, y in chunks) + 1)


def window_problems(window, land, generated):
    """Where what the window knows is not the world, both ways; how many edits are there."""
    if not window.edits_file.exists():
        return [f"{window.name} ended outside the world"], 0
    (cx, cy), known = window.known()
    x0, y0, x1, y1 = land.area
    low = (max(x0, cx - SURE_CHUNKS), max(y0, cy - SURE_CHUNKS))
    high = (min(x1, cx + SURE_CHUNKS + 1), min(y1, cy + SURE_CHUNKS + 1))
    if low[0] >= high[0] or low[1] >= high[1]:
        return [f"{window.name} is far from all edits"], 0
    part = tuple(slice((a - o) * 16, (b - o) * 16) for a, b, o in zip(low, high, (x0, y0)))
    seen = generated.ids[part].copy()
    for pos, name in known.items():
        place = tuple(v - (a * 16 if k < 2 else 0) for k, (v, a) in enumerate(zip(pos, (*low, 0))))
        if 0 <= place[0] < seen.shape[0] and 0 <= place[1] < seen.shape[1]:
            seen[place] = generated.numbers[name]
    wrong = numpy.argwhere(seen != land.ids[part])
    edited = int((land.ids[part] != generated.ids[part]).sum())
    return ([f"{window.name}: {len(wrong)} blocks are not as in the world, first {wrong[0].tolist()}"] if len(wrong) else []), edited


def compare_worlds(program, postgres, folder, windows, bots):
    """What was compared, and problems."""
    url, problems = postgres.url(), []
    last, changes = read_history(program, url)
    area = area_of(last)
    world = ("--world", url)
    chunks, generated = Land(program, area, folder, "world", *world), Land(program, area, folder, "generated", "--generator",
                                                                          "continents")
    replayed = Land.__new__(Land)
    replayed.__dict__ = {**generated.__dict__, "ids": generated.ids.copy()}
    for pos, (name, _) in last.items():
        replayed.ids[replayed.place(pos)] = replayed.numbers[name]
    output_of(program, "copy", url, folder / "copy.sqlite")
    copy = Land(program, area, folder, "copied", "--world", folder / "copy.sqlite")
    digests = {"chunks": chunks.digest(), "history": replayed.digest(), "copy": copy.digest()}
    if len(set(digests.values())) != 1:
        differ = numpy.argwhere(replayed.ids != chunks.ids)
        problems.append(f"digests differ: {digests}; {len(differ)} blocks, first {differ[:5].tolist()}")
    # Others may have changed what a bot placed.
    mine = {pos: name for pos, name in bots.kept.items() if last.get(pos, ("", ""))[1].startswith("bot")}
    lost = [pos for pos, name in mine.items() if chunks.block(pos) != name]
    if lost:
        problems.append(f"{len(lost)} of {len(mine)} blocks that bots were told are kept are lost: {lost[:5]}")
    seen = {}
    for window in windows:
        found, seen[window.name] = window_problems(window, chunks, generated)
        problems += found
    checked = subprocess.run([program, "check", url], capture_output=True, text=True, check=False)
    if checked.returncode != 0:
        problems.append(checked.stdout)
    return {"digests": digests, "area_chunks": (area[2] - area[0]) * (area[3] - area[1]), "changed_blocks": changes,
            "kept_by_bots": len(mine), "lost": len(lost), "edited_blocks_around_windows": seen}, problems
