#!/usr/bin/env python3
"""Compares the example reader of saves, which follows docs/file-format.md alone, with the program.
Usage: read_save_test.py PROGRAM. Exit code 77 if Python has no zstandard or xxhash."""
import json
import os
import pathlib
import random
import sqlite3
import struct
import subprocess
import sys

try:
    import xxhash
    import zstandard
except ImportError:
    # Debian's packages are for Debian's Python, which may not be the one of the build.
    OTHER = "/usr/bin/python3"
    if os.path.realpath(sys.executable) == os.path.realpath(OTHER) or "TERRANE_SECOND_TRY" in os.environ:
        print("skipped: needs python3-zstandard and python3-xxhash")
        sys.exit(77)
    os.execve(OTHER, [OTHER, "-B", *sys.argv], os.environ | {"TERRANE_SECOND_TRY": "1"})

import support
from support import Npy, ProgramTest

READER = pathlib.Path(__file__).resolve().parents[2] / "examples" / "read_save.py"


class ReadSave(ProgramTest):
    def setUp(self):
        super().setUp()
        self.save = self.folder / "w.sqlite"
        self.succeed("generate", "--generator", "continents", "--area", "-8,12,-5,14", "--world", self.save)
        self.names = {t["id"]: t["name"] for t in json.loads(self.succeed("blocks", "--json"))}

    def reader(self, *arguments):
        return subprocess.run([sys.executable, "-B", str(READER), *map(str, arguments)], capture_output=True, text=True,
                              timeout=support.HANG_SECONDS, check=False)

    def blocks_by_reader(self, cx, cy):
        out = self.folder / "out.bin"
        done = self.reader(self.save, cx, cy, out)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with sqlite3.connect(self.save) as save:
            names = dict(save.execute("SELECT id, name FROM blocks"))
        blocks = [names[v] for v in struct.unpack("<65536H", out.read_bytes())]
        counts = {name: int(count) for count, name in (line.split(" ") for line in done.stdout.splitlines())}
        self.assertEqual(counts, {name: blocks.count(name) for name in set(blocks)})
        return blocks

    def blocks_by_program(self, cx, cy):
        out = self.folder / "out.npy"
        self.succeed("dump", "--area", f"{cx},{cy},{cx + 1},{cy + 1}", "--world", self.save, "-o", out)
        volume = Npy(out).volume()
        return [self.names[volume[(x * 16 + y) * 256 + z]] for z in range(256) for y in range(16) for x in range(16)]

    def assertSame(self, cx, cy):
        blocks = self.blocks_by_reader(cx, cy)
        self.assertEqual(blocks == self.blocks_by_program(cx, cy), True, f"chunk {cx},{cy}")
        return blocks

    def put(self, cx, cy, content):
        rest = struct.pack("<BI", 1, len(content)) + zstandard.ZstdCompressor(level=1).compress(content)
        key = (cx + 2**27 << 28) + cy + 2**27
        with sqlite3.connect(self.save) as save:
            save.execute("UPDATE chunks SET data = ? WHERE key = ?", [self.sealed(rest, 2 * key), key])

    @staticmethod
    def sealed(rest, seed):
        return struct.pack("<Q", xxhash.xxh64_intdigest(rest, seed)) + rest

    def reseal(self, save, seed_of):
        """Recomputes the checksums of all chunks, by a function of key and origin."""
        for key, origin, data in save.execute("SELECT key, origin, data FROM chunks").fetchall():
            save.execute("UPDATE chunks SET data = ? WHERE key = ?", [self.sealed(data[8:], seed_of(key, origin)), key])

    def test_generated_chunks(self):
        kinds = set()
        for cx in range(-8, -5):
            for cy in range(12, 14):
                kinds |= set(self.assertSame(cx, cy))
        self.assertTrue({"air", "stone", "grass", "glowing_mushroom"} <= kinds, kinds)

    def test_ids_are_those_of_the_file(self):
        before = self.blocks_by_reader(-7, 13)
        with sqlite3.connect(self.save) as save:
            save.execute("UPDATE blocks SET name = 'x' WHERE name = 'stone'")
            save.execute("UPDATE blocks SET name = 'stone' WHERE name = 'snow'")
            save.execute("UPDATE blocks SET name = 'snow' WHERE name = 'x'")
        self.assertIn("checksum of settings and names", self.reader(self.save, -7, 13).stderr)
        with sqlite3.connect(self.save) as save:
            save.execute("UPDATE settings SET value = '' WHERE name = 'checksum'")
        after = self.assertSame(-7, 13)
        self.assertEqual(after.count("snow"), before.count("stone"))

    # All valid forms of a section, including those that the program does not write.
    def test_every_form_of_a_section(self):
        rng = random.Random(5)
        with sqlite3.connect(self.save) as save:
            ids = [i for i, name in save.execute("SELECT id, name FROM blocks") if name != "missing"]
        heads, bodies = b"", b""
        for section in range(16):
            bits = (0, 1, 2, 4, 8, 16)[section % 6]
            if bits == 0:
                heads += struct.pack("<BH", 0, ids[section])
            elif bits == 16:
                heads += b"\x10"
                bodies += struct.pack("<4096H", *rng.choices(ids, k=4096))
            else:
                palette = rng.sample(ids, min(2**bits, len(ids)))
                heads += struct.pack(f"<BH{len(palette)}H", bits, len(palette), *palette)
                number = sum(rng.randrange(len(palette)) << bits * n for n in range(4096))
                bodies += number.to_bytes(512 * bits, "little")
        self.put(-7, 13, heads + bytes(3) * 16 + bodies + bytes(4))
        self.assertGreater(len(set(self.assertSame(-7, 13))), 20)

    def test_former_formats_and_levels(self):
        blocks = self.blocks_by_reader(-7, 13)
        with sqlite3.connect(self.save) as save:
            self.assertEqual(save.execute("PRAGMA user_version").fetchone(), (3,))
            key = (-7 + 2**27 << 28) + 13 + 2**27
            save.execute("UPDATE chunks SET key = ? WHERE key = ?", [(3 << 56) + key, key])
        self.assertIn("checksum", self.reader(self.save, -7, 13, "", 3).stderr, "the key is another one")
        with sqlite3.connect(self.save) as save:
            self.reseal(save, lambda key, origin: 2 * key + origin)
        out = self.folder / "level.bin"
        done = self.reader(self.save, -7, 13, out, 3)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with sqlite3.connect(self.save) as save:
            names = dict(save.execute("SELECT id, name FROM blocks"))
        self.assertEqual([names[v] for v in struct.unpack("<65536H", out.read_bytes())], blocks)
        self.assertIn("chunk -7,13 of level 0 was not saved", self.reader(self.save, -7, 13).stderr)
        for number in (2, 1):
            with sqlite3.connect(self.save) as save:  # as in formats 1 and 2
                save.execute("DELETE FROM chunks WHERE key >= ?", [1 << 56])
                save.execute("DELETE FROM settings WHERE name = 'checksum'")
                self.reseal(save, lambda key, origin: 0)
                save.execute(f"PRAGMA user_version = {number}")
            self.assertSame(-6, 12)
            with sqlite3.connect(self.save) as save:
                self.assertEqual(save.execute("PRAGMA user_version").fetchone(), (number,), "read by the program as it is")
            self.succeed("generate", "--area", "-8,12,-5,14", "--world", self.save)
            self.assertSame(-6, 12)
            self.assertEqual(self.blocks_by_reader(-7, 13), blocks, "generated again")
            with sqlite3.connect(self.save) as save:
                self.assertEqual(save.execute("PRAGMA user_version").fetchone(), (3,))
        self.assertTrue((self.folder / "w.before-migration-2.sqlite").exists())

    def test_what_is_wrong_is_said(self):
        for arguments in ((self.save, 99, 99), (__file__, 0, 0), (self.folder / "none.sqlite", 0, 0), ()):
            done = self.reader(*arguments)
            self.assertNotEqual(done.returncode, 0, arguments)
            self.assertNotIn("Traceback", done.stderr, arguments)
        with sqlite3.connect(self.save) as save:
            save.execute("UPDATE chunks SET data = CAST(substr(data, 1, length(data) - 1) || x'00' AS BLOB)")
        self.assertIn("checksum", self.reader(self.save, -7, 13).stderr)


if __name__ == "__main__":
    support.main()
