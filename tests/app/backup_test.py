#!/usr/bin/env python3
"""Backups of worlds that servers run: terrane backup, and the console command. Usage: backup_test.py PROGRAM"""
import contextlib
import os
import pathlib
import sqlite3
import subprocess
import sys

import support
from support import RunningProgram, run

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tools"))
import child_processes  # noqa: E402
from server_tools import bots_command  # noqa: E402
from wait_for import wait_for  # noqa: E402

GENERATOR = ("--generator", "overworld")


class OfAServer(support.ProgramTest):
    def setUp(self):
        super().setUp()
        self.world = self.folder / "w.sqlite"
        self.to = self.folder / "b"
        self.to.mkdir()

    def serve(self, world, *options):
        server = RunningProgram(self.folder, "serve", "--world", world, "--address", "127.0.0.1", "--port", "0", *options)
        self.addCleanup(server.clean_up)
        server.port = int(server.wait_for(r"on port (\d+)")[1])
        return server

    def stop(self, server):
        server.say("stop")
        self.assertEqual(server.process.wait(support.HANG_SECONDS), 0, server.output())

    def history(self, world):
        return self.succeed("history", "--world", world, "--limit", "1000000")

    def test_both_ways_while_players_build(self):
        server = self.serve(self.world, *GENERATOR)
        bots = child_processes.start(
            bots_command(support.program(), server.port, "--count", "10", "--seconds", "600", "--behaviour", "build",
                         "--edits-per-second", "5"), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(bots.wait)
        self.addCleanup(bots.kill)
        server.wait_for("(bot9|10 of 10) joined")
        wait_for(lambda: self.history(self.world), "the first edit")
        copies = []
        for number in range(3):
            copies.append(self.to / f"console{number}.sqlite")
            server.say(f"backup {copies[-1]}")
            server.wait_for(f"the backup {copies[-1]} is complete")
            copies.append(self.to / f"program{number}.sqlite")
            said = self.succeed("backup", self.world, copies[-1])
            self.assertEqual(said, f"the backup {copies[-1]} is complete\n")
        self.assertEqual(len(list(self.to.iterdir())), 3 * len(copies), "worlds, files of servers and keys")
        bots.kill()
        bots.wait()
        self.stop(server)
        history, lengths = self.history(self.world), []
        for copy in copies:
            self.assertTrue(self.succeed("check", copy).endswith("\ngood\n"))
            part = self.history(copy)
            self.assertTrue(history.endswith(part), "an older state of the same history")
            lengths.append(len(part))
            self.assertEqual(copy.with_suffix(".server.pem").read_bytes(), self.world.with_suffix(".server.pem").read_bytes())
        self.assertEqual(lengths, sorted(lengths))
        self.assertGreater(lengths[0], 0)
        again = self.serve(copies[-1])
        again.say("list")
        again.wait_for("0 of 100 players")
        self.stop(again)
        self.succeed("copy", copies[0], self.folder / "plain.sqlite")

    def test_a_world_without_servers(self):
        self.succeed("generate", "--radius", "1", "--world", self.world, *GENERATOR)
        self.succeed("backup", self.world, self.to / "x.sqlite")
        self.assertEqual([file.name for file in self.to.iterdir()], ["x.sqlite"])
        self.assertIn("9 chunks", self.succeed("check", self.to / "x.sqlite"))

    def test_refusals_leave_all_as_it_is(self):
        self.succeed("generate", "--radius", "1", "--world", self.world, *GENERATOR)
        before = self.world.read_bytes()
        (self.to / "there.sqlite").write_text("mine")
        (self.to / "other.server.sqlite").write_text("mine")
        cases = {
            self.to / "there.sqlite": "there.sqlite: exists; a backup replaces no file",
            self.to / "other.sqlite": "other.server.sqlite: exists; a backup replaces no file",
            self.world: "w.sqlite",
            self.folder / "w.server.sqlite": "",
            self.folder / "w.map.sqlite": "",
            self.to / ".." / "w.sqlite": "",
            self.to / "none" / "x.sqlite": "there is no folder",
            self.to / "x.txt": "the file of a backup is NAME.sqlite",
            "postgresql:///x": "a backup is a file",
        }
        for target, reason in cases.items():
            done = run("backup", self.world, target)
            self.assertRefused(done, target)
            self.assertIn(reason, done.stderr)
        self.assertRefused(run("backup", self.folder / "none.sqlite", self.to / "x.sqlite"), "no such world")
        self.assertEqual(self.world.read_bytes(), before)
        self.assertEqual(sorted(file.name for file in self.to.iterdir()), ["other.server.sqlite", "there.sqlite"])

    def test_a_backup_that_no_server_opens_is_none(self):
        self.stop(self.serve(self.world, *GENERATOR))
        records = self.folder / "w.server.sqlite"
        with contextlib.closing(sqlite3.connect(records)) as database:
            database.execute("DROP TABLE claims")
            database.commit()
        done = run("backup", self.world, self.to / "x.sqlite")
        self.assertRefused(done, records)
        self.assertIn("claims", done.stderr)
        self.assertEqual(list(self.to.iterdir()), [])

    def test_damaged_chunks_are_told(self):
        self.succeed("generate", "--radius", "1", "--world", self.world, *GENERATOR)
        with contextlib.closing(sqlite3.connect(self.world)) as database:
            database.execute("UPDATE chunks SET data = x'00' WHERE rowid = (SELECT min(rowid) FROM chunks)")
            database.commit()
        done = run("backup", self.world, self.to / "x.sqlite")
        self.assertEqual(done.returncode, 1)
        self.assertIn("damaged chunks, as in the world: 1", done.stderr)
        self.assertIn("is complete", done.stdout)
        self.assertEqual(run("check", self.to / "x.sqlite").returncode, 1)

    def test_a_folder_that_cannot_be_written(self):
        self.succeed("generate", "--radius", "0", "--world", self.world, *GENERATOR)
        self.folder.chmod(0o755)
        self.to.chmod(0o555)
        user = {"user": 65534} if os.geteuid() == 0 else {}
        done = subprocess.run([support.program(), "backup", self.world, self.to / "x.sqlite"], capture_output=True, text=True,
                              env=support.environment(), check=False, **user)
        self.assertRefused(done, "no permission")
        self.assertIn("nothing can be written in the folder", done.stderr)


if __name__ == "__main__":
    support.main()
