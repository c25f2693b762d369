#!/usr/bin/env python3
"""terrane bench, end to end, with pictures of a few pixels. Usage: bench_test.py PROGRAM"""
import csv
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import time

import support
from support import ProgramTest

HANG_SECONDS = 600
TINY = ("--quick", "--size", "64x36", "--view-distance", "1")


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

    def rows(self, table):
        with open(self.output / "tables" / (table + ".csv"), encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def test_a_table_is_measured_and_reported(self):
        done = self.bench("--only", "disk,layers")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = self.rows("disk")
        self.assertEqual([row["scene"] for row in rows], ["ocean", "desert", "landscape", "cave"])
        for row in rows:
            self.assertEqual(float(row["chunks"]), 25)
            self.assertGreater(float(row["bytes a chunk"]), 100)
            self.assertGreater(float(row["load all in view, s"]), 0)
        report = (self.output / "report.md").read_text()
        for text in ("# Measurements, quick", "| renderer |", "| processor |", "| picture | 64x36 |",
                     "load average at the start", "## Saves", "## Layers of water and glass (table 6.13)",
                     "Cut for `--quick`"):
            self.assertIn(text, report)
        layers = self.rows("layers")
        self.assertEqual(layers[0]["thesis: 3"], "57")
        self.assertGreater(float(layers[0]["3"]), 0)
        self.assertNotIn("failed", report)
        self.assertEqual(list(self.output.glob(".*")), [], "what runs needed is left")

    def test_a_persons_own_files_stay(self):
        (self.output / "work").mkdir(parents=True)
        for name in ("work/thesis.txt", "info.txt", "messages.txt"):
            (self.output / name).write_text("mine")
        done = self.bench("--only", "disk")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("work/thesis.txt", "info.txt", "messages.txt"):
            self.assertEqual((self.output / name).read_text(), "mine")
        self.assertEqual(list(self.output.glob(".*")), [], "what runs needed is left")

    def test_plots(self):
        done = self.bench("--only", "passes")
        self.assertEqual(done.returncode, 0, done.stderr)
        report = (self.output / "report.md").read_text()
        if not shutil.which("gnuplot"):
            self.assertIn("gnuplot is missing", report)
            return
        self.assertIn("(plots/passes.svg)", report)
        svg = (self.output / "plots" / "passes.svg").read_text()
        self.assertIn("</svg>", svg)
        self.assertIn("ocean, ms", svg)
        self.assertIn("shadow map", svg)

    def test_without_gnuplot_the_report_says_so(self):
        environment = {**support.environment(), "PATH": str(self.folder)}
        done = self.bench("disk", environment=environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("warning: gnuplot is missing", done.stderr)
        self.assertIn("No plots: gnuplot is missing.", (self.output / "report.md").read_text())

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
        report = (self.output / "report.md").read_text()
        self.assertIn("| cave | failed |", report)
        self.assertIn("What failed:", report)
        self.assertIn("--scene cave", report)
        for row in self.rows("disk"):
            self.assertEqual(row["chunks"], "")
        # The next run tries again.
        done = self.bench("--only", "disk", "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("failed", (self.output / "report.md").read_text())

    def test_results_can_be_compared(self):
        self.assertEqual(self.bench("--only", "disk").returncode, 0)
        script = pathlib.Path(__file__).parents[2] / "tools" / "compare_benchmarks.py"
        results = self.output / "results.jsonl"
        done = subprocess.run(["python3", "-B", script, results, results], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"\n?[1-9]\d* times compared, 0 slower, 0 faster")

    def test_a_folder_that_cannot_be_made(self):
        self.output = self.folder / "file" / "results"
        (self.folder / "file").write_text("")
        self.assertRefused(self.bench("--only", "disk"), "a file in the way")


if __name__ == "__main__":
    os.environ.pop("DISPLAY", None)
    support.main()
