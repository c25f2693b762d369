#!/usr/bin/env python3
"""tools/coverage.py without builds: modules of files and the table. Usage: coverage_test.py SCRIPT"""
import pathlib
import subprocess
import sys
import unittest

SCRIPT = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SCRIPT.parent))

from coverage import ROOT, module_of, table_of  # noqa: E402


class Coverage(unittest.TestCase):
    def test_modules_are_those_of_the_library_and_the_program(self):
        self.assertEqual(module_of(f"{ROOT}/terrane/gen/language/builder.h"), "gen")
        self.assertEqual(module_of("terrane/mesh/remesh.cpp"), "mesh")
        self.assertEqual(module_of(f"{ROOT}/apps/terrane/window/game/game.cpp"), "app")
        for other in (f"{ROOT}/tests/gen/op_test.cpp", f"{ROOT}/build-coverage/embedded/a.cpp", "/usr/include/c++/12/vector"):
            self.assertIsNone(module_of(other), other)

    def test_the_table_has_both_depths_and_sums_counts(self):
        def counts(lines, branches):
            return {"lines": lines, "branches": branches}
        table = table_of({"gate": {"gen": counts([1, 4], [0, 0]), "mesh": counts([3, 4], [1, 2])},
                          "all": {"gen": counts([2, 4], [0, 0])}})
        self.assertEqual(table.split("\n"),
                         ["| module | lines % (gate) | lines % (all) | branches % (gate) | branches % (all) |",
                          "| --- | --- | --- | --- | --- |",
                          "| gen | 25.0 | 50.0 | – | – |",
                          "| mesh | 75.0 | – | 50.0 | – |",
                          "| all | 50.0 | 50.0 | 50.0 | – |"])

    def test_a_wrong_depth_is_refused_before_anything_is_built(self):
        done = subprocess.run([sys.executable, "-B", SCRIPT, "deep"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("expected depths: gate, all", done.stderr)


if __name__ == "__main__":
    unittest.main()
