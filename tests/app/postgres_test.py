#!/usr/bin/env python3
"""Worlds in PostgreSQL, from the command line. Usage: postgres_test.py PROGRAM"""
import json
import pathlib
import re
import subprocess
import sys

import support
from support import ProgramTest, run

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tools"))
from scratch_postgres import ScratchPostgres, free_port  # noqa: E402
from server_tools import Server, bots_command  # noqa: E402
from wait_for import wait_for  # noqa: E402

_server = None


def setUpModule():
    global _server
    _server = ScratchPostgres()


def tearDownModule():
    _server.close()


class Postgres(ProgramTest):
    schemas = 0

    def setUp(self):
        super().setUp()
        Postgres.schemas += 1
        self.schema = f"world_{Postgres.schemas}"
        self.url = _server.url(self.schema)
        self.table = f"{self.schema}.chunks"

    def digest(self, radius, *world):
        return self.succeed("generate", "--radius", radius, "--digest", *world).strip()

    def rows(self, where="true"):
        return int(_server.query(f"SELECT count(*) FROM {self.table} WHERE {where}"))


class World(Postgres):
    def test_the_digest_is_that_of_a_file_and_of_memory(self):
        digests = {self.digest(4), self.digest(4, "--world", self.folder / "a.sqlite"),
                   self.digest(4, "--world", self.url)}
        self.assertEqual(len(digests), 1)
        self.assertEqual(self.rows(), 81)
        self.assertEqual(self.digest(4, "--world", self.url), digests.pop(), "read from the database")

    def test_an_image_is_that_of_a_file(self):
        if "render" not in self.succeed("--help"):
            self.skipTest("a build without graphics")
        view = ("--at", "8,8,120", "--size", "96x54", "--view-distance", "3", "--samples", "1")
        images = []
        for name, world in (("file", self.folder / "a.sqlite"), ("database", self.url)):
            self.succeed("generate", "--radius", "4", "--world", world)
            self.succeed("render", "--world", world, *view, "-o", self.folder / f"{name}.png")
            images.append((self.folder / f"{name}.png").read_bytes())
        self.assertEqual(*images)

    def test_check_finds_damage(self):
        self.succeed("generate", "--radius", "1", "--world", self.url)
        self.assertRegex(self.succeed("check", self.url), r"9 chunks.*\ngood\n\Z")
        _server.query(f"UPDATE {self.table} SET data = set_byte(data, 20, get_byte(data, 20) # 1) "
                      f"WHERE key = (SELECT min(key) FROM {self.table})")
        done = run("check", self.url)
        self.assertEqual(done.returncode, 1)
        self.assertIn("damage: chunk -1,-1: ", done.stdout)
        # Generating sets it aside and generates it again.
        run("generate", "--radius", "1", "--world", self.url)
        self.assertRegex(self.succeed("check", self.url), "1 damaged chunks are in quarantine\ngood\n")


class Refused(Postgres):
    def assertOneLine(self, url, *words, secret="pass-word"):
        for command in (("check", url), ("generate", "--radius", "0", "--world", url), ("copy", url, self.folder / "x.sqlite"),
                        ("work", url, "--radius", "0")):
            done = run(*command)
            self.assertRefused(done, command)
            self.assertNotIn(secret, done.stderr)
            for word in words:
                self.assertIn(word, done.stderr)

    def test_no_server(self):
        self.assertOneLine(f"postgresql://user:pass-word@127.0.0.1:{free_port()}/name", "cannot be reached", "refused")

    def test_no_such_database(self):
        self.assertOneLine(f"postgresql://postgres:pass-word@127.0.0.1:{_server.port}/none", '"none" does not exist')

    def test_a_url_that_is_none(self):
        self.assertOneLine("postgresql://user:pass-word@host:port:port/name%", "not a URL")
        self.assertOneLine("postgresql://user:pass-word@host/name?no_such_option=1", "not a URL")

    def test_tables_of_another_program(self):
        _server.query(f"CREATE SCHEMA {self.schema}; CREATE TABLE {self.schema}.customers (name text)")
        self.assertOneLine(self.url, "another program")

    def test_another_kind_of_database(self):
        self.assertOneLine("mysql://user:pass-word@host/name")

    def test_a_newer_format(self):
        self.succeed("generate", "--radius", "0", "--world", self.url)
        _server.query(f"UPDATE {self.schema}.terrane_format SET format = 99")
        self.assertOneLine(self.url, "in format 99")

    def test_survival_is_refused_and_not_kept(self):
        serve = ("serve", "--world", self.url, "--address", "127.0.0.1", "--port", "0")
        for options in (("--mode", "survival"), ("--mode", "survival")):
            self.assertRefused(run(*serve, *options), "shared between servers")
        server = support.RunningProgram(self.folder, *serve)
        self.addCleanup(server.clean_up)
        server.wait_for(r"on port (\d+)")
        server.say("stop")
        self.assertEqual(server.process.wait(support.HANG_SECONDS), 0, server.output())

    def test_an_older_format_is_brought_to_the_newest(self):
        self.succeed("generate", "--radius", "1", "--generator", "continents", "--world", self.url)  # of 256 layers
        newer = ("jobs", "work_areas", "workers", "work_state", "texts", "players", "claims", "edits", "history", "online",
                 "servers", "growth_leases")
        _server.query(f"DROP TABLE {', '.join(f'{self.schema}.{table}' for table in newer)}; "
                      f"DROP SEQUENCE {self.schema}.player_numbers; UPDATE {self.schema}.terrane_format SET format = 1")
        self.assertRefused(run("check", self.url), "reading changes nothing")
        done = run("generate", "--radius", "1", "--world", self.url)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("migrated from format 1", done.stderr)
        self.assertIn("9 chunks", self.succeed("check", self.url))


class Copy(Postgres):
    def test_there_and_back(self):
        file, back = self.folder / "a.sqlite", self.folder / "b.sqlite"
        self.succeed("generate", "--radius", "3", "--world", file)
        there = json.loads(self.succeed("copy", file, self.url, "--json"))
        again = json.loads(self.succeed("copy", self.url, back, "--json"))
        self.assertEqual(there["chunks"], 49)
        self.assertEqual((there["digest"], there["bytes"]), (again["digest"], again["bytes"]))
        self.assertEqual(self.digest(3, "--world", back), self.digest(3))
        self.assertRegex(self.succeed("check", back), "good\n")

    def test_a_world_that_is_there_stays(self):
        file = self.folder / "a.sqlite"
        self.succeed("generate", "--radius", "1", "--world", file)
        self.succeed("generate", "--radius", "0", "--world", self.url)
        self.assertRefused(run("copy", file, self.url), "another world")
        self.assertEqual(self.rows(), 1)

    def test_what_servers_keep_comes_along_and_not_while_one_runs(self):
        server = Server(support.program(), self.folder, 0, "--generator", "overworld")
        bots = subprocess.run(bots_command(support.program(), server.port, "--count", "2", "--seconds", "1", "--behaviour", "build",
                                           "--edits-per-second", "10"), capture_output=True, text=True)
        self.assertEqual(bots.returncode, 0, bots.stderr)
        done = run("copy", server.world, self.url)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertRegex(done.stderr, r"error: .*world\.server\.sqlite: open in another program")
        self.assertEqual(server.stop(), 0)
        self.succeed("copy", server.world, self.url)
        there, back = self.succeed("history", "--world", self.url), self.folder / "back.sqlite"
        self.assertEqual(there, self.succeed("history", "--world", server.world))
        each = self.succeed("history", "--world", self.url, "--each-block").splitlines()
        blocks = [int(found[1]) if (found := re.search(r", (\d+) blocks$", line)) else 1 for line in there.splitlines()]
        self.assertEqual(len(each), sum(blocks))
        self.assertFalse([line for line in each if "several" in line or line.endswith("blocks")])
        self.assertRegex(there, "bot[01] at ")
        self.succeed("copy", self.url, back)
        self.assertEqual(there, self.succeed("history", "--world", back))
        (self.folder / "again").mkdir()
        again = Server(support.program(), self.folder / "again", 0, url=self.url)
        self.assertEqual(again.stop(), 0, "a server takes the copy")

    def test_backups_of_a_running_server_are_files(self):
        server = support.RunningProgram(self.folder, "serve", "--world", self.url, "--address", "127.0.0.1", "--port", "0",
                                        "--generator", "overworld")
        self.addCleanup(server.clean_up)
        port = int(server.wait_for(r"on port (\d+)")[1])
        bots = subprocess.Popen(bots_command(support.program(), port, "--count", "5", "--seconds", "600", "--behaviour", "build",
                                             "--edits-per-second", "5"), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(bots.wait)
        self.addCleanup(bots.kill)
        server.wait_for("bot4 joined")
        wait_for(lambda: self.succeed("history", "--world", self.url), "the first edit")
        copies = [self.folder / f"{name}.sqlite" for name in ("first", "second", "third")]
        self.succeed("backup", self.url, copies[0])
        server.say(f"backup {copies[1]}")
        server.wait_for(f"the backup {copies[1]} is complete")
        server.say("backup third")  # beside the server's key
        copies[2] = pathlib.Path(server.wait_for(r"the backup (\S+third\.sqlite) is complete")[1])
        self.assertTrue(copies[2].with_suffix(".server.pem").exists())
        self.assertRefused(run("backup", self.url, copies[0]), "it exists")
        bots.kill()
        bots.wait()
        server.say("stop")
        self.assertEqual(server.process.wait(support.HANG_SECONDS), 0, server.output())
        history = self.succeed("history", "--world", self.url, "--limit", "1000000")
        for copy in copies:
            self.assertTrue(self.succeed("check", copy).endswith("\ngood\n"))
            part = self.succeed("history", "--world", copy, "--limit", "1000000")
            self.assertTrue(part and history.endswith(part), "an older state of the same history")
            again = support.RunningProgram(self.folder, "serve", "--world", copy, "--address", "127.0.0.1", "--port", "0")
            self.addCleanup(again.clean_up)
            again.wait_for(r"on port (\d+)")
            again.say("stop")
            self.assertEqual(again.process.wait(support.HANG_SECONDS), 0, again.output())

    def test_a_killed_copy_goes_on(self):
        file = self.folder / "a.sqlite"
        self.succeed("generate", "--radius", "60", "--world", file, "--generator", "flat")
        # The copy waits for a lock once it has written some chunks.
        _server.query(f"""
            CREATE FUNCTION public.wait() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN
                IF EXISTS (SELECT FROM {self.table}) THEN PERFORM pg_advisory_xact_lock(1); END IF; RETURN NULL; END $$;
            CREATE FUNCTION public.watch() RETURNS event_trigger LANGUAGE plpgsql AS $$ BEGIN
                IF EXISTS (SELECT FROM pg_event_trigger_ddl_commands() WHERE object_identity = '{self.table}') THEN
                    CREATE TRIGGER waits BEFORE INSERT ON {self.table} EXECUTE FUNCTION public.wait(); END IF; END $$;
            CREATE EVENT TRIGGER watches ON ddl_command_end WHEN TAG IN ('CREATE TABLE') EXECUTE FUNCTION public.watch()""")
        lock = subprocess.Popen([*_server.psql(), "-c", "SELECT pg_advisory_lock(1)", "-c", "SELECT pg_sleep(1000)"],
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(lock.wait)
        self.addCleanup(lock.kill)
        wait_for(lambda: _server.query("SELECT count(*) FROM pg_locks WHERE locktype = 'advisory'") == "1", "the lock")
        copy = subprocess.Popen([support.program(), "copy", str(file), self.url], stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL)
        self.addCleanup(copy.kill)
        waiting = "SELECT count(*) FROM pg_stat_activity WHERE wait_event = 'advisory'"
        wait_for(lambda: copy.poll() is not None or _server.query(waiting) == "1", "the copy's waiting")
        self.assertIsNone(copy.poll(), "the copy ended before it could be killed")
        copy.kill()
        copy.wait()
        _server.query("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE wait_event IN ('advisory', 'PgSleep')")
        _server.query("DROP EVENT TRIGGER watches; DROP FUNCTION watch, wait CASCADE")
        mark = _server.query(f"SELECT value FROM {self.schema}.settings WHERE name = 'copy'")
        self.assertTrue(mark.startswith("unfinished"), mark)
        self.assertRefused(run("generate", "--radius", "1", "--world", self.url), "not finished")
        self.assertRefused(run("copy", self.url, self.folder / "b.sqlite"), "not finished")
        copied = json.loads(self.succeed("copy", file, self.url, "--json"))
        self.assertEqual(copied["chunks"], 121 * 121)
        self.assertLess(copied["copied"], 121 * 121, "it went on where it was")
        self.assertEqual(self.digest(20, "--world", self.url), self.digest(20, "--generator", "flat"))

    def test_a_copy_of_a_world_that_may_only_be_read(self):
        """Copies players and history too, and writes nothing to the source."""
        server = Server(support.program(), self.folder, 0, "--generator", "flat", url=self.url)
        self.succeed("bots", "--connect", f"127.0.0.1:{server.port}", "--count", "3", "--seconds", "1",
                     "--builders", "1", "--edits-per-second", "10")
        self.assertEqual(server.stop(), 0)
        source = self.url + ("&" if "?" in self.url else "?") + "options=-c%20default_transaction_read_only%3Don"
        self.succeed("copy", source, self.folder / "a.sqlite")
        self.assertIn("bot", self.succeed("history", "--world", self.folder / "a.sqlite"))


    def test_damaged_chunks_are_left_out_and_told(self):
        self.succeed("generate", "--radius", "1", "--world", self.url)
        _server.query(f"UPDATE {self.table} SET data = substring(data for 12) WHERE key = (SELECT max(key) FROM {self.table})")
        done = run("copy", self.url, self.folder / "a.sqlite")
        self.assertEqual(done.returncode, 1)
        self.assertIn("1 damaged chunks were left out, the first is chunk 1,1: ", done.stdout)


class Work(Postgres):
    def status(self):
        return json.loads(self.succeed("work", self.url, "--status", "--json"))

    def test_workers_share_an_area(self):
        workers = [subprocess.Popen([support.program(), "work", self.url, "--radius", "20", "--threads", "1", "--json"],
                                    stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) for _ in range(2)]
        results = []
        for worker in workers:
            out, error = worker.communicate(timeout=support.HANG_SECONDS)
            self.assertEqual(worker.returncode, 0, error)
            results.append(json.loads(out))
        self.assertEqual(sum(r["chunks"] for r in results), 41 * 41, "each chunk by one of them")
        self.assertEqual(self.rows(), 41 * 41)
        status = self.status()
        self.assertEqual((status["jobs"]["waiting"], status["jobs"]["working"]), (0, 0))
        self.assertEqual(status["chunks_done"], 41 * 41)
        self.assertEqual(self.digest(20, "--world", self.url), self.digest(20))

    def test_an_area_far_away_and_not_of_whole_squares(self):
        self.succeed("work", self.url, "--area", "-1000003,77,-999990,81", "--order", "rows")
        self.assertEqual(self.rows(), 13 * 4)
        self.assertEqual(self.succeed("generate", "--area", "-1000003,77,-999990,81", "--digest", "--world", self.url),
                         self.succeed("generate", "--area", "-1000003,77,-999990,81", "--digest"))

    def test_pause_continue_cancel(self):
        self.succeed("work", self.url, "--radius", "40", "--add-only")
        self.assertEqual(self.status()["jobs"]["waiting"], 16)
        self.succeed("work", self.url, "--pause")
        worker = subprocess.Popen([support.program(), "work", self.url], stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL)
        while not self.status()["workers"]:
            self.assertIsNone(worker.poll())
        self.assertTrue(self.status()["paused"])
        worker.terminate()
        worker.wait()
        self.assertEqual(self.status()["jobs"]["done"], 0, "a paused queue gives no job")
        run("work", self.url, "--cancel")
        self.assertEqual(self.status()["jobs"]["cancelled"], 16)
        self.succeed("work", self.url, "--continue")
        self.succeed("work", self.url, "--radius", "1")
        self.assertEqual(self.rows(), 9, "what was cancelled is not made")

    def test_status_makes_no_world(self):
        self.assertRefused(run("work", self.url, "--status"), "no world")
        self.assertEqual(_server.query(f"SELECT count(*) FROM pg_namespace WHERE nspname = '{self.schema}'"), "0")

    def test_a_file_is_no_place_for_workers(self):
        done = run("work", self.folder / "a.sqlite", "--radius", "1")
        self.assertRefused(done, "file")
        self.assertIn("postgresql://", done.stderr)


class Names(Postgres):
    def test_a_schema_is_a_name_and_nothing_else(self):
        evil = "a\"; DROP SCHEMA public; --'"
        url = _server.url(re.sub(r"[^A-Za-z0-9]", lambda c: f"%{ord(c.group()):02x}", evil))
        self.succeed("generate", "--radius", "0", "--world", url)
        self.assertIn("1 chunks", self.succeed("check", url))
        self.assertEqual(_server.query("SELECT count(*) FROM pg_namespace WHERE nspname = 'public'"), "1")
        quoted = evil.replace('"', '""')
        self.assertEqual(_server.query(f'SELECT count(*) FROM "{quoted}".chunks'), "1")


if __name__ == "__main__":
    support.main()
