"""Frames of Luanti's client on a virtual screen, from one place."""
import json
import math
import os
import pathlib
import re
import statistics
import sys
import time

import luanti
import places
import process
from process import CompareError
from terrane import PITCH, YAWS

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from virtual_display import Display  # noqa: E402

SIZE = (1280, 720)
FIELD_OF_VIEW = 70     # vertical, degrees
MAPBLOCK = 16
WATER_LEVEL = 1
EYE_HEIGHT = 1.47      # of a player, blocks
# The server sends blocks ahead of the camera, ring by ring, and restarts when the camera turns: each direction waits until
# its view is filled. Between two rings nothing arrives for seconds.
QUIET_SECONDS = 30
QUIET_SHARE = 0.002    # of the map blocks
FILL_RATE = 1          # frames per second while the view fills: the server needs the CPU
FULL_RATE = 1000
SWING_SECONDS = 3      # ignored after a turn
REPORT_SECONDS = 2     # of its profiler

CLIENT_SETTINGS = {
    "screen_w": SIZE[0], "screen_h": SIZE[1], "fullscreen": "false", "autosave_screensize": "false", "vsync": "false",
    "fps_max": 1000, "fps_max_unfocused": 1000, "fov": FIELD_OF_VIEW, "enable_dynamic_shadows": "false", "enable_clouds": "false",
    "max_block_send_distance": 40, "max_block_generate_distance": 0, "max_simultaneous_block_sends_per_client": 400,
    "emergequeue_limit_diskonly": 20000, "emergequeue_limit_total": 60000, "client_mapblock_limit": -1,
    "client_unload_unused_data_timeout": 100000, "num_emerge_threads": os.cpu_count(), "profiler_print_interval": REPORT_SECONDS}


class Search:
    """Finds the places of one seed, and generates the terrain around the used ones."""

    def __init__(self, folder, seed, mapchunks):
        self.world, self.mapchunks = luanti.World(folder, seed), mapchunks

    def choose(self, count):
        x0, _, z0, x1, _, z1 = luanti.square(self.mapchunks)
        # Two layers contain all of the ground except the highest mountains.
        (self.world.path / "heights.txt").unlink(missing_ok=True)
        box = x0, luanti.MAPCHUNK_BEGIN, z0, x1, luanti.TOP, z1
        self.world.emerge("generate", [box], threads=os.cpu_count(), heights=True)
        return places.read_lines(self.world.path / "heights.txt", WATER_LEVEL).places(count)

    def generate_around(self, place, blocks):
        """All that the camera can see within `blocks`, sky and underground too: the server does not go on to the next ring
        while it finds blocks of the last one neither in memory nor on the disk. Does nothing if it was done before."""
        x, z, y, _ = place
        radius = blocks + 2 * MAPBLOCK
        below, above = (radius * math.sin(math.radians(FIELD_OF_VIEW / 2 + pitch)) for pitch in (PITCH, -PITCH))
        box = luanti.box_around(x, y, z, radius, below, above)
        path = self.world.folder / "generated.jsonl"
        done = [json.loads(line) for line in path.read_text(encoding="ascii").splitlines()] if path.exists() else []
        if any(luanti.is_within(box, other) for other in done):
            return
        self.world.emerge("generate", [box], threads=os.cpu_count())
        with open(path, "a", encoding="ascii") as file:
            file.write(json.dumps(box) + "\n")


class Client:
    """A running client, with its camera and reports."""

    def __init__(self, world, child, hud, place):
        self.world, self.child, self.hud, self.place = world, child, hud, place

    def look(self, yaw, rate=FULL_RATE):
        x, z, y, _ = self.place
        path = self.world.path / "camera.txt"
        path.with_suffix(".new").write_text(f"{x} {y - EYE_HEIGHT} {z} {yaw} {PITCH} {rate}\n", encoding="ascii")
        path.with_suffix(".new").replace(path)

    def check(self):
        if not self.child.is_running():
            raise CompareError(f"{self.child.command[0]} ended with {self.child.exit_code} while it was measured, see "
                               f"{self.world.folder / 'client.log'}")

    def sleep(self, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.check()
            time.sleep(0.2)

    def profile(self, name, begin=0):
        """All values of a line of its profiler, since an offset of the log."""
        return [float(number) for number in re.findall(rf"{re.escape(name)}\W[^\n]*?x\s+([\d.eE+]+)\s*$",
                                                       self.child.text(1)[begin:], re.M)]

    def rates(self):
        path = self.hud / "fps"
        return [float(line) for line in path.read_text(encoding="ascii").split()] if path.exists() else []

    def fill_view(self, longest):
        """Looks in each direction until nothing new arrives. Returns seconds, and whether all finished in time."""
        start = time.monotonic()
        is_full = [self.fill_direction(yaw, longest / len(YAWS)) for yaw in YAWS]
        return time.monotonic() - start, all(is_full)

    def fill_direction(self, yaw, longest):
        """Returns whether it finished in time."""
        self.look(yaw, FILL_RATE)
        start, history = time.monotonic(), []
        while (now := time.monotonic() - start) < longest:
            self.sleep(1)
            history.append((now, max(self.profile("MapBlocks loaded [#]"), default=0)))
            before = [count for at, count in history if at <= now - QUIET_SECONDS]
            if before and before[-1] > 0 and history[-1][1] - before[-1] <= QUIET_SHARE * before[-1]:
                return True
        return False

    def frames(self, yaw, seconds):
        """Frames per second (the median of readings of half a second) and thousands of vertices."""
        self.look(yaw)
        self.sleep(SWING_SECONDS)
        first, begin = len(self.rates()), len(self.child.text(1))
        self.sleep(seconds)
        rates = [rate for rate in self.rates()[first:] if rate > 0]
        if not rates:
            raise CompareError("Luanti drew no frame in the time of a measurement")
        vertices = [sum(self.profile(f"renderMap({kind}): vertices drawn [#]", begin)[-1:])
                    for kind in ("SOLID", "TRANSPARENT")]
        return statistics.median(rates), sum(vertices) / 1000


def measure_frames(search, place, blocks, seconds, longest):
    """Values of one view distance: means over four directions. `longest`: seconds to fill the view."""
    world = search.world
    search.generate_around(place, blocks)
    hud = world.folder / "hud"
    hud.mkdir(exist_ok=True)
    (hud / "fps").unlink(missing_ok=True)
    config = world.write_settings(compare_mode="view", viewing_range=blocks, **CLIENT_SETTINGS)
    command = [process.find_program(luanti.CLIENTS, luanti.HINT), "--go", "--world", world.path, "--gameid", luanti.GAME,
               "--config", config, "--logfile", world.folder / "client.log", "--info"]
    with Display(SIZE) as display:
        environment = {**world.environment(), "DISPLAY": display.name, "LIBGL_ALWAYS_SOFTWARE": "1", "GALLIUM_HUD": "fps",
                       "GALLIUM_HUD_PERIOD": "0.5", "GALLIUM_HUD_DUMP_DIR": str(hud), "GALLIUM_HUD_VISIBLE": "false"}
        with process.Child(command, environment=environment) as child:
            client = Client(world, child, hud, place)
            filled, is_full = client.fill_view(longest)
            runs = [client.frames(yaw, seconds) for yaw in YAWS]
            loaded = max(client.profile("MapBlocks loaded [#]"), default=0)
            finished = child.stop()
    values = {"frames": statistics.mean(rate for rate, _ in runs), "triangles": statistics.mean(v for _, v in runs) / 2,
              "rss": finished.peak_rss / 1e6, "pss": finished.peak_pss / 1e6}
    values = {f"{name}_{blocks}": value for name, value in values.items()}
    # The same frames: Luanti has no terrain beyond the view distance.
    values[f"frames_horizon_{blocks}"] = values[f"frames_{blocks}"]
    return values, {"camera": f"{place[0]},{place[2]},{place[1]}", "openness": place[3], "fill_s": filled, "is_full": is_full,
                    "map_blocks": loaded, "frames_by_direction": [rate for rate, _ in runs]}
