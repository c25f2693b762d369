#!/usr/bin/env python3
"""tools/compare/report.py, from made-up results. Usage: compare_report_test.py FOLDER_OF_THE_SCRIPTS"""
import contextlib
import io
import json
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, sys.argv.pop(1))

import figures  # noqa: E402
import measures  # noqa: E402
import places  # noqa: E402
import report  # noqa: E402
from results import append_line, read_results  # noqa: E402

ABOUT = {"about": {"machine": {"CPU": "Test | 1", "cores": 2}, "versions": {"Terrane": "0.1.0", "Luanti": "5.6.1"},
                   "settings": {"rounds": 3}}}


def line(number, job, side, load=0.5, **values):
    return {"round": number, "job": job, "side": side, "load": load, "values": values}


LINES = [ABOUT,
         line(1, "world", "terrane", generation=1000, disk=1000), line(1, "world", "peer", generation=100, disk=4000),
         line(2, "world", "peer", generation=125, disk=5000), line(2, "world", "terrane", load=1.5, generation=2000, disk=1100),
         line(3, "world", "terrane", generation=1500, disk=900),
         {"round": 3, "job": "world", "side": "peer", "failure": "minetestserver is not installed"}]


class Report(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.write(*map(json.dumps, LINES))

    def write(self, *lines, end="\n"):
        (self.folder / "results.jsonl").write_text("\n".join(lines) + end, encoding="utf-8")

    def report(self):
        self.assertEqual(report.main([str(self.folder)]), 0)
        return (self.folder / "report.md").read_text(encoding="utf-8")

    def test_medians_and_ratios_of_pairs(self):
        text = self.report()
        self.assertIn("| Generating with light and saving | chunks per CPU second | higher | 1,500 (1,000 … 2,000) | Luanti | "
                      "112 (100 … 125) | 13.0 (10.0 … 16.0) | 3 |\n", text)
        self.assertIn("| Bytes on disk | bytes per chunk | lower | 1,000 (900 … 1,100) | Luanti | 4,500 (4,000 … 5,000) | "
                      "0.235 (0.22 … 0.25) | 3 |\n", text)
        self.assertIn("| CPU | Test \\| 1 |\n", text)
        self.assertIn("| load average before each measurement | 0.5 (0.5 … 1.50), 5 measurements |\n", text)
        self.assertIn("| 2 | 1.50, 0.50 |\n| 3 | 0.50, – |\n", text)

    def test_failures_are_named_and_leave_gaps(self):
        self.assertIn("\n- round 3, world, other: minetestserver is not installed\n", self.report())
        self.write(*map(json.dumps, [*LINES, line(3, "world", "peer", generation=120, disk=4500)]))
        self.assertNotIn("What failed", self.report())
        self.write(json.dumps(ABOUT), json.dumps(line(1, "world", "terrane", generation=1000)))
        self.assertIn("| Generating with light and saving | chunks per CPU second | higher | 1,000 | Luanti |  |  | 1 |\n",
                      self.report())

    def test_incomplete_views_are_named(self):
        frames = line(1, "frames_128", "peer", frames_128=5) | {"details": {"is_full": False, "fill_s": 600.2}}
        self.write(*map(json.dumps, [ABOUT, frames]))
        self.assertIn("- round 1, frames_128, other: the view was not complete after 600 s\n", self.report())

    def test_better_in_each_of_three_rounds_is_bold(self):
        self.write(*map(json.dumps, [*LINES, line(3, "world", "peer", generation=150, disk=4500)]))
        text = self.report()
        self.assertIn("| **10.0 (10.0 … 16.0)** | 3 |", text)
        self.assertIn("| **0.22 (0.2 … 0.25)** | 3 |", text)

    def test_one_worse_round_is_not_bold(self):
        self.write(*map(json.dumps, [*LINES, line(3, "world", "peer", generation=1600, disk=4500)]))
        self.assertIn("| 10.0 (0.938 … 16.0) | 3 |", self.report())

    def test_empty_and_cut_lines(self):
        expected = read_results(self.folder / "results.jsonl").values
        whole = list(map(json.dumps, LINES))
        self.write(*whole[:3], "", "   ", *whole[3:], whole[1][:25], end="")
        results = read_results(self.folder / "results.jsonl")
        self.assertEqual((results.values, results.dropped), (expected, 1))
        self.assertIn("- 1 lines of results.jsonl could not be read\n", self.report())
        append_line(self.folder / "results.jsonl", line(4, "world", "terrane", generation=1))
        self.assertEqual(read_results(self.folder / "results.jsonl").values["generation", "terrane"][4], 1)

    def test_lines_that_are_no_results(self):
        whole = list(map(json.dumps, LINES))
        wrong = ["[]", "3", '{"round":1}', '{"round":"x","job":"world","side":"peer","values":{}}',
                 '{"round":9,"job":"world","side":"peer","values":{"generation":NaN}}',
                 '{"round":9,"job":"world","side":"peer","values":[1]}', "[" * 5000]
        self.write(*whole, *wrong)
        self.assertEqual(read_results(self.folder / "results.jsonl").dropped, len(wrong))
        self.report()

    def test_nothing_measured(self):
        self.write("", end="")
        self.assertIn("## Figures of others, not measured here", self.report())

    def test_no_file(self):
        messages = io.StringIO()
        with contextlib.redirect_stderr(messages):
            self.assertEqual(report.main([str(self.folder / "none")]), 2)
        self.assertRegex(messages.getvalue(), r"\Acompare: .*results.jsonl: cannot be read: .*\n\Z")

    def test_summary(self):
        self.report()
        summary = (self.folder / "summary.md").read_text(encoding="utf-8")
        self.assertIn("| Generating with light and saving, chunks per CPU second | 1,500 | Luanti 112 | 13.0 (10.0 … 16.0) |\n", summary)


class Parts(unittest.TestCase):
    def test_ratios(self):
        self.assertEqual(figures.ratios_of_pairs({1: 2.0, 2: 3.0, 3: 1.0}, {1: 4.0, 3: 0.0, 4: 1.0}), [0.5])
        self.assertEqual([figures.format_number(n) for n in (0, 0.01234, 1.5, 12.34, 123.4, 12345.6)],
                         ["0", "0.0123", "1.50", "12.3", "123", "12,346"])
        self.assertEqual(figures.with_spread([]), "")

    def test_names_are_unique(self):
        names = [measure.name for measure in measures.MEASURES]
        self.assertEqual(len(set(names)), len(names))

    def test_openness(self):
        flat = places.Heights({(x, y): 10 for x in range(-50, 50) for y in range(-50, 50)}, water=0)
        walled = places.Heights({(x, y): 200 if x == 3 else 10 for x in range(-50, 50) for y in range(-50, 50)}, water=0)
        self.assertEqual(flat.openness(0, 0), 1)
        self.assertLess(walled.openness(0, 0), 0.8)


if __name__ == "__main__":
    unittest.main()
