#!/usr/bin/env python3
"""terrane bench, end to end, with images of a few pixels. Usage: bench_test.py PROGRAM"""
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import tempfile
import time

import support
from support import ProgramTest

TOOLS = pathlib.Path(__file__).parents[2] / "tools"
PYTHON = "/usr/bin/python3"  # the interpreter for which Debian packages libraries
HANG_SECONDS = 600
TINY = ("--quick", "--size", "64x36", "--view-distance", "1")
# Prints the command lines by table that tools/bench_report.py needs, as JSON. Arguments: its folder, results.
WANTED_CELLS = """
import json, pathlib, sys
sys.path.insert(0, sys.argv[1])
from bench_report.cells import settings_of
from bench_report.report import all_tables
from bench_report.results import read_results
tables = all_tables(settings_of(read_results(pathlib.Path(sys.argv[2]))))
print(json.dumps({table.name: table.cells() for table in tables}))
"""


class Bench(ProgramTest):
    def setUp(self):
        super().setUp()
        self.output = self.folder / "results"

    def command(self, *arguments):
        return [support.program(), "bench", "--output", str(self.output), *map(str, arguments)]

    def bench(self, *arguments, environment=None, limit=None):
        return subprocess.run(self.command(*TINY, *arguments), capture_output=True, text=True, timeout=HANG_SECONDS,
                              env=environment or support.environment(), check=False, preexec_fn=limit)

    def lines(self):
        return [json.loads(line) for line in (self.output / "results.jsonl").read_text().splitlines()]

    def cells(self):
        return [" ".join(line["cell"]) for line in self.lines()[1:]]

    def needsReport(self):
        done = subprocess.run([PYTHON, "-c", "import pandas, matplotlib"], capture_output=True, check=False)
        if done.returncode != 0:
            self.skipTest("needs python3-pandas and python3-matplotlib")

    def python(self, *arguments):
        done = subprocess.run([PYTHON, "-B", *map(str, arguments)], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout


class Measured(Bench):
    """What one run of two rounds leaves, in a folder with files of the user."""
    own_files = ("work/thesis.txt", "info.txt", "messages.txt")

    @classmethod
    def setUpClass(cls):
        cls.output = pathlib.Path(tempfile.mkdtemp(prefix="terrane_test_"))
        cls.addClassCleanup(shutil.rmtree, cls.output)
        (cls.output / "work").mkdir()
        for name in cls.own_files:
            (cls.output / name).write_text("mine")
        cls.done = subprocess.run([support.program(), "bench", "--output", str(cls.output), *TINY, "--runs", "2", "--only",
                                   "disk"], capture_output=True, text=True, timeout=HANG_SECONDS,
                                  env=support.environment(), check=False)

    def setUp(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)

    def test_the_settings_are_there(self):
        settings = self.lines()[0]["settings"]
        for name, value in (("picture", "64x36"), ("view_distance", 1), ("quick", True), ("frames_of_a_run", 3),
                            ("runs_of_each_measurement", 2)):
            self.assertEqual(settings[name], value, name)
        for name in ("renderer", "processor", "compiler", "digest_of_the_program"):
            self.assertIn(name, settings)

    def test_cells_are_measured_in_rounds(self):
        cells = self.cells()
        self.assertEqual(len(cells), 8)
        self.assertEqual(len(set(cells)), 4)
        self.assertEqual(cells[:4], cells[4:])
        for line in self.lines()[1:]:
            result = line["result"]
            self.assertEqual(result["chunks"], 25)
            self.assertGreater(result["bytes"]["save"], 2500)
            self.assertGreater(result["milliseconds"]["load"], 0)
            self.assertGreater(result["run"]["seconds"], 0)

    def test_a_users_own_files_stay(self):
        for name in self.own_files:
            self.assertEqual((self.output / name).read_text(), "mine")
        self.assertEqual(list(self.output.glob(".*")), [], "what runs needed is left")
        self.assertEqual({path.name for path in self.output.iterdir()} - {"report.md", "tables", "plots"},
                         {"results.jsonl", "work", "info.txt", "messages.txt"})

    def test_the_report(self):
        self.needsReport()
        self.python(TOOLS / "bench_report.py", self.output, "disk")
        report = (self.output / "report.md").read_text()
        for text in ("# Measurements, quick", "| renderer |", "| image | 64x36 |", "## Saves", "\n| cave | 25 |"):
            self.assertIn(text, report)
        self.assertNotIn("failed", report)

    def test_results_can_be_compared(self):
        results = self.output / "results.jsonl"
        compared = self.python(TOOLS / "compare_benchmarks.py", results, results)
        self.assertRegex(compared, r"\n?[1-9]\d* times compared, 0 slower, 0 faster")


class Runs(Bench):
    def test_frames_are_measured(self):
        done = self.bench("--only", "memory,memory-by-owner")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(self.cells()), 1, "equal command lines of two tables are measured once")
        self.assertGreater(self.lines()[1]["result"]["run"]["seconds"], 0)

    def test_the_plan_is_what_the_report_asks_for(self):
        self.needsReport()
        for options in ((), ("--quick",), TINY, ("--view-distance", "20", "--size", "640x360", "--frames", "5")):
            done = subprocess.run([support.program(), "bench", "--list", *options], capture_output=True, text=True,
                                  timeout=HANG_SECONDS, env=support.environment(), check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            settings, *tables = done.stdout.splitlines(keepends=True)
            results = self.folder / "listed.jsonl"
            results.write_text(settings)
            plan = {table["table"]: sorted(map(" ".join, table["cells"])) for table in map(json.loads, tables)}
            wanted = json.loads(self.python("-c", WANTED_CELLS, TOOLS, results))
            self.assertEqual(list(plan), list(wanted))
            for name, cells in wanted.items():
                self.assertEqual(plan[name], sorted(cells), f"{name} of {options}")

    def test_a_table_is_listed(self):
        done = subprocess.run([support.program(), "bench", "--list", *TINY, "disk"], capture_output=True, text=True,
                              timeout=HANG_SECONDS, env=support.environment(), check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        settings, table = map(json.loads, done.stdout.splitlines())
        self.assertEqual(settings["settings"]["picture"], "64x36")
        self.assertEqual(table["table"], "disk")
        self.assertEqual(len(table["cells"]), 4)

    def test_a_run_that_was_killed_goes_on(self):
        process = subprocess.Popen(self.command(*TINY, "--only", "disk"), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, env=support.environment())
        deadline = time.monotonic() + HANG_SECONDS
        results = self.output / "results.jsonl"
        while not results.exists() or results.read_text().count("\n") < 3:
            self.assertLess(time.monotonic(), deadline)
            self.assertIsNone(process.poll(), "it ended before it was killed")
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
        process.wait()
        before = self.cells()
        with open(results, "a", encoding="utf-8") as file:
            file.write('{"cell": ["ren')  # as if killed within a line
        refused = self.bench("--only", "disk")
        self.assertRefused(refused, "without --resume")
        self.assertIn("--resume", refused.stderr)
        other = self.bench("--only", "disk", "--resume", "--frames", "2")
        self.assertRefused(other, "other settings")
        self.assertIn("frames_of_a_run 3 there, 2 here", other.stderr)
        done = self.bench("--only", "disk", "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        after = self.cells()
        self.assertEqual(after[:len(before)], before)
        self.assertEqual(len(after), 4)
        self.assertEqual(len(set(after)), 4, "nothing is measured twice")

    def test_what_fails_is_named(self):
        def limit():  # no run can write its save
            resource.setrlimit(resource.RLIMIT_FSIZE, (30000, 30000))
        environment = {**support.environment(), "MESA_SHADER_CACHE_DISABLE": "true"}
        done = self.bench("--only", "disk", environment=environment, limit=limit)
        self.assertEqual(done.returncode, 1, done.stderr)
        failures = [line for line in self.lines() if "failure" in line]
        self.assertEqual(len(failures), 4)
        for line in failures:
            self.assertRegex(done.stderr, f"warning: .*--scene {line['cell'][2]} .*: before it: exit code ")
            self.assertNotIn("result", line)

    def test_a_folder_that_cannot_be_made(self):
        self.output = self.folder / "file" / "results"
        (self.folder / "file").write_text("")
        self.assertRefused(self.bench("--only", "disk"), "a file in the way")


if __name__ == "__main__":
    os.environ.pop("DISPLAY", None)
    support.main()
