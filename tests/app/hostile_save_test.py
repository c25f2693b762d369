"""Saves that somebody made to harm who opens them: each command that reads one says so in one line and ends.

Usage: hostile_save_test.py PROGRAM
"""
import shutil
import sqlite3

import support
from support import ProgramTest, run

ENDLESS = ("CREATE VIEW chunks AS WITH RECURSIVE n(key) AS (SELECT 1 UNION ALL SELECT key + 1 FROM n) "
           "SELECT key, 0 AS origin, x'' AS data FROM n")
# What is done to the save, and what the message must have.
CASES = [
    ("DROP TABLE chunks", 'the table "chunks" is missing'),
    (f"DROP TABLE chunks; {ENDLESS}", 'it has the view "chunks"'),
    ("CREATE TRIGGER burn AFTER INSERT ON settings BEGIN DELETE FROM chunks; END", 'it has the trigger "burn"'),
    ('CREATE TABLE "\x1b[2J\x1b]0;mine\x07" (a)', r'it has the table "\x1b[2j\x1b]0;mine\x07"'),
    ("DROP TABLE blocks; CREATE TABLE blocks (id INTEGER, name TEXT NOT NULL UNIQUE)", 'the table "blocks" is not'),
    ("UPDATE settings SET value = '\x1b[31m' WHERE name = 'seed'", r"\x1b[31m"),
    ("UPDATE settings SET value = '6' WHERE name = 'seed'", "the checksum of its settings and block names is wrong"),
]


class HostileSaves(ProgramTest):
    def setUp(self):
        super().setUp()
        self.good = self.folder / "good.sqlite"
        self.succeed("generate", "--radius", "1", "--world", self.good)
        self.save = self.folder / "a.sqlite"

    def change(self, sql):
        """A copy of the good save after the SQL of somebody else."""
        for path in self.folder.glob("a.sqlite*"):
            path.unlink()
        shutil.copy(self.good, self.save)
        database = sqlite3.connect(self.save)
        database.executescript(sql)
        database.close()
        return self.save.read_bytes()

    def test_every_command(self):
        out = self.folder / "out"
        commands = [
            ("generate", "--radius", "0"),
            ("dump", "--area", "0,0,1,1", "-o", out),
            ("map", "--radius", "0", "-o", out),
            ("render", "--at", "0,0,100", "--size", "64x36", "--view-distance", "1", "-o", out),
        ]
        for sql, reason in CASES:
            before = self.change(sql)
            for command in commands:
                with self.subTest(f"{command[0]}: {sql}"):
                    done = run(*command, "--world", self.save)
                    self.assertRefused(done, command)
                    self.assertIn(reason.lower(), done.stderr.lower())
                    self.assertFalse(out.exists())
            with self.subTest(f"check: {sql}"):
                done = run("check", self.save)
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn(reason.lower(), done.stdout.lower())
                self.assertRegex(done.stdout, r"\Adamage: [^\x00-\x1f]+\ndamaged\n\Z")
                self.assertEqual(done.stderr, "")
            self.assertEqual(self.save.read_bytes(), before, sql)

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
