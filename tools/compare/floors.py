"""Lower bounds of the save path: memory copies, zstd and SQLite alone, with the same bytes that Terrane saves."""
import contextlib
import ctypes
import json
import sqlite3
import time

import process
import terrane
from process import CompareError

LEVEL = 1                  # zstd, as Terrane saves
COPY_BYTES, COPIES = 128 << 20, 8
HEADER_BYTES = 13          # of chunk data, before the zstd frame: checksum, version, bytes of the content
FIRST_TILE_KEY = 1 << 56   # keys from here on are of coarser levels


class Zstd:
    """libzstd, the library that Terrane uses, called without a Python package."""

    def __init__(self):
        try:
            self.library = ctypes.CDLL("libzstd.so.1")
        except OSError as error:
            raise CompareError(f"libzstd.so.1 cannot be loaded: {error}") from error
        for name in ("createCCtx", "createDCtx"):
            getattr(self.library, f"ZSTD_{name}").restype = ctypes.c_void_p
        for name in ("compressCCtx", "decompressDCtx"):
            getattr(self.library, f"ZSTD_{name}").restype = ctypes.c_size_t
        self.compressor = ctypes.c_void_p(self.library.ZSTD_createCCtx())
        self.decompressor = ctypes.c_void_p(self.library.ZSTD_createDCtx())
        self.buffer = ctypes.create_string_buffer(1 << 20)

    def _grow(self, size):
        if len(self.buffer) < size:
            self.buffer = ctypes.create_string_buffer(2 * size)

    def compress(self, data):
        """Returns the size; the frame is in `buffer`."""
        self._grow(2 * len(data) + 1024)
        size = self.library.ZSTD_compressCCtx(self.compressor, self.buffer, ctypes.c_size_t(len(self.buffer)), data,
                                              ctypes.c_size_t(len(data)), LEVEL)
        return self._checked(size)

    def decompress(self, frame, content_bytes):
        self._grow(content_bytes)
        size = self.library.ZSTD_decompressDCtx(self.decompressor, self.buffer, ctypes.c_size_t(len(self.buffer)), frame,
                                                ctypes.c_size_t(len(frame)))
        return self._checked(size)

    def _checked(self, size):
        if size > len(self.buffer):  # error codes are the largest numbers
            raise CompareError("libzstd cannot read or write the data of a chunk")
        return size


def copy_speed():
    """GB/s, the best of several copies."""
    source, target = (ctypes.create_string_buffer(bytes([value]) * COPY_BYTES, COPY_BYTES) for value in (1, 2))
    best = 0
    for _ in range(COPIES):
        start = time.perf_counter()
        ctypes.memmove(target, source, COPY_BYTES)
        best = max(best, COPY_BYTES / (time.perf_counter() - start))
    return best / 1e9


def microseconds(work, items):
    """Microseconds per item."""
    start = time.perf_counter()
    for item in items:
        work(item)
    return 1e6 * (time.perf_counter() - start) / len(items)


def saved_rows(world):
    with contextlib.closing(sqlite3.connect(f"file:{world}?mode=ro", uri=True)) as database:
        return database.execute("SELECT key, data FROM chunks WHERE key < ? ORDER BY key", (FIRST_TILE_KEY,)).fetchall()


def insert_rows(path, rows, transactions):
    """Microseconds per row until it is on disk, with the tables and pragmas of Terrane's saves."""
    size = -(-len(rows) // transactions)
    with contextlib.closing(sqlite3.connect(path, isolation_level=None)) as database:
        database.executescript("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA cache_size = -2000;"
                               "CREATE TABLE chunks (key INTEGER PRIMARY KEY, origin INTEGER NOT NULL, data BLOB NOT NULL)")
        start = time.perf_counter()
        for begin in range(0, len(rows), size):
            database.execute("BEGIN IMMEDIATE")
            database.executemany("INSERT INTO chunks VALUES (?, 0, ?)", rows[begin:begin + size])
            database.execute("COMMIT")
        return 1e6 * (time.perf_counter() - start) / len(rows)


def select_rows(path, keys):
    with contextlib.closing(sqlite3.connect(f"file:{path}?mode=ro", uri=True)) as database:
        select = lambda key: database.execute("SELECT data, origin FROM chunks WHERE key = ?", (key,)).fetchone()
        return microseconds(select, keys)


def batches_of(trace):
    """Microseconds and count of the save batches in a trace of `terrane generate`."""
    events = json.loads(trace.read_text(encoding="utf-8"))
    events = events["traceEvents"] if isinstance(events, dict) else events
    times = [event["dur"] for event in events if event.get("name") == "save batch" and "dur" in event]
    if not times:
        raise CompareError("terrane generate: its trace has no save batches")
    return sum(times), len(times)


class Floors:
    """Both sides measure the chunks of one save, which Terrane's side creates in each round."""

    def __init__(self, program, folder, radius):
        self.program, self.folder, self.radius = program, folder, radius
        self.world = folder / "floors.sqlite"

    def make_save(self):
        """Microseconds and count of batches, number of chunks."""
        for path in self.folder.glob("floors.sqlite*"):
            path.unlink()
        trace = self.folder / "trace.json"
        report, _ = terrane.run_json([self.program, "generate", "--generator", terrane.GENERATOR, "--radius",
                                      self.radius, "--threads", 1, "--backend", "cpu", "--world", self.world,
                                      "--trace", trace, "--json"])
        return (*batches_of(trace), report["chunks"])

    def ours(self):
        speed = json.loads(process.run([self.program, "bench", "--memory-copy"]).output)["bytes_per_second"]
        total, batches, chunks = self.make_save()
        loaded = terrane.load(self.program, self.world, 1, self.radius - 1, self.folder / "image.png")
        return ({"memory_copy": speed / 1e9, "save": total / chunks, "load": 1000 * terrane.tasks_ms(loaded, ("load",))},
                {"chunks": chunks, "batches": batches})

    def theirs(self):
        _, batches, _ = self.make_save()
        rows, zstd = saved_rows(self.world), Zstd()
        frames = [(data[HEADER_BYTES:], int.from_bytes(data[9:13], "little")) for _, data in rows]
        contents = [zstd.buffer.raw[:zstd.decompress(*frame)] for frame in frames]
        copy = self.folder / "insert.sqlite"
        for path in self.folder.glob("insert.sqlite*"):
            path.unlink()
        insert, select = insert_rows(copy, rows, batches), select_rows(copy, [key for key, _ in rows])
        compress = microseconds(zstd.compress, contents)
        decompress = microseconds(lambda frame: zstd.decompress(*frame), frames)
        return ({"memory_copy": copy_speed(), "save": compress + insert, "compress": compress, "insert": insert,
                 "load": select + decompress, "select": select, "decompress": decompress},
                {"chunks": len(rows), "batches": batches, "content_bytes": sum(map(len, contents)) / len(rows)})
