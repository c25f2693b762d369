"""Terrane's side: worlds, frames."""
import json
import statistics

import places
import process
from process import CompareError

SOFTWARE = {"LIBGL_ALWAYS_SOFTWARE": "1"}
SIZE = "1280x720"
PITCH = 10           # degrees down
YAWS = (0, 90, 180, 270)
GENERATOR = "continents"
SEA_LEVEL = 80       # blocks, of its worlds
CHUNK = 16           # blocks
HORIZON = 1024       # chunks: terrain to 16 km
SEARCH_RADIUS = 64   # chunks around 0,0 in which places are chosen


def run_json(command, **options):
    """Returns the program's output with --json, and the resource usage of the process."""
    finished = process.run(command, **options)
    try:
        return json.loads(finished.output), finished
    except ValueError as error:
        raise CompareError(f"{command[0]} {command[1]}: prints no JSON: {error}") from error


def tasks_ms(report, names):
    """Milliseconds of one thread per chunk, summed over these tasks."""
    tasks = report["tasks"]
    if not all(tasks[name]["count"] for name in names):
        raise CompareError(f"terrane render: no tasks {', '.join(names)} in its report")
    return sum(tasks[name]["milliseconds"] / tasks[name]["count"] for name in names)


def generate(program, world, seed, *area, threads=1):
    return run_json([program, "generate", "--generator", GENERATOR, *area, "--threads", threads, "--backend", "cpu",
                     "--seed", seed, "--world", world, "--json"])


def load(program, world, seed, view_distance, image):
    """Loads and lights all chunks in view; returns the report of `terrane render`."""
    report, _ = run_json([program, "render", "--world", world, "--seed", seed, "--at", "8,8,200", "--look", f"0,-{PITCH}",
                          "--preset", "low", "--view-distance", view_distance, "--horizon", 0, "--size", "64x36",
                          "--threads", 1, "--backend", "cpu", "--json", "-o", image], environment=SOFTWARE)
    return report


def measure_world(program, folder, seed, radius):
    """Generating, loading, bytes on disk: one thread."""
    world = folder / "world.sqlite"
    report, made = generate(program, world, seed, "--radius", radius)
    chunks = report["chunks"]
    # Loads one ring of chunks beyond the view.
    loaded = load(program, world, seed, radius - 1, folder / "image.png")
    light = tasks_ms(loaded, ("local light", "light")) / 1000
    read = tasks_ms(loaded, ("load",)) / 1000
    return ({"generation": chunks / (made.cpu_seconds + chunks * light), "loading": 1 / (read + light),
             "disk": world.stat().st_size / chunks},
            {"chunks": chunks, "seed": seed, "generating_cpu_s": made.cpu_seconds, "generating_s": made.seconds,
             "light_ms_chunk": 1000 * light, "read_ms_chunk": 1000 * read, "peak_rss": made.peak_rss})


def choose_places(program, folder, seed, count, radius=SEARCH_RADIUS):
    path = folder / "heights.npy"
    process.run([program, "export", "npy-heights", "--seed", seed, f"--area=-{radius},-{radius},{radius},{radius}", "-o", path])
    found = places.read_npy(path, -radius * CHUNK, SEA_LEVEL - 1).places(count)
    path.unlink()
    return found


def camera_of(place):
    x, y, z, _ = place
    return f"{x},{y},{z}"


class Frames:
    """Frames from one place. The save has all chunks in view, so that none is generated while frames are drawn."""

    def __init__(self, program, folder, seed, place, frames):
        self.program, self.folder, self.seed, self.place, self.frames = program, folder, seed, place, frames
        self.world = folder / f"frames-{seed}-{place[0]}-{place[1]}.sqlite"

    def measure(self, blocks, horizon):
        """Values of one view distance: means over four directions."""
        distance = blocks // CHUNK
        x, y = (int(n) // CHUNK for n in self.place[:2])
        margin = distance + 2
        area = f"--area={x - margin},{y - margin},{x + margin + 1},{y + margin + 1}"
        generate(self.program, self.world, self.seed, area, threads=2)
        runs = [self._render(distance, yaw, horizon) for yaw in YAWS]
        mean = lambda take: statistics.mean(take(report) for report, _ in runs)
        return {"frames": mean(lambda r: 1000 / r["milliseconds"]["frame"]),
                "triangles": mean(lambda r: r["triangles"]["opaque"] + r["triangles"]["transparent"]) / 1000,
                "rss": max(finished.peak_rss for _, finished in runs) / 1e6,
                "pss": max(finished.peak_pss for _, finished in runs) / 1e6}

    def _render(self, distance, yaw, horizon):
        return run_json([self.program, "render", "--world", self.world, "--seed", self.seed, f"--at={camera_of(self.place)}",
                         f"--look={yaw},-{PITCH}", "--frames", self.frames, "--preset", "low", "--shadows", "off",
                         "--view-distance", distance, "--horizon", horizon, "--size", SIZE, "--json", "-o",
                         self.folder / "image.png"], environment=SOFTWARE)


def measure_frames(view, blocks):
    """Without and with terrain beyond the view distance."""
    plain, far = view.measure(blocks, 0), view.measure(blocks, HORIZON)
    values = {f"{name}_{blocks}": value for name, value in plain.items()}
    values[f"frames_horizon_{blocks}"] = far["frames"]
    return values, {"camera": camera_of(view.place), "openness": view.place[3], "with_horizon": far}
