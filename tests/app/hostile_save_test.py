"""Malicious saves: each command that reads one ends with a one-line error.

Usage: hostile_save_test.py PROGRAM
"""
import os
import resource
import shutil
import sqlite3
import struct
import subprocess

import support
from support import ProgramTest, run

ENDLESS = ("CREATE VIEW chunks AS WITH RECURSIVE n(key) AS (SELECT 1 UNION ALL SELECT key + 1 FROM n) "
           "SELECT key, 0 AS origin, x'' AS data FROM n")
# A change to the save, and text that the message must contain.
CASES = [
    ("DROP TABLE chunks", 'the table "chunks" is missing'),
    (f"DROP TABLE chunks; {ENDLESS}", 'it has the view "chunks"'),
    ("CREATE TRIGGER burn AFTER INSERT ON settings BEGIN DELETE FROM chunks; END", 'it has the trigger "burn"'),
    ('CREATE TABLE "\x1b[2J\x1b]0;mine\x07" (a)', r'it has the table "\x1b[2j\x1b]0;mine\x07"'),
    ("DROP TABLE blocks; CREATE TABLE blocks (id INTEGER, name TEXT NOT NULL UNIQUE)", 'the table "blocks" is not'),
    ("UPDATE settings SET value = '\x1b[31m' WHERE name = 'seed'", r"\x1b[31m"),
    ("UPDATE settings SET value = '6' WHERE name = 'seed'", "the checksum of its settings and block names is wrong"),
]


def swollen_chunk(key, stone, megabytes):
    """2 KB that decompress to a chunk of that many MiB: its last block has zeros as block entity data (RFC 8878)."""
    blocks = struct.pack("<BH", 0, stone) * 16 + bytes(3) * 16
    content = blocks + struct.pack("<IHI", 1, 65535, megabytes << 20)
    frame = struct.pack("<IBB", 0xFD2FB528, 0, 0x38) + struct.pack("<I", len(content) << 3)[:3] + content
    for left in range(megabytes * 8 - 1, -1, -1):  # 128 KiB of one byte, repeated
        frame += struct.pack("<I", (128 << 10) << 3 | 1 << 1 | (left == 0))[:3] + b"\0"
    data = bytes(8) + struct.pack("<BI", 1, len(content) + (megabytes << 20)) + frame
    return support.seal(data, key, 1)


class HostileSaves(ProgramTest):
    def setUp(self):
        super().setUp()
        self.good = self.folder / "good.sqlite"
        # Its chunks have 16 sections each: see swollen_chunk().
        self.succeed("generate", "--radius", "1", "--generator", "continents", "--world", self.good)
        self.save = self.folder / "a.sqlite"

    def change(self, sql):
        """A copy of the good save, changed by SQL."""
        for path in self.folder.glob("a.sqlite*"):
            path.unlink()
        shutil.copy(self.good, self.save)
        database = sqlite3.connect(self.save)
        database.executescript(sql)
        database.close()
        return self.save.read_bytes()

    def test_every_command(self):
        npy, png = self.folder / "out.npy", self.folder / "out.png"
        commands = [
            ("generate", "--radius", "0"),
            ("dump", "--area", "0,0,1,1", "-o", npy),
            ("map", "--radius", "0", "-o", png),
            ("render", "--at", "0,0,100", "--size", "64x36", "--view-distance", "1", "-o", png),
        ]
        for sql, reason in CASES:
            before = self.change(sql)
            for command in commands:
                with self.subTest(f"{command[0]}: {sql}"):
                    done = run(*command, "--world", self.save)
                    self.assertRefused(done, command)
                    self.assertIn(reason.lower(), done.stderr.lower())
                    self.assertFalse(npy.exists() or png.exists())
            with self.subTest(f"check: {sql}"):
                done = run("check", self.save)
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn(reason.lower(), done.stdout.lower())
                self.assertRegex(done.stdout, r"\Adamage: [^\x00-\x1f]+\ndamaged\n\Z")
                self.assertEqual(done.stderr, "")
            self.assertEqual(self.save.read_bytes(), before, sql)

    # Chunks of 60 MiB each in 3 KB: more than the 1 GiB that may be in memory. A lack of memory is reported once.
    def test_a_small_file_does_not_take_all_memory(self):
        rows = 8 if support.tests_all() else 3  # of six chunks: 2.8 GiB, 1.1 GiB
        area = f"0,0,6,{rows}"
        part = area if support.tests_all() else "0,0,6,1"  # of these commands, which hold few chunks at a time
        self.change("DELETE FROM chunks")
        with sqlite3.connect(self.save) as database:
            stone = database.execute("SELECT id FROM blocks WHERE name = 'stone'").fetchone()[0]
            for k in range(6 * rows):
                key = (k % 6 + 2**27 << 28) + k // 6 + 2**27
                database.execute("INSERT INTO chunks VALUES (?, 1, ?)", (key, swollen_chunk(key, stone, 60)))
        database.close()
        self.assertLess(self.save.stat().st_size, 300 << 10)
        limit = 9 << 28
        def bound():
            resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
        for command in (("dump", "--area", area, "-o", self.folder / "out.npy"),
                        ("map", "--area", part, "-o", self.folder / "out.png"),
                        ("generate", "--area", part, "--threads", "2")):
            words = [support.program(), *map(str, command), "--world", str(self.save)]
            child = subprocess.Popen(words, stderr=subprocess.PIPE, text=True, preexec_fn=bound, env=support.environment())
            with self.subTest(command[0]):
                with child.stderr:
                    said = child.stderr.read()
                _, status, used = os.wait4(child.pid, 0)
                child.returncode = os.waitstatus_to_exitcode(status)
                self.assertEqual(child.returncode, 0, said)
                self.assertLess(used.ru_maxrss, 1600 << 10, "KiB at the most")
                if command[0] == "dump":
                    self.assertEqual(said.count("more than may be in memory"), 1, said)
        done = run("check", self.save)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn(f"{6 * rows} chunks, {6 * rows} of them edited", done.stdout)

    def test_names_are_printed_safely(self):
        self.change("INSERT INTO blocks VALUES (500, '\x1b[31mred\ngood');"
                    "UPDATE settings SET value = '' WHERE name = 'checksum'")
        done = run("check", self.save)
        self.assertIn("unknown block: \\x1b[31mred\\x0agood\n", done.stdout)
        self.assertNotIn("\x1b", done.stdout + done.stderr)
        done = run("check", self.save, "--json")
        self.assertNotIn("\x1b", done.stdout)
        done = run("dump", "--area", "0,0,1,1", "-o", self.folder / "out.npy", "--world", self.save)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("\x1b", done.stderr)


if __name__ == "__main__":
    support.main()
