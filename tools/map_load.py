#!/usr/bin/env python3
"""Measures the speed of a browser map on this machine.

cold: tiles that were never painted, at one pixel per block and at 16 blocks per pixel, by one thread; CPU time of the
      program per tile, and so tiles per second and core.
warm: the same tiles again, requested by 64 clients at a time: tiles per second, and the time of an answer.
disk: bytes of the file that caches surfaces, after all tiles of a radius were requested (--radius; takes long).
"""
import argparse
import pathlib
import re
import sys
import tempfile
import time

import child_processes
from web_clients import ask_all, quantile, read_metrics

WARM_CLIENTS = 64


class Map:
    """`terrane map --http` with its own folder."""

    def __init__(self, program, folder, *arguments):
        self.log = open(folder / "map.log", "w+", encoding="utf-8")
        environment = {"XDG_DATA_HOME": str(folder), "XDG_CONFIG_HOME": str(folder), "PATH": "/usr/bin:/bin"}
        self.process = child_processes.start([program, "map", "--http", "0", "--seed", "7", *arguments], stdout=self.log,
                                             stderr=self.log, env=environment)
        while not (found := re.search(r"http://([\d.]+):(\d+)/", pathlib.Path(self.log.name).read_text())):
            if self.process.poll() is not None:
                raise RuntimeError(pathlib.Path(self.log.name).read_text())
            time.sleep(0.05)
        self.address = (found[1], int(found[2]))

    def metrics(self):
        return read_metrics(self.address)

    def stop(self):
        self.process.terminate()
        self.process.wait()
        self.log.close()


def around(zoom, count, layer="day"):
    """Paths of a square of tiles."""
    side = int(count ** 0.5)
    return [f"/tiles/{layer}/{zoom}/{x - side // 2}/{y - side // 2}.png" for y in range(side) for x in range(side)]


def check(answers):
    bad = [status for _, status, _ in answers if status != 200]
    if bad:
        sys.exit(f"map_load: {len(bad)} answers were not 200: {sorted(set(bad))}")


def measure_cold(program, zoom, count):
    with tempfile.TemporaryDirectory(prefix="terrane-map-") as folder:
        shown = Map(program, pathlib.Path(folder), "--threads", "1")
        try:
            # The first requests initialize the program.
            check(ask_all(shown.address, [f"/tiles/day/{zoom}/{x}/1000.png" for x in range(4)], 1))
            before, begun = shown.metrics(), time.perf_counter()
            answers = ask_all(shown.address, around(zoom, count), 2)
            wall, after = time.perf_counter() - begun, shown.metrics()
            check(answers)
        finally:
            shown.stop()
    cpu = after["process_cpu_seconds_total"] - before["process_cpu_seconds_total"]
    return len(answers) / cpu, len(answers) / wall, sum(size for _, _, size in answers) / len(answers)


def measure_warm(program, count, rounds):
    with tempfile.TemporaryDirectory(prefix="terrane-map-") as folder:
        shown = Map(program, pathlib.Path(folder), "--threads", "2")
        try:
            paths = around(0, count)
            check(ask_all(shown.address, paths, 8))
            before, begun = shown.metrics(), time.perf_counter()
            answers = ask_all(shown.address, paths * rounds, WARM_CLIENTS)
            wall, after = time.perf_counter() - begun, shown.metrics()
            check(answers)
        finally:
            shown.stop()
    cpu = after["process_cpu_seconds_total"] - before["process_cpu_seconds_total"]
    seconds = [answer[0] for answer in answers]
    return len(answers) / wall, len(answers) / cpu, quantile(seconds, 0.5), quantile(seconds, 0.99)


def measure_disk(program, radius):
    with tempfile.TemporaryDirectory(prefix="terrane-map-") as folder:
        shown = Map(program, pathlib.Path(folder), "--threads", "2", "--map-disk", "100000")
        painted, begun = 0, time.perf_counter()
        try:
            for zoom in range(-10, 1):
                across = 256 << -zoom
                tiles = range(-radius // across, (radius - 1) // across + 1)
                paths = [f"/tiles/day/{zoom}/{x}/{y}.png" for y in tiles for x in tiles]
                check(ask_all(shown.address, paths, 8))
                painted += len(paths)
                print(f"zoom {zoom}: {painted} tiles after {time.perf_counter() - begun:.0f} s", file=sys.stderr, flush=True)
            kept = shown.metrics()["terrane_map_disk_bytes"]
        finally:
            shown.stop()
        file = sum(path.stat().st_size for path in pathlib.Path(folder).rglob("*.map.sqlite*"))
    return painted, kept, file


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--tiles", type=int, default=100, help="painted for each figure")
    parser.add_argument("--rounds", type=int, default=100, help="how often each is asked for again")
    parser.add_argument("--radius", type=int, help="blocks around 0,0 whose tiles are all seen")
    options = parser.parse_args()
    program = options.program.resolve()
    for zoom, what in ((0, "1 pixel a block"), (-4, "16 blocks a pixel")):
        core, wall, size = measure_cold(program, zoom, options.tiles)
        print(f"cold, {what}: {core:.1f} tiles a second and core, {wall:.1f} a second with one thread, {size / 1000:.0f} kB each",
              flush=True)
    wall, core, median, p99 = measure_warm(program, options.tiles, options.rounds)
    print(f"warm, {WARM_CLIENTS} clients: {wall:.0f} tiles a second ({core:.0f} a second and core of the server), "
          f"{median * 1000:.1f} ms median, {p99 * 1000:.1f} ms at the 99th percentile", flush=True)
    if options.radius:
        painted, rows, file = measure_disk(program, options.radius)
        print(f"disk, radius {options.radius}: {painted} tiles seen, {rows / 1e6:.0f} MB of surfaces, {file / 1e6:.0f} MB of file")


if __name__ == "__main__":
    main()
