"""Luanti: worlds, settings, its server. Debian packages: minetest, minetest-server (or luanti, luanti-server)."""
import contextlib
import json
import math
import pathlib
import re
import shutil
import socket
import sqlite3
import subprocess

import process
from measures import BLOCKS_OF_A_CHUNK
from process import CompareError

CLIENTS = ("minetest", "/usr/games/minetest", "luanti", "/usr/games/luanti")
SERVERS = ("/usr/lib/minetest/minetestserver", "/usr/lib/luanti/luantiserver", "luantiserver", "minetestserver")
HINT = "run.py --install, or apt install minetest minetest-server"
GAME = "minetest"  # Minetest Game
MOD = pathlib.Path(__file__).with_name("luanti_mod")

MAPCHUNK = 80             # blocks
BOTTOM, TOP = -112, 127   # three mapchunks in height: 240 blocks, of which 114 are at or under the water level
MAPCHUNK_BEGIN = -32      # mapchunks begin at -32 + 80 n

SETTINGS = {"mg_name": "v7", "server_announce": "false", "enable_damage": "false", "creative_mode": "true", "time_speed": 0,
            "enable_sound": "false"}


def luanti_version():
    for name in CLIENTS:
        with contextlib.suppress(OSError, subprocess.SubprocessError):
            if path := shutil.which(name):
                done = subprocess.run([path, "--version"], capture_output=True, text=True, timeout=60, check=False)
                return done.stdout.splitlines()[0].strip()
    return None


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def box_around(x, y, z, radius, below, above):
    """All mapchunks that have a block within `radius` of x and z and from y - below to y + above;
    (x0, y0, z0, x1, y1, z1), ends included."""
    begin = lambda n: math.floor((n - MAPCHUNK_BEGIN) / MAPCHUNK) * MAPCHUNK + MAPCHUNK_BEGIN
    end = lambda n: begin(n) + MAPCHUNK - 1
    return begin(x - radius), begin(y - below), begin(z - radius), end(x + radius), end(y + above), end(z + radius)


def square(mapchunks):
    """A square of mapchunks around 0,0."""
    begin = MAPCHUNK_BEGIN - mapchunks // 2 * MAPCHUNK
    return begin, BOTTOM, begin, begin + mapchunks * MAPCHUNK - 1, TOP, begin + mapchunks * MAPCHUNK - 1


def is_within(box, other):
    return all(low >= outer for low, outer in zip(box[:3], other[:3])) and \
        all(high <= outer for high, outer in zip(box[3:], other[3:]))


def blocks_of(box):
    return (box[3] - box[0] + 1) * (box[4] - box[1] + 1) * (box[5] - box[2] + 1)


class World:
    """A world in its own folder, with the mod of this comparison."""

    def __init__(self, folder, seed):
        self.folder, self.seed = folder, seed
        mod = folder / "world" / "worldmods" / "terrane_compare"
        shutil.copytree(MOD, mod, dirs_exist_ok=True)
        self.path = folder / "world"
        backends = "".join(f"{name}backend = sqlite3\n" for name in ("", "player_", "auth_"))
        (self.path / "world.mt").write_text(f"gameid = {GAME}\n{backends}", encoding="ascii")

    def write_settings(self, **settings):
        """The path of the file for --config."""
        path = self.folder / "luanti.conf"
        everything = {**SETTINGS, "fixed_map_seed": self.seed, "port": free_port(), "bind_address": "127.0.0.1", **settings}
        path.write_text("".join(f"{name} = {value}\n" for name, value in everything.items()), encoding="ascii")
        return path

    def environment(self):
        return {"HOME": str(self.folder)}

    def emerge(self, mode, boxes, threads=1, heights=False, timeout=3600):
        """Generates or loads boxes with a server. Returns the mod's report and the resources of the process."""
        server = process.find_program(SERVERS, HINT)
        config = self.write_settings(compare_mode=mode, compare_boxes=";".join(",".join(map(str, box)) for box in boxes),
                                     compare_heights=str(heights).lower(), num_emerge_threads=threads)
        finished = process.run([server, "--world", self.path, "--gameid", GAME, "--config", config, "--logfile",
                                self.folder / "server.log"], environment=self.environment(), timeout=timeout)
        found = re.search(r"^COMPARE (\{.*\})$", finished.output, re.M)
        if not found:
            raise CompareError(f"{server}: no report of the mod, see {self.folder / 'server.log'}")
        return json.loads(found[1]), finished

    def disk_bytes(self, box):
        """Bytes of the file for the blocks in a box; the border is subtracted by its share of the data."""
        path = self.path / "map.sqlite"
        inside = everything = 0
        with contextlib.closing(sqlite3.connect(f"file:{path}?mode=ro", uri=True)) as database:
            for key, size in database.execute("SELECT pos, length(data) FROM blocks"):
                everything += size
                position = block_position(key)
                if all(low <= 16 * n <= high for n, low, high in zip(position, box[:3], box[3:])):
                    inside += size
        if not everything:
            raise CompareError(f"{path}: no blocks were saved")
        return path.stat().st_size * inside / everything


def block_position(key):
    """(x, y, z), in blocks of 16, of a row: its key is x + 4096 y + 4096² z, each from -2048 to 2047."""
    parts = []
    for _ in range(3):
        part = (key + 2048) % 4096 - 2048
        parts.append(part)
        key = (key - part) // 4096
    return parts


def measure_world(folder, seed, mapchunks):
    """Generating, loading, bytes on disk: one thread generates."""
    box = square(mapchunks)
    world = World(folder, seed)
    chunks = blocks_of(box) / BLOCKS_OF_A_CHUNK
    made, finished = world.emerge("generate", [box])
    # The server saves at intervals and at its end, so all CPU time after the begin counts.
    generating = finished.cpu_seconds - made["cpu_begin"]
    disk = world.disk_bytes(box)
    loaded, _ = world.emerge("load", [box])
    if loaded["counts"].get("disk", 0) < 0.9 * blocks_of(box) / 4096:
        raise CompareError(f"Luanti loaded {loaded['counts']} of {blocks_of(box) // 4096} blocks")
    loading = loaded["cpu_end"] - loaded["cpu_begin"]
    return ({"generation": chunks / generating, "loading": chunks / loading, "disk": disk / chunks},
            {"chunks": chunks, "seed": seed, "generating_cpu_s": generating, "generating_s": made["seconds"],
             "loading_cpu_s": loading, "peak_rss": finished.peak_rss, "counts": made["counts"]})
