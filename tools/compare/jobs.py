"""The jobs of a comparison on both sides, in full and quick size."""
import json
import pathlib
import shutil
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass

import floors
import luanti
import luanti_view
import process
import terrane
from measures import VIEW_DISTANCES
from process import CompareError

SEEDS = (42, 1, 7, 2026, 5)  # of generated worlds, one per round
FRAMES_SEED = 42             # of the worlds for frames


@dataclass(frozen=True)
class Sizes:
    mapchunks: int          # of 80 blocks, per side of Luanti's area, 240 blocks high
    radius: int             # chunks, of an area of Terrane with about as many blocks
    floors_radius: int      # chunks
    search_mapchunks: int   # per side of the area in which places are chosen
    search_radius: int      # chunks, the same of Terrane
    places: int
    view_distances: tuple   # blocks
    seconds: float          # of Luanti's frames in each direction
    fill_seconds: float     # at most, to fill its view
    frames: int             # of Terrane in each direction


FULL = Sizes(mapchunks=11, radius=26, floors_radius=32, search_mapchunks=26, search_radius=64, places=5,
             view_distances=VIEW_DISTANCES, seconds=10, fill_seconds=1800, frames=9)
QUICK = Sizes(mapchunks=3, radius=7, floors_radius=8, search_mapchunks=13, search_radius=32, places=1,
              view_distances=VIEW_DISTANCES[:1], seconds=4, fill_seconds=300, frames=3)


@dataclass(frozen=True)
class Job:
    name: str
    group: str         # for --only
    terrane: Callable  # (round number) -> values by measure, details
    peer: Callable

    def side(self, name):
        return self.terrane if name == "terrane" else self.peer


class Comparison:
    """Worlds for frames and their places stay in `work`, for all rounds and for a resumed run."""

    def __init__(self, program, work, sizes):
        self.program, self.work, self.sizes = program, work, sizes

    def jobs(self):
        yield Job("world", "luanti", self.terrane_world, self.luanti_world)
        for blocks in self.sizes.view_distances:
            yield Job(f"frames_{blocks}", "luanti", lambda n, blocks=blocks: self.terrane_frames(n, blocks),
                      lambda n, blocks=blocks: self.luanti_frames(n, blocks))
        yield Job("joining", "luanti", self.terrane_joining, self.luanti_joining)
        yield Job("floors", "floors", lambda _: self.floors(lambda f: f.ours()), lambda _: self.floors(lambda f: f.theirs()))

    def scratch(self):
        return tempfile.TemporaryDirectory(dir=self.work)

    def terrane_world(self, number):
        with self.scratch() as folder:
            return terrane.measure_world(self.program, pathlib.Path(folder), seed_of(number), self.sizes.radius)

    def luanti_world(self, number):
        with self.scratch() as folder:
            return luanti.measure_world(pathlib.Path(folder), seed_of(number), self.sizes.mapchunks)

    def floors(self, measure):
        with self.scratch() as folder:
            return measure(floors.Floors(self.program, pathlib.Path(folder), self.sizes.floors_radius))

    def prepare(self):
        """Chooses the places on both sides and generates Luanti's land around them. The measurements need no more of it, so
        this may run on a busy machine."""
        search, _ = self.luanti_place(1)
        for number in range(1, self.sizes.places + 1):
            search.generate_around(self.luanti_place(number)[1], max(self.sizes.view_distances))
        self.terrane_place(1)

    def terrane_place(self, number):
        folder = self.folder("terrane")
        return self.place("terrane", number, lambda: terrane.choose_places(
            self.program, folder, FRAMES_SEED, self.sizes.places, self.sizes.search_radius))

    def luanti_place(self, number):
        search = luanti_view.Search(self.folder("luanti"), FRAMES_SEED, self.sizes.search_mapchunks)
        return search, self.place("luanti", number, lambda: search.choose(self.sizes.places))

    def terrane_frames(self, number, blocks):
        folder, place = self.folder("terrane"), self.terrane_place(number)
        return terrane.measure_frames(terrane.Frames(self.program, folder, FRAMES_SEED, place, self.sizes.frames), blocks)

    def luanti_frames(self, number, blocks):
        search, place = self.luanti_place(number)
        return luanti_view.measure_frames(search, place, blocks, self.sizes.seconds, self.sizes.fill_seconds)

    def folder(self, name):
        path = self.work / name
        path.mkdir(exist_ok=True)
        return path

    def place(self, side, number, choose):
        """The place of a round, chosen in the first round."""
        path = self.work / f"places-{side}.json"
        if not path.exists():
            found = choose()
            if len(found) < self.sizes.places:
                raise CompareError(f"{side}: only {len(found)} of {self.sizes.places} open places were found")
            path.write_text(json.dumps(found), encoding="ascii")
        places = json.loads(path.read_text(encoding="ascii"))
        return places[(number - 1) % len(places)]

    def terrane_joining(self, _):
        with self.scratch() as folder:
            row = joining().terrane(self.program, pathlib.Path(folder))
        return {"join_kb": row["kb"]}, row

    def luanti_joining(self, _):
        client, server, _ = (process.find_program(names, luanti.HINT + " xvfb")
                             for names in (luanti.CLIENTS, luanti.SERVERS, ("xvfb-run",)))
        with self.scratch() as folder:
            row = joining().luanti(pathlib.Path(folder), client, server)
        return {"join_kb": row["kb"]}, row


def joining():
    """tools/joining.py: the measurement of joining alone."""
    sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
    import joining as module  # pylint: disable=import-outside-toplevel
    return module


def seed_of(number):
    return SEEDS[(number - 1) % len(SEEDS)]


def clean(work):
    """Removes the remains of an interrupted run."""
    for path in work.glob("tmp*"):
        shutil.rmtree(path, ignore_errors=True)
