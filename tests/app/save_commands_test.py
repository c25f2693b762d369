#!/usr/bin/env python3
"""generate, dump, check and copy with saves, also while another process has them open. Usage: save_commands_test.py PROGRAM"""
import fcntl
import json
import os
import pathlib
import shutil
import sqlite3
import subprocess
import time

import support
from support import Npy, Image, ProgramTest, run

FLAT = ("--generator", "flat")


class Saves(ProgramTest):
    """generate, dump and check with a save."""

    def setUp(self):
        super().setUp()
        self.save = self.folder / "a.sqlite"

    def generate(self, *arguments):
        text = self.succeed("generate", "--backend", "cpu", "--json", "--digest", *arguments)
        return json.loads(text)

    def sql(self, text):
        with sqlite3.connect(self.save) as database:
            rows = database.execute(text).fetchall()
            if not text.startswith("SELECT"):  # the program finds the checksum
                database.execute("UPDATE settings SET value = '' WHERE name = 'checksum'")
        database.close()
        return rows

    def mark_as_edited(self, key):
        with sqlite3.connect(self.save) as database:
            data = database.execute("SELECT data FROM chunks WHERE key = ?", (key,)).fetchone()[0]
            database.execute("UPDATE chunks SET origin = 1, data = ? WHERE key = ?", (support.seal(data, key, 1), key))
        database.close()

    def test_only_what_is_missing_is_generated(self):
        first = self.generate("--world", self.save, "--seed", "5", "--radius", "1")
        self.assertEqual((first["chunks"], first["skipped"]), (9, 0))
        again = self.generate("--world", self.save, "--radius", "1")
        self.assertEqual((again["chunks"], again["skipped"], again["digest"]), (0, 9, first["digest"]))
        more = self.generate("--world", self.save, "--radius", "2")
        self.assertEqual((more["chunks"], more["skipped"]), (16, 9))
        self.assertEqual(more["digest"], self.generate("--seed", "5", "--radius", "2")["digest"])

    def test_another_world_is_refused(self):
        self.generate("--world", self.save, "--seed", "5", "--radius", "0")
        before = self.save.read_bytes()
        for arguments, hint in ((("--seed", "6"), "seed 5, not 6"), (FLAT, "generator wilderness, not flat")):
            for more in ((), ("--recreate",)):
                done = run("generate", "--world", self.save, "--radius", "0", *arguments, *more)
                self.assertRefused(done, (arguments, more))
                self.assertIn(hint, done.stderr)
        self.assertEqual(self.save.read_bytes(), before)
        self.assertFalse((self.folder / "a.backup-1.sqlite").exists())

    def test_recreate_keeps_the_generator_that_made_the_world(self):
        first = self.generate("--world", self.save, "--radius", "1", *FLAT)
        anew = self.generate("--world", self.save, "--radius", "1", "--recreate")
        self.assertEqual((anew["skipped"], anew["digest"]), (0, first["digest"]))
        self.sql("UPDATE settings SET value = 'gone' WHERE name = 'generator'")
        done = run("generate", "--world", self.save, "--radius", "1", "--recreate")
        self.assertRefused(done, "a generator of another program")
        self.assertIn("made by the generator gone, which this program does not have", done.stderr)

    def test_another_version_of_the_generator_is_refused_and_recreate_makes_it_anew(self):
        self.generate("--world", self.save, "--radius", "1", "--seed", "5")
        self.sql("UPDATE settings SET value = '99' WHERE name = 'generator_version'")
        done = run("generate", "--world", self.save, "--radius", "1")
        self.assertRefused(done, "version")
        self.assertIn("version 99", done.stderr)
        anew = self.generate("--world", self.save, "--radius", "1", "--recreate")
        self.assertEqual((anew["chunks"], anew["skipped"]), (9, 0))
        self.assertEqual(self.sql("SELECT value FROM settings WHERE name = 'seed'"), [("5",)])
        self.assertTrue((self.folder / "a.backup-1.sqlite").exists())

    def test_chunks_with_edits_stay_where_the_generator_has_changed(self):
        self.generate("--world", self.save, "--radius", "1", "--seed", "5")
        self.sql("UPDATE settings SET value = '99' WHERE name = 'generator_version'")
        key = 2**27 << 28 | 2**27
        self.mark_as_edited(key)
        kept = self.sql(f"SELECT data FROM chunks WHERE key = {key}")
        anew = self.generate("--world", self.save, "--radius", "1", "--regenerate", "keep-edits")
        self.assertEqual((anew["chunks"], anew["skipped"]), (8, 1))
        self.assertEqual(self.sql(f"SELECT data FROM chunks WHERE key = {key}"), kept)
        self.assertTrue((self.folder / "a.backup-1.sqlite").exists())
        for arguments in (("--regenerate", "all"), ("--recreate", "--regenerate", "keep-edits")):
            self.assertRefused(run("generate", "--world", self.save, "--radius", "1", *arguments), arguments)

    def test_a_world_without_generated_chunks(self):
        fly = ("flight-bench", "--at", "8,8,120", "--world", self.save, "--horizon", "0", "--view-distance", "1", "--size", "32x18", "--preset",
               "low", "--duration", "0.1", "--json", "--generator", "continents")
        self.succeed(*fly, "--store-generated", "off")
        self.succeed(*fly)
        self.assertEqual(self.sql("SELECT count(*) FROM chunks"), [(0,)], "the world keeps it")
        self.succeed(*fly, "--store-generated", "on")
        self.assertGreater(self.sql("SELECT count(*) FROM chunks")[0][0], 8)

    def test_dump_takes_what_the_save_has(self):
        self.succeed("generate", "--world", self.save, "--radius", "1", *FLAT)
        plain, saved = self.folder / "plain.npy", self.folder / "saved.npy"
        self.succeed("dump", "--area", "0,0,3,1", "-o", plain, *FLAT)
        self.succeed("dump", "--area", "0,0,3,1", "-o", saved, "--world", self.save)
        self.assertEqual(Npy(plain).data, Npy(saved).data, "two chunks are in the save, one is generated")
        # Another name for the same id shows that the blocks come from the save.
        self.sql("UPDATE blocks SET name = 'sand_' WHERE name = 'sand'")
        self.sql("UPDATE blocks SET name = 'sand' WHERE name = 'stone'")
        self.succeed("dump", "--area", "0,0,1,1", "-o", saved, "--world", self.save)
        ids = {block["name"]: block["id"] for block in json.loads(self.succeed("blocks", "--json"))}
        self.assertEqual(Npy(saved).column(3, 3)[0], ids["sand"])

    def test_map_and_record_show_what_the_save_has_and_leave_it_as_it_is(self):
        self.succeed("generate", "--world", self.save, "--radius", "2", *FLAT)
        plain, drawn = self.folder / "plain.png", self.folder / "drawn.png"
        area = ("--area", "-1,-1,2,2")
        self.succeed("map", *area, "-o", plain, *FLAT)
        self.succeed("map", *area, "-o", drawn, "--world", self.save)
        self.assertEqual(plain.read_bytes(), drawn.read_bytes(), "the save has the generator, too")
        middle = (2**27 << 28) + 2**27  # chunk 0,0: unedited blocks are as generated
        self.edit_chunk(middle, self.sql(f"SELECT data FROM chunks WHERE key = {middle}")[0][0])
        self.sql("UPDATE blocks SET name = 'sand_' WHERE name = 'sand'")
        self.sql("UPDATE blocks SET name = 'sand' WHERE name = 'grass'")
        before = self.save.read_bytes()
        self.succeed("map", *area, "-o", drawn, "--world", self.save)
        self.assertNotEqual(plain.read_bytes(), drawn.read_bytes(), "sand in place of grass")
        path = self.folder / "path.toml"
        path.write_text("[[shot]]\nseconds = 1\nkey = [{ at = [8, 8, 90], look = [0, -80] }]\n"
                        "edit = [{ at = [8, 8, 81], block = 'stone' }]\n")
        self.succeed("record", "--path", path, "--frames-dir", self.folder / "frames", "--size", "64x48", "--fps", "1",
                     "--view-distance", "1", "--preset", "low", "--world", self.save)
        self.assertEqual(self.save.read_bytes(), before)

    def edit_chunk(self, key, data):
        """Replaces a chunk of the save by edited data."""
        with sqlite3.connect(self.save) as database:
            database.execute("INSERT OR REPLACE INTO chunks VALUES (?, 1, ?)", (key, support.seal(data, key, 1)))
        database.close()

    def test_a_map_shows_edits_and_generates_the_rest(self):
        land = self.folder / "land.sqlite"
        self.succeed("generate", "--world", land, "--area", "0,0,1,1", "--generator", "overworld")
        with sqlite3.connect(land) as database:
            hill = database.execute("SELECT data FROM chunks").fetchone()[0]
        database.close()
        self.succeed("generate", "--world", self.save, "--area", "0,0,1,1", *FLAT)
        self.edit_chunk((1 + 2**27 << 28) + 2**27, hill)  # chunk 1,0
        before = self.save.read_bytes()
        for level, size in (("0", 16), ("1", 8)):
            area = ("--area", "-2,-2,4,4", "--level", level)
            self.succeed("map", *area, *FLAT, "-o", self.folder / "plain.png")
            self.succeed("map", *area, "--world", self.save, "-o", self.folder / "edited.png")
            plain, edited = Image(self.folder / "plain.png").rows, Image(self.folder / "edited.png").rows
            changed = {(x // size, y // size) for y, row in enumerate(plain) for x, pixel in enumerate(row)
                       if edited[y][x] != pixel}
            places = {(3 - x, y - 2) for x, y in changed}  # north, -y, is up, and east, -x, to the right
            self.assertIn((1, 0), places)
            self.assertTrue(all(abs(x - 1) <= 1 and abs(y) <= 1 for x, y in places), "shade may reach a neighbor")
        self.assertEqual(self.save.read_bytes(), before)

    def run_here(self, *arguments):
        """Runs with the test's folder as the folder of named worlds."""
        variables = {**support.environment(), "XDG_DATA_HOME": str(self.folder)}
        return subprocess.run([support.program(), *map(str, arguments)], capture_output=True, text=True, cwd=self.folder,
                              timeout=support.HANG_SECONDS, env=variables, check=False)

    def test_a_world_has_a_name_a_file_or_a_url(self):
        area = ("--backend", "cpu", "--json", "--radius", "0")
        made = self.run_here("generate", *area, "--world", "home", "--seed", "5")
        self.assertEqual((made.returncode, json.loads(made.stdout)["chunks"]), (0, 1), made.stderr)
        (self.save,) = self.folder.glob("*/home.sqlite")
        for name in ("home", self.save, self.save.relative_to(self.folder)):
            again = self.run_here("generate", *area, "--world", name)
            self.assertEqual((again.returncode, json.loads(again.stdout)["skipped"]), (0, 1), again.stderr)
        self.assertTrue(self.run_here("check", "home").stdout.endswith("\ngood\n"))
        shutil.copy(self.save, self.folder / "b.sqlite")  # an ending makes it a file
        again = self.run_here("generate", *area, "--world", "b.sqlite")
        self.assertEqual((again.returncode, json.loads(again.stdout)["skipped"]), (0, 1), again.stderr)

    def test_databases_that_cannot_be_reached_are_told_without_their_password(self):
        url = "postgresql://me:secret@127.0.0.1:1/name"
        out = self.folder / "out.png"
        for command in (("generate", "--radius", "0"), ("map", "--radius", "0", "-o", out),
                        ("dump", "--area", "0,0,1,1", "-o", self.folder / "out.npy"), ("render", "--scene", "landscape", "-o", out),
                        ("flight-bench", "--json")):
            done = run(*command, "--world", url)
            self.assertRefused(done, command)
            self.assertIn("postgresql://127.0.0.1:1/name: cannot be reached", done.stderr)
            self.assertNotIn("secret", done.stderr)
        done = run("generate", "--radius", "0", "--world", "mysql://me:secret@host/name")
        self.assertRefused(done, "another kind of database")
        self.assertNotIn("secret", done.stderr)

    def test_save_game_is_the_old_name_of_world(self):
        area = ("--backend", "cpu", "--radius", "0", *FLAT)
        for flag in ("--save-game", "--world"):
            done = self.run_here("generate", *area, flag, "home")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(len(list(self.folder.glob("*/*.sqlite"))), 1)
        self.assertNotIn("--save-game", self.succeed("generate", "--help"))
        self.assertRefused(run("generate", *area, "--save-game", "a", "--world", "b"), "both")

    def test_render_leaves_a_save_as_it_is(self):
        out = self.folder / "out.png"
        view = ("render", "--at", "8,8,90", "-o", out, "--size", "32x24", "--view-distance", "1", "--preset", "low")
        done = run(*view, "--world", self.save)
        self.assertRefused(done, "there is none")
        self.succeed("generate", "--world", self.save, "--radius", "0", *FLAT)
        before = self.save.read_bytes()
        self.succeed(*view, "--world", self.save)  # most chunks in view are generated
        self.assertEqual(self.save.read_bytes(), before)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), sorted([out.name, self.save.name]))

    def test_check_good(self):
        self.generate("--world", self.save, "--radius", "1", "--seed", "5")
        self.assertTrue(self.succeed("check", self.save).endswith("\ngood\n"))
        report = json.loads(self.succeed("check", self.save, "--json"))
        self.assertEqual((report["damaged"], report["chunks"], report["seed"]), (False, 9, 5))
        self.assertEqual((report["format"], report["generator"]), (4, "wilderness"))

    def test_check_damaged(self):
        self.succeed("generate", "--world", self.save, "--radius", "1", *FLAT)
        self.sql("UPDATE chunks SET data = zeroblob(50) WHERE key = (SELECT min(key) FROM chunks)")
        done = run("check", self.save)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("damage: chunk -1,-1: the checksum is wrong\ndamaged\n", done.stdout)
        done = run("check", self.save, "--json")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(json.loads(done.stdout)["damaged_chunks"],
                         [{"x": -1, "y": -1, "level": 0, "problem": "the checksum is wrong"}])
        # Generating repairs it and keeps the damaged data.
        self.succeed("generate", "--world", self.save, "--radius", "1", *FLAT)
        report = json.loads(self.succeed("check", self.save, "--json"))
        self.assertEqual((report["damaged"], report["chunks"], report["quarantined"]), (False, 9, 1))
        self.assertEqual(self.sql("SELECT length(data) FROM quarantine"), [(50,)])

    def test_check_cut_off(self):
        self.succeed("generate", "--world", self.save, "--radius", "1", *FLAT)
        self.save.write_bytes(self.save.read_bytes()[:-1])
        done = run("check", self.save)
        self.assertEqual((done.returncode, done.stderr), (1, ""))
        self.assertIn("cut off", done.stdout)


class PlayedSaves(ProgramTest):
    """A save that another process has open to write."""

    def setUp(self):
        super().setUp()
        self.save = self.folder / "a.sqlite"
        self.succeed("generate", "--world", self.save, "--radius", "1", *FLAT)
        self.area = ("--area", "-2,-2,3,3")

    def look(self):
        """Arguments of each command that writes, by name."""
        return {"check": ("check", self.save),
                "dump": ("dump", *self.area, "--world", self.save, "-o", self.folder / "out.npy"),
                "map": ("map", *self.area, "--world", self.save, "-o", self.folder / "out.png"),
                "render": ("render", "--at", "8,8,90", "--look", "0,-60", "--size", "32x24", "--view-distance", "1",
                           "--preset", "low", "--world", self.save, "-o", self.folder / "out.png")}

    def hold_open(self):
        """Keeps the lock and a connection as the program does, with an edit that is only in the log."""
        lock = open(f"{self.save}-lock", "w", encoding="ascii")
        self.addCleanup(lock.close)
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        lock.write(str(os.getpid()))
        lock.flush()
        database = sqlite3.connect(self.save)
        self.addCleanup(database.close)
        database.execute("PRAGMA journal_mode = WAL")
        database.execute("PRAGMA wal_autocheckpoint = 0")
        self.assertEqual(database.execute("PRAGMA wal_checkpoint(TRUNCATE)").fetchone()[0], 0)
        return database

    def files(self):
        """The contents of the files, read by another process: closing them in this one would release SQLite's locks."""
        names = [str(self.save), f"{self.save}-wal", f"{self.save}-lock"]
        return subprocess.run(["cksum", *names], capture_output=True, check=True).stdout

    def test_it_is_read_and_left_as_it_is(self):
        ids = {block["name"]: block["id"] for block in json.loads(self.succeed("blocks", "--json"))}
        key = 2**27 << 28 | 2**27
        database = self.hold_open()
        data = database.execute("SELECT data FROM chunks WHERE key = ?", (key,)).fetchone()[0]
        for kept in (None, "in the log"):
            if kept:
                with database:
                    database.execute("UPDATE chunks SET origin = 1, data = ? WHERE key = ?", (support.seal(data, key, 1), key))
            before = self.files()
            for name, words in self.look().items():
                done = run(*words)
                self.assertEqual(done.returncode, 0, (name, done.stderr))
                told = done.stdout + done.stderr
                self.assertEqual(told.count(f"open in another program (process {os.getpid()})"), 1, (name, told))
                if name == "check":
                    self.assertEqual(done.stderr, "")
                    self.assertIn(f"9 chunks, {1 if kept else 0} of them edited", done.stdout)
                    self.assertIn("without its log; nothing is changed", done.stdout)
                    self.assertTrue(done.stdout.endswith("\ngood\n"))
            self.assertEqual(self.files(), before)
            self.assertIs(json.loads(self.succeed("check", self.save, "--json"))["in_use"], True)
        self.assertEqual(Npy(self.folder / "out.npy").column(40, 40)[80], ids["grass"])
        for words in (("generate", "--radius", "1", "--world", self.save), ("flight-bench", "--world", self.save, "--json")):
            done = run(*words)
            self.assertRefused(done, "two would write")
            self.assertIn("open in another program", done.stderr)

    def test_one_that_is_being_made_or_migrated_is_refused(self):
        self.hold_open()
        (self.folder / "a.sqlite-journal").write_bytes(b"\xd9\xd5\x05\xf9" + bytes(600))
        for name, words in self.look().items():
            done = run(*words)
            self.assertRefused(done, name)
            self.assertIn("which is making or migrating it", done.stderr)

    def test_while_the_program_itself_flies_through_it(self):
        words = ("flight-bench", "--world", self.save, "--view-distance", "3", "--size", "32x18", "--preset", "low",
                 "--threads", "1", "--duration", "6", "--json")
        flight = subprocess.Popen([support.program(), *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  text=True, env=support.environment())
        self.addCleanup(flight.kill)
        # A command that reads the save before the flight has it would keep the flight out.
        lock = pathlib.Path(f"{self.save}-lock")
        while flight.poll() is None and not (lock.exists() and str(flight.pid) in lock.read_text("ascii")):
            time.sleep(0.01)
        chunks, in_use = [], 0
        look = self.look()
        while flight.poll() is None:
            done = run("check", self.save, "--json")
            self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
            report = json.loads(done.stdout)
            chunks.append(report["chunks"])
            in_use += report["in_use"]
            for name in ("dump", "map"):
                done = run(*look[name])
                self.assertEqual(done.returncode, 0, done.stderr)
        said = flight.communicate()[1]
        self.assertEqual(flight.returncode, 0, said)
        self.assertGreater(in_use, 0)
        self.assertEqual(chunks, sorted(chunks))
        self.assertGreater(json.loads(self.succeed("check", self.save, "--json"))["chunks"], 9)


if __name__ == "__main__":
    support.main()
