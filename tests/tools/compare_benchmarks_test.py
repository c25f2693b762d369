#!/usr/bin/env python3
"""tools/compare_benchmarks.py on synthetic runs. Usage: compare_benchmarks_test.py SCRIPT"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = ""


def google(**times):
    """A file of Google Benchmark; microseconds by name, one per repetition."""
    runs = []
    for name, repetitions in times.items():
        for k, time in enumerate(repetitions):
            runs.append({"name": name, "run_name": name, "run_type": "iteration", "repetition_index": k,
                         "real_time": 1e6, "cpu_time": time, "time_unit": "us"})
        runs.append({"name": name + "_mean", "run_name": name, "run_type": "aggregate", "aggregate_name": "mean",
                     "real_time": 0, "cpu_time": 1e9, "time_unit": "us"})
    return json.dumps({"context": {}, "benchmarks": runs})


def terrane(*frames, **more):
    """A file of terrane bench; milliseconds per frame, one per run."""
    lines = [{"settings": {"quick": True}}]
    for frame in frames:
        lines.append({"cell": ["render", "--scene", "cave"],
                      "result": {"milliseconds": {"frame": frame}, "chunks": 1000 * frame,
                                 "tasks": {"mesh": {"count": 10, "milliseconds": 5}}, **more}})
    return "".join(json.dumps(line) + "\n" for line in lines)


class Compare(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def compare(self, before, after, *options):
        paths = []
        for name, text in (("before", before), ("after", after)):
            paths.append(pathlib.Path(self.folder.name) / name)
            paths[-1].write_text(text, encoding="utf-8")
        return subprocess.run([sys.executable, "-B", SCRIPT, *map(str, paths), *options], capture_output=True, text=True,
                              check=False)

    def assertExit(self, code, done):
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)

    def test_equal_runs_are_not_slower(self):
        self.assertExit(0, self.compare(google(a=[10, 11, 12]), google(a=[10, 11, 12])))

    def test_what_is_measured_by_the_clock_is_compared_by_it(self):
        slow, slower = ({"name": "save/real_time", "run_name": "save/real_time", "run_type": "iteration", "real_time": time,
                         "cpu_time": 1, "time_unit": "us"} for time in (10, 20))
        files = [json.dumps({"context": {}, "benchmarks": 3 * [run]}) for run in (slow, slower)]
        self.assertExit(1, self.compare(*files))
        self.assertExit(0, self.compare(*(file.replace("/real_time", "/process_time/real_time") for file in files)))

    def test_what_is_slower_is_named(self):
        done = self.compare(google(a=[10, 11, 12], b=[5, 5, 5]), google(a=[20, 21, 22], b=[5, 5, 5]))
        self.assertExit(1, done)
        self.assertRegex(done.stdout, r"11 µs +21 µs +\+90\.9 % +slower +a\n")
        self.assertNotIn(" b\n", done.stdout)
        self.assertIn("2 times compared, 1 slower, 0 faster", done.stdout)

    def test_faster_is_no_failure(self):
        done = self.compare(google(a=[20, 21, 22]), google(a=[10, 11, 12]))
        self.assertExit(0, done)
        self.assertIn("faster", done.stdout)

    def test_the_threshold(self):
        before, after = google(a=[100]), google(a=[112])
        self.assertExit(0, self.compare(before, after))
        self.assertExit(1, self.compare(before, after, "--threshold", "10"))

    def test_spread_is_noise(self):
        before = google(a=[10, 12, 14, 30, 31, 32, 12])
        self.assertExit(0, self.compare(before, google(a=[12, 20, 22, 31, 30, 33, 13])))

    def test_one_slow_repetition_is_noise(self):
        self.assertExit(0, self.compare(google(a=[10, 10, 10, 10, 10]), google(a=[10, 10, 10, 10, 90])))

    def test_medians_of_aggregates(self):
        def aggregates(time):
            return json.dumps({"benchmarks": [{"name": "a_median", "run_name": "a", "run_type": "aggregate",
                                               "aggregate_name": "median", "cpu_time": time, "time_unit": "ns"}]})
        self.assertExit(0, self.compare(aggregates(10), aggregates(11)))
        self.assertExit(1, self.compare(aggregates(10), aggregates(12)))

    def test_units(self):
        text = google(a=[1000])
        self.assertExit(0, self.compare(text, text.replace('"us"', '"ms"').replace("1000", "1")))
        self.assertExit(1, self.compare(text, text.replace('"us"', '"ms"')))

    def test_terrane_bench(self):
        self.assertExit(0, self.compare(terrane(10, 11, 12), terrane(11, 11, 12)))
        done = self.compare(terrane(10, 11, 12), terrane(20, 21, 22))
        self.assertExit(1, done)
        self.assertIn("slower  render --scene cave: milliseconds/frame\n", done.stdout)
        self.assertIn("2 times compared, 1 slower", done.stdout)  # counts are not times

    def test_seconds_of_a_flight(self):
        def flight(seconds):
            return terrane(10, flight={"seconds_to_load": seconds, "seconds_of_flight": 2 * seconds, "frame_ms": 5})
        done = self.compare(flight(1), flight(2))
        self.assertExit(1, done)
        self.assertRegex(done.stdout, r" 1 s +2 s .*flight/seconds_to_load")
        self.assertIn("1 slower", done.stdout)

    def test_a_line_that_was_cut_short(self):
        whole = terrane(10, 11)
        self.assertExit(0, self.compare(whole, whole + '{"cell": ["ren'))

    def test_what_only_one_has_does_not_count(self):
        done = self.compare(google(a=[1], b=[1]), google(a=[1], c=[1]))
        self.assertExit(0, done)
        self.assertIn("only before: b\nonly after: c\n", done.stdout)

    def test_all_shows_what_did_not_change(self):
        self.assertIn(" a\n", self.compare(google(a=[1]), google(a=[1]), "--all").stdout)

    def test_bad_input(self):
        good = google(a=[1])
        cases = (("", "before:1: neither"), ("[]", "neither"), ("{}\n", "before:1: not a result"),
                 ('{"benchmarks": [{}]}', "a benchmark without name"), (terrane(1), "before is of terrane bench"),
                 (google(b=[1]), "no time in common"), (terrane(1) + "7\n", "before:3: not a result"))
        for text, message in cases:
            done = self.compare(text, good)
            self.assertExit(2, done)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertIn(message, done.stderr)
        self.assertExit(2, self.compare(good, good, "--threshold", "-1"))

    def test_files_that_are_not_there(self):
        done = subprocess.run([sys.executable, "-B", SCRIPT, "/nonexistent/a", "/nonexistent/b"], capture_output=True,
                              text=True, check=False)
        self.assertExit(2, done)
        self.assertRegex(done.stderr, r"\Acompare_benchmarks: /nonexistent/a: cannot be read")


if __name__ == "__main__":
    SCRIPT = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=1)
