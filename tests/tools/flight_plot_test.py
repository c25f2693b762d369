#!/usr/bin/python3
"""tools/flight_plot.py on flights of three frames. Usage: flight_plot_test.py SCRIPT. Ends with 77 where Python has no
pandas or matplotlib."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = sys.argv.pop(1)

try:
    import matplotlib.font_manager  # noqa: F401  fills a cache, with a message
    import pandas  # noqa: F401
except ModuleNotFoundError as missing:
    print(f"skipped: {missing}; needs python3-pandas and python3-matplotlib")
    sys.exit(77)

# As terrane flight-bench writes it.
FLIGHT = """\
time_s,frame_ms,follow_ms,upload_ms,draw_ms,follow_cpu_ms,upload_cpu_ms,uploads,visible_chunks,\
chunks_in_view,queued_chunks
0.0000,20.000,1.000,2.000,15.000,0.500,1.500,3,9,25,0
0.0200,90.000,1.000,60.000,15.000,0.500,59.500,3,9,25,0
0.1100,22.000,1.000,2.000,15.000,0.500,1.500,3,9,25,0
"""


class FlightPlot(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for distance in (16, 32):
            (self.folder / f"standing_{distance}.csv").write_text("0,15\n2,16\n")
            for name in ("generating", "from_disk"):
                (self.folder / f"{name}_{distance}.csv").write_text(FLIGHT)

    def plot(self):
        return subprocess.run([sys.executable, "-B", SCRIPT, self.folder], capture_output=True, text=True, check=False)

    def test_four_flights(self):
        done = self.plot()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        svg = (self.folder / "flight.svg").read_text(encoding="utf-8")
        for label in ("generating, view distance 16", "from a save, view distance 32", "twice the median",
                      "of it loading (CPU time)", "the same place, nothing to load"):
            self.assertIn(label, svg)

    def test_what_is_missing_is_named(self):
        (self.folder / "standing_32.csv").unlink()
        done = self.plot()
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"\Aflight_plot: .*standing_32.csv.*\n\Z")

    def test_other_files(self):
        for content in ("", "a,b\n1,2\n"):
            (self.folder / "from_disk_16.csv").write_text(content)
            done = self.plot()
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, r"\Aflight_plot: .*\n\Z")


if __name__ == "__main__":
    unittest.main(verbosity=1)
