"""Tables that the thesis does not have: goals, stages, passes, memory, disk."""

from .cells import (MEMORY_COPY, SCENES, flight, frame, generate_one_thread, generating, loading, merging, pixels,
                    view_distances)
from .table import CHUNKS_IN_VIEW, FRAME_MS, LOAD_SECONDS, Entry, Plot, Table, Value, share, total, value

BLOCK_BYTES = 2.0 * 65536  # of a chunk, unpacked


def goals(s):
    """Goals of the program on two cores without a graphics card, and measured values."""
    generated, loaded = generating("landscape", s.view_distance), loading("landscape", s.view_distance)
    flown, distance = flight(s, False), f"V={s.view_distance}"

    def task(name):  # milliseconds for each chunk in view
        return Value(f"/tasks/{name}/milliseconds", per=CHUNKS_IN_VIEW)

    def kilobytes(owner):
        return Value(f"/bytes/{owner}", 1e-3, per=CHUNKS_IN_VIEW)

    def of_flight(name):
        return value(flown, Value(f"/flight/{name}"))

    rows = [
        ["generating with one thread, chunks/s", "≥ 1500",
         value(generate_one_thread(s), Value("/chunks_per_second")), "41–84"],
        ["light from scratch, both stages, ms per chunk", "≤ 0.25",
         total(generated, [task("local light"), task("light")]), "9.7"],
        ["mesh, ms per chunk", "≤ 0.04", value(generated, task("mesh")), "–"],
        [f"load all in view, generating, s, {distance}", "≤ 6", value(generated, LOAD_SECONDS), "–"],
        [f"load all in view from a save, s, {distance}", "≤ 4", value(loaded, LOAD_SECONDS), "41"],
        ["RAM, blocks and light, kB per chunk", "≤ 44",
         total(generated, [kilobytes("blocks"), kilobytes("light")]), "313"],
        ["GPU, quads and light, kB per chunk", "≤ 42",
         total(generated, [kilobytes("quads_gpu"), kilobytes("light_gpu")]), "259"],
        ["save, kB per chunk", "≤ 2.5", value(loaded, Value("/bytes/save", 1e-3, per="/chunks")), "–"],
        ["opaque triangles, greedy, % of squares ext", "≤ 90",
         share(merging(s, "landscape", "greedy"), merging(s, "landscape", "squares-ext"), Value("/triangles/opaque")),
         "100"],
        ["flight while generating: frames over twice the median because of loading", "0",
         of_flight("of_these_by_loading"), "–"],
        ["frames over twice the median for any reason", "–", of_flight("frames_over_twice_the_median"), "–"],
        ["most CPU time of loading in one frame, ms", "–", of_flight("most_loading_ms"), "–"],
        ["slowest frame of the flight, ms", "–", of_flight("slowest_frame_ms"), "600"],
        ["median frame of the flight, ms", "–", of_flight("frame_ms"), "–"],
    ]
    return Table(
        "goals", "Goals on two cores without a graphics card",
        "Landscape, overworld, `--preset low` at 320x180. The goals are for V=32 (view distance in chunks) and a quiet machine. "
        "The last column is the thesis, with a graphics card.",
        "view distance, area, time of flight", ["quantity", "goal", "measured", "thesis"], rows)


def floor(cell, values, more_bytes):
    """µs to read and write the bytes of a stage at the speed of copying."""
    def compute(results):
        read_and_written = more_bytes + sum(what.of(results, cell) or 0 for what in values)
        speed = results.number(MEMORY_COPY, "/bytes_per_second")
        return 1e6 * read_and_written / (2 * speed) if speed and speed > 0 else None
    return Entry([cell, MEMORY_COPY], compute)


def stages(s):
    generated, loaded = generating("landscape", s.view_distance), loading("landscape", s.view_distance)
    blocks, save = Value("/bytes/blocks", per="/chunks"), Value("/bytes/save", per="/chunks")
    light, light_gpu, quads = (Value(f"/bytes/{owner}", per=CHUNKS_IN_VIEW)
                               for owner in ("light", "light_gpu", "quads_gpu"))

    def task(name):  # microseconds
        return Value(f"/tasks/{name}/milliseconds", 1000, per=f"/tasks/{name}/count")

    # The time of a stage, and the bytes of a chunk that it reads and writes at least.
    rows = [[name, value(cell, microseconds), floor(cell, values, more_bytes), limit]
            for name, cell, microseconds, values, more_bytes, limit in (
                ("generate", generated, task("generate"), [blocks], 4 * BLOCK_BYTES,
                 "two voxel passes write all blocks, one reads them, packing reads them; the rest is arithmetic"),
                ("load from a save", loaded, task("load"), [blocks, save], 0,
                 "reading a row of SQLite, decompressing"),
                ("light, stage 1", loaded, task("local light"), [blocks, light], 0,
                 "non-uniform bricks: 5 to 6 per chunk, unpacked to a few bytes per block and searched"),
                ("light, stage 2", loaded, task("light"), [light, light], 0,
                 "twelve borders to neighbors, changed rows, packing"),
                ("mesh", loaded, task("mesh"), [blocks, quads], 0, "bit planes of sections, merging faces"),
                ("upload", loaded, Value("/milliseconds/upload", 1000, per=CHUNKS_IN_VIEW),
                 [quads, quads, light_gpu, light_gpu], 0, "the driver's copies"))]
    rows.append(["memory copied by one thread, GB/s", value(MEMORY_COPY, Value("/bytes_per_second", 1e-9)), "–", ""])
    return Table(
        "stages", "Stages of a chunk",
        f"Landscape, V={s.view_distance}: time of a worker thread (upload: of the main thread) per chunk. The "
        "column `memory alone` is the time to read and write the bytes of the stage at the speed at which one thread "
        "copies memory here. It is a lower bound for any program; the difference is other work.",
        "view distance", ["stage", "µs per chunk", "memory alone, µs", "main work"], rows)


PASSES = ("cull", "shadow map", "surfaces", "depth pyramid", "cull again", "surfaces again", "sky", "shade", "peel",
          "shade layers", "god rays", "depth of field", "final")


def passes(s):
    rows = []
    for name, pointer in [*((name, f"/passes/{name}") for name in PASSES), ("the frame", FRAME_MS.pointer)]:
        rows.append([name, *(value(frame(s, scene), Value(pointer)) for scene in SCENES),
                     value(frame(s, "landscape"), Value(pointer, 1e6 / pixels(s.size)))])
    return Table(
        "passes", "Passes of the frame",
        f"GPU milliseconds of each pass, {s.size}, V={s.view_distance}. The last column is nanoseconds per pixel of "
        "the image (the software renderer draws 4 samples each). A pass that does not run has no time; "
        "shadow maps are kept while the sun and the camera stand still.",
        "view distance, size", ["pass", *(f"{scene}, ms" for scene in SCENES), "landscape, ns per pixel"], rows,
        [Plot("pass", "milliseconds", [1, 2, 3, 4])])


OWNERS = (("blocks", "blocks"), ("light", "light"), ("light of stage 1, until neighbors are lit", "light_of_stage_1"),
          ("fields of the generator", "generator_cache"), ("quads on the GPU", "quads_gpu"),
          ("light on the GPU", "light_gpu"), ("the process", "process"), ("the process at its peak", "process_peak"))


def memory_by_owner(s):
    rows = []
    for name, owner in OWNERS:
        megabytes = [value(generating("landscape", distance), Value(f"/bytes/{owner}", 1e-6))
                     for distance in view_distances(s)]
        rows.append([name, *megabytes, value(generating("landscape", s.view_distance),
                                             Value(f"/bytes/{owner}", 1e-3, per=CHUNKS_IN_VIEW))])
    return Table(
        "memory-by-owner", "Memory by owner",
        "Landscape, MB. The last column is for the largest view distance, per chunk in view. Without a graphics card, "
        "the memory of the process includes GPU memory.",
        "smaller view distances", ["owner", *(f"V={distance}" for distance in view_distances(s)), "kB per chunk"], rows)


def disk(s):
    rows = []
    for scene in SCENES:
        cell = loading(scene, s.view_distance)
        rows.append([scene, value(cell, Value("/chunks")), value(cell, Value("/bytes/save", 1e-6)),
                     value(cell, Value("/bytes/save", per="/chunks")), value(cell, LOAD_SECONDS)])
    return Table("disk", "Saves", "A save with all chunks in view of a scene.", "view distance",
                 ["scene", "chunks", "file, MB", "bytes per chunk", "load all in view, s"], rows)


def own_tables(s):
    return [stages(s), passes(s), memory_by_owner(s), disk(s)]
