"""All rows of the table: measure, unit, and method on each side."""
from dataclasses import dataclass

# 16×16×256, the size of a chunk of Terrane: the common unit of worlds.
BLOCKS_OF_A_CHUNK = 65536
VIEW_DISTANCES = (128, 256, 512)  # blocks

HIGHER, LOWER, NEITHER = "higher", "lower", "neither"


@dataclass(frozen=True)
class Measure:
    name: str     # in results.jsonl
    title: str
    unit: str
    better: str   # HIGHER or LOWER; NEITHER: the row describes the load
    peer: str
    ours: str     # Terrane's method
    theirs: str   # the peer's method


def frame_measures():
    for blocks in VIEW_DISTANCES:
        yield Measure(f"frames_{blocks}", f"Frames, view distance {blocks} blocks", "frames/s", HIGHER, "Luanti",
                      "`render --preset low --shadows off --horizon 0`", "default renderer, no shadows, no clouds")
        yield Measure(f"frames_horizon_{blocks}", f"Frames, {blocks} blocks, with Terrane's land to 16 km",
                      "frames/s", HIGHER, "Luanti", "the same with `--horizon 1024`",
                      "as above: nothing beyond the view distance")
        yield Measure(f"triangles_{blocks}", f"Triangles drawn, {blocks} blocks", "thousands per frame", NEITHER, "Luanti",
                      "after culling, opaque and transparent", "vertices of its profiler / 2, as its quads have four")
        yield Measure(f"rss_{blocks}", f"Peak resident memory, {blocks} blocks", "MB", LOWER, "Luanti",
                      "the process that draws", "client and server in one process")
        yield Measure(f"pss_{blocks}", f"Peak proportional memory (PSS), {blocks} blocks", "MB", LOWER, "Luanti",
                      "the process that draws", "client and server in one process")


WORLD = (
    Measure("generation", "Generating with light and saving", "chunks per CPU second", HIGHER, "Luanti",
            "`generate --world`, and light from scratch added, as saves do not contain light",
            "mapgen v7 of Minetest Game with decorations, ores, caves, light, SQLite; start of the server left out"),
    Measure("loading", "Loading from a save, with light", "chunks per CPU second", HIGHER, "Luanti",
            "reading and decoding, and light from scratch", "reading and decoding; its saves contain light"),
    Measure("disk", "Bytes on disk", "bytes per chunk", LOWER, "Luanti", "the whole file",
            "the file without the border of the area"),
)

JOINING = (
    Measure("join_kb", "Traffic of joining, view of 256 blocks", "kB", LOWER, "Luanti",
            "a bot, until it knows all edits in view; both ways with TLS. A client generates the land itself",
            "a client with a window and the game's media, until no more data arrives; both ways over UDP"),
)

FLOORS = (
    Measure("memory_copy", "Copying memory, one thread", "GB/s", HIGHER, "memcpy", "`bench --memory-copy`: memcpy, the same",
            "memmove of 128 MiB, the best of eight"),
    Measure("save", "Saving a chunk, to the disk", "µs per chunk", LOWER, "zstd + SQLite",
            "batches of `generate --world`: pack, compress, checksum, insert, commit",
            "the same contents: compress at level 1, insert, commit (WAL, `synchronous` full)"),
    Measure("compress", "of which compressing", "µs per chunk", LOWER, "zstd", "", "level 1, the same contents"),
    Measure("insert", "of which inserting rows", "µs per chunk", LOWER, "SQLite", "", "the same rows in as many transactions"),
    Measure("load", "Reading and decoding a chunk", "µs per chunk", LOWER, "zstd + SQLite",
            "`render --world`: select, checksum, decompress, unpack", "the same rows: select, decompress"),
    Measure("decompress", "of which decompressing", "µs per chunk", LOWER, "zstd", "", "the same rows"),
    Measure("select", "of which selecting rows", "µs per chunk", LOWER, "SQLite", "", "one statement per chunk, by key"),
)

MEASURES = (*WORLD, *frame_measures(), *JOINING, *FLOORS)
