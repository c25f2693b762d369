#!/usr/bin/python3
"""tools/bench_report.py. bench_report/ has measurements of 64×36 pixels at view distance 1 and the report of them.
Usage: bench_report_test.py SCRIPT. Ends with 77 where Python has no pandas or matplotlib."""
import contextlib
import csv
import io
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SCRIPT.parent))

try:
    from bench_report import cells, table, text
    from bench_report.command import main
    from bench_report.report import all_tables
    from bench_report.results import read_results
except ModuleNotFoundError as missing:
    print(f"skipped: {missing}; needs python3-pandas and python3-matplotlib")
    sys.exit(77)

FIXTURE = pathlib.Path(__file__).parent / "bench_report"
SETTINGS = cells.Settings(is_quick=False, size="1920x1080", view_distance=32, farthest=64, frames=9, most_samples=4,
                          is_software=True, flight_seconds=20)


def run(*arguments):
    """Exit code and messages."""
    messages = io.StringIO()
    with contextlib.redirect_stderr(messages):
        return main(list(map(str, arguments)), ""), messages.getvalue()


class ReportTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.lines = (FIXTURE / "results.jsonl").read_text(encoding="utf-8").splitlines(keepends=True)

    def write(self, lines):
        (self.folder / "results.jsonl").write_text("".join(lines), encoding="utf-8")

    def report(self, *arguments):
        self.assertEqual(run(self.folder, *arguments), (0, ""))
        return (self.folder / "report.md").read_text(encoding="utf-8")

    def rows(self, name):
        with open(self.folder / "tables" / f"{name}.csv", encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def assertRefused(self, message, *arguments):
        code, messages = run(*(arguments or [self.folder]))
        self.assertEqual((code, messages.count("\n")), (2, 1), messages)
        self.assertIn(message, messages)


class Report(ReportTest):
    def test_all_tables(self):
        done = subprocess.run([sys.executable, "-B", SCRIPT, FIXTURE, "--output", self.folder / "new" / "report"],
                              capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        made = self.folder / "new" / "report"
        names = sorted(path.name for path in (FIXTURE / "tables").iterdir())
        self.assertEqual(sorted(path.name for path in (made / "tables").iterdir()), names)
        for name in ["report.md", *(f"tables/{name}" for name in names)]:
            self.assertEqual((made / name).read_text(encoding="utf-8"), (FIXTURE / name).read_text(encoding="utf-8"), name)
        for plot in ("merging", "effect-costs", "flight-curve", "passes", "region-height-load",
                     "region-height-triangles", "resolution", "shading", "shadow-triangles-curve", "view-distance-frame",
                     "view-distance-load"):
            self.assertIn("</svg>", (made / "plots" / f"{plot}.svg").read_text(encoding="utf-8"), plot)
        svg = (made / "plots" / "passes.svg").read_text(encoding="utf-8")
        for label in ("ocean, ms", "shadow map", "milliseconds", "Passes of the frame"):
            self.assertIn(label, svg)

    def test_a_refusal(self):
        done = subprocess.run([sys.executable, "-B", SCRIPT, self.folder], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertRegex(done.stderr, r"\Abench_report: .*/results.jsonl: cannot be read: No such file or directory\n\Z")

    def test_only_the_tables_that_are_named(self):
        self.write(self.lines)
        report = self.report("disk", "layers")
        self.assertEqual([line for line in report.splitlines() if line.startswith("## ")],
                         ["## Transparency layers (table 6.13)", "## Saves"])
        self.assertEqual(len(list((self.folder / "tables").iterdir())), 2)
        self.assertEqual(list((self.folder / "plots").iterdir()), [])

    def test_equal_results_make_equal_plots(self):
        self.write(self.lines)
        plot = self.folder / "plots" / "resolution.svg"
        self.report("resolution")
        first = plot.read_bytes()
        self.report("resolution")
        self.assertEqual(plot.read_bytes(), first)


class Gaps(ReportTest):
    def test_what_was_not_measured_is_a_gap(self):
        self.write(line for line in self.lines if '"desert"' not in line)
        self.assertIn("\n| desert |  |  |  |  |\n", self.report("disk"))
        self.assertEqual(self.rows("disk")[1], {"scene": "desert", "chunks": "", "file, MB": "", "bytes per chunk": "",
                                                "load all in view, s": ""})
        self.assertNotIn("failed", self.report("disk"))

    def test_what_failed_is_named(self):
        cell = '{"cell":["render","--scene","cave","--preset","low","--view-distance","1","--size","320x180",' \
               '"--save-game","cave-1"],'
        self.write([line for line in self.lines if not line.startswith(cell)] + [cell + '"failure":"too dark"}\n'])
        report = self.report("disk")
        self.assertIn("\n| cave | failed | failed | failed | failed |\n", report)
        self.assertIn("\nFailed measurements:\n\n- `render --scene cave --preset low --view-distance 1 --size 320x180 --world "
                      "cave-1`: too dark\n", report)

    def test_every_table_of_nothing(self):
        self.write(self.lines[:1])
        self.assertNotIn("## ", self.report())
        report = self.report(*(path.stem for path in (FIXTURE / "tables").iterdir()))
        self.assertEqual(report.count("\n## "), 19)
        self.assertIn("\n| cave |  |  |  |  |\n", report)

    def test_every_single_measurement_alone(self):
        for line in self.lines[1::7]:
            self.write([self.lines[0], line])
            results = read_results(self.folder / "results.jsonl")
            for one in all_tables(cells.settings_of(results)):
                text.markdown_of(one, results)
                text.csv_of(one, results)

    def test_tables_of_which_nothing_was_measured_are_left_out(self):
        self.write(self.lines[:1] + [line for line in self.lines if '"--memory-copy"' in line])
        report = self.report()
        self.assertEqual(report.count("\n## "), 1)
        self.assertIn("\n## Stages of a chunk\n", report)

    def test_a_last_line_that_was_cut_short(self):
        self.write(self.lines)
        whole = self.report("disk")
        self.write([*self.lines, '{"cell": ["ren'])
        self.assertEqual(self.report("disk"), whole)


class BadInput(ReportTest):
    def test_bad_lines(self):
        for line in ("text", "7", "{}", "", '{"cell":7,"result":{}}', '{"cell":[7],"result":{}}', '{"cell":["a"]}',
                     '{"cell":["a"],"result":7}', '{"cell":["a"],"result":{"b":NaN}}', 5000 * "["):
            self.write([*self.lines[:4], line + "\n", *self.lines[4:]])
            self.assertRefused(f"bench_report: {self.folder}/results.jsonl:5: not a result of terrane bench\n")

    def test_a_line_that_is_no_utf_8(self):
        (self.folder / "results.jsonl").write_bytes(self.lines[0].encode() + b'{"cell": ["\xff"], "result": {}}\n')
        self.assertRefused("results.jsonl:2: not a result of terrane bench")

    def test_other_files(self):
        for content in ("", "text", "text\n", "7\n", "{}\n", '{"settings": 7}\n'):
            self.write([content])
            self.assertRefused("results.jsonl:1: not results of terrane bench")
        self.write(['{"settings": {"quick": true}}\n'])
        self.assertRefused("without the settings of terrane bench")

    def test_files_that_are_not_there(self):
        self.assertRefused(f"{self.folder}/results.jsonl: cannot be read: No such file")

    def test_a_table_that_is_not_there(self):
        self.write(self.lines)
        self.assertRefused("no table disc; there are goals, region-height, ", self.folder, "disc")

    def test_a_folder_that_cannot_be_made(self):
        self.write(self.lines)
        self.assertRefused("results.jsonl/new/tables: cannot be written: ", self.folder, "-o",
                           self.folder / "results.jsonl" / "new")


class Numbers(ReportTest):
    def results(self, *runs):
        self.write([json.dumps({"settings": {}}) + "\n",
                    *(json.dumps({"cell": [cell], **line}) + "\n" for cell, line in runs)])
        return read_results(self.folder / "results.jsonl")

    def two_scenes(self):
        return self.results(("cave", {"result": {"frame": 20, "chunks": 100, "bytes": 5000, "zero": 0, "file": "a"}}),
                            ("ocean", {"result": {"frame": 50, "chunks": 300, "bytes": 9000}}),
                            ("desert", {"failure": "no sand"}))

    def test_medians_of_runs(self):
        results = self.results(*(("cave", {"result": {"frame": frame, "passes": {"sky": sky}, "times": times}})
                                 for frame, sky, times in ((30, 1, [1, 2]), (10, 9, [3, 4]), (20, 4, [5, 6]))),
                               ("cave", {"result": {"frame": 40, "chunks": 8}}))
        self.assertEqual(results.number("cave", "/frame"), 25)
        self.assertEqual(results.number("cave", "/passes/sky"), 4)
        self.assertEqual(results.number("cave", "/chunks"), 8)
        self.assertEqual(results.number("cave", "/times/1"), 2, "arrays are those of the first run")
        for pointer in ("/times", "/times/2", "/times/x", "/passes", "/none", ""):
            self.assertIsNone(results.number("cave", pointer), pointer)
        self.assertIsNone(results.number("ocean", "/frame"))

    def test_a_success_takes_a_failure_away(self):
        failure, result = ("cave", {"failure": "dark"}), ("cave", {"result": {"frame": 1}})
        self.assertEqual(self.results(failure, result).failures, {})
        self.assertEqual(self.results(result, failure).failures, {"cave": "dark"})

    def test_values(self):
        results = self.two_scenes()
        for what, number in ((table.Value("/frame"), 20), (table.Value("/frame", 0.5), 10),
                             (table.Value("/frame", 1000, True), 50), (table.Value("/frame", 10, False, "/chunks"), 2),
                             (table.Value("/frame", 10, True, "/chunks"), 50), (table.Value("/none"), None),
                             (table.Value("/file"), None), (table.Value("/zero", 1, True), None),
                             (table.Value("/frame", per="/zero"), None), (table.Value("/frame", per="/none"), None)):
            self.assertEqual(what.of(results, "cave"), number, what)

    def test_entries(self):
        results, frame = self.two_scenes(), table.Value("/frame")
        for entry, number in ((table.share("cave", "ocean", frame), 40), (table.share("cave", "desert", frame), None),
                              (table.difference("ocean", "cave", frame), 30),
                              (table.total("cave", [frame, table.Value("/chunks", 2)]), 220),
                              (table.total("cave", [frame, table.Value("/none")]), None)):
            self.assertEqual(entry.number(results), number)

    def test_lines_through_measurements(self):
        results = self.two_scenes()  # (100, 5000) and (300, 9000)
        chunks, size = table.Value("/chunks"), table.Value("/bytes")
        both = ["cave", "ocean"]
        self.assertEqual(table.slope(both, chunks, [size]).number(results), 20)
        self.assertEqual(table.intercept(both, chunks, [size]).number(results), 3000)
        self.assertEqual(table.slope(both, chunks, [size, size]).number(results), 40)
        self.assertIsNone(table.slope(["cave"], chunks, [size]).number(results))

    def test_figures(self):
        for number, shown in ((0, "0"), (-0.0, "0"), (7, "7"), (0.000044, "< 0.001"), (-70, "-70"), (0.0123456, "0.0123"),
                              (1.2345, "1.23"), (9.996, "10.0"), (12.345, "12.3"), (99.96, "100"), (999.4, "999"),
                              (1234, "1,234"), (123456.7, "123,457"), (1234567, "1,234,567"), (-1234, "-1,234"),
                              (-123, "-123")):
            self.assertEqual(text.format_figure(number), shown)

    def test_special_characters(self):
        frame = table.value("cave", table.Value("/frame", 1 / 3))
        none = table.value("cave", table.Value("/none"))
        one = table.Table("t", "T", "", "", ["a|b, \"c\"", "ms"], [["x|y,", frame], ["plain", none]])
        self.assertEqual(text.markdown_of(one, self.two_scenes()),
                         '| a\\|b, "c" | ms |\n|---|---|\n| x\\|y, | 6.67 |\n| plain | – |\n')
        self.assertEqual(text.csv_of(one, self.two_scenes()), '"a|b, ""c""",ms\n"x|y,",6.66666667\nplain,\n')


class Plan(unittest.TestCase):
    """Every table, quick and complete, has one entry per column and plots only existing columns."""

    def test_tables_are_whole(self):
        quick = cells.Settings(True, "320x180", 8, 8, 3, 4, True, 4)
        near = cells.Settings(False, "64x36", 1, 1, 9, 8, False, 20)
        for settings in (SETTINGS, quick, near):
            tables = all_tables(settings)
            self.assertEqual(len({one.name for one in tables}), 19)
            for one in tables:
                self.assertTrue(all((one.title, one.about, one.cut, one.rows, one.cells())), one.name)
                for row in one.rows:
                    self.assertEqual(len(row), len(one.columns), one.name)
                for plot in one.plots:
                    self.assertLess(max(plot.columns), len(one.columns), one.name)

    def test_samples_that_the_driver_does_not_have(self):
        shadow_maps = next(one for one in all_tables(SETTINGS) if one.name == "shadow-maps")
        self.assertEqual(shadow_maps.rows[3][:3], [8, "not offered", 23])


if __name__ == "__main__":
    unittest.main(verbosity=1)
