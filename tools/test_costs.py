#!/usr/bin/env python3
"""Writes tests/costs.txt, by which CTest starts long tests first, from the last runs of the tests in a build folder.

    tools/test_costs.py [BUILD_FOLDER]    build unless told otherwise"""
import pathlib
import sys

LEAST_SECONDS = 2
ROOT = pathlib.Path(__file__).parents[1]


def main():
    build = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build")
    costs = {}
    # A line for each test: its name, the number of its runs, their mean seconds; then "---" and the names of failures.
    for line in (build / "Testing/Temporary/CTestCostData.txt").read_text().split("---")[0].splitlines():
        name, _, seconds = line.rsplit(" ", 2)
        costs[name] = round(float(seconds))
    long = sorted(((seconds, name) for name, seconds in costs.items() if seconds >= LEAST_SECONDS), reverse=True)
    (ROOT / "tests/costs.txt").write_text(
        "# Seconds of tests that take long: tools/test_costs.py writes this file.\n" +
        "".join(f"{name} {seconds}\n" for seconds, name in long))


main()
