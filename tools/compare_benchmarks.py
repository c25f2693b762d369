#!/usr/bin/env python3
"""Compares two runs of the benchmarks and lists times that became slower beyond noise.

    compare_benchmarks.py BEFORE AFTER [--threshold PERCENT] [--all]

Both files are output of a bench_… program with --benchmark_format=json (--benchmark_out=FILE), or both results.jsonl of
`terrane bench`. Times are compared by their medians. A time is slower if its median grew by more than the threshold
(15 % by default) and the middle halves of its repetitions do not overlap. Exit code: 0 nothing is slower, 1 something
is, 2 the files cannot be compared. Times of only one run are listed and do not count.
"""

import argparse
import json
import statistics
import sys

TO_NANOSECONDS = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}
DEFAULT_THRESHOLD = 15.0  # per cent; the same code varies by that much between runs on a shared machine
# Members of a measurement of `terrane bench` that are times in milliseconds: less is better.
TIMES = ("milliseconds", "passes", "tasks", "flight")
# Members of these that are not times of the program: settings, counts, and the duration of the flight.
NO_TIMES = ("count", "view_distance", "frames", "by_second", "seconds_of_flight", "chunks_missing_on_landing",
            "frames_over_twice_the_median", "of_these_by_loading")


class BadInput(Exception):
    """One line that names the error and its place."""


def read(path):
    """Kind of the file, and its times by name: lists with one number per repetition."""
    try:
        with open(path, encoding="utf-8") as file:
            text = file.read()
    except (OSError, UnicodeDecodeError) as error:
        raise BadInput(f"{path}: cannot be read: {error}") from error
    try:
        value = json.loads(text)
    except ValueError:
        return "terrane bench", read_lines(path, text)
    if isinstance(value, dict) and isinstance(value.get("benchmarks"), list):
        return "Google Benchmark", read_google(path, value["benchmarks"])
    return "terrane bench", read_lines(path, text)


def read_google(path, benchmarks):
    """CPU time of each repetition; with aggregates only, their median. Wall time for benchmarks that use it because other
    threads or the disk work for them."""
    times, medians = {}, {}
    for run in benchmarks:
        try:
            name = run.get("run_name", run["name"])
            is_by_clock = "/real_time" in name and "/process_time" not in name
            nanoseconds = run["real_time" if is_by_clock else "cpu_time"] * TO_NANOSECONDS[run["time_unit"]]
        except (KeyError, TypeError, AttributeError) as error:
            if isinstance(run, dict) and run.get("error_occurred"):
                continue
            raise BadInput(f"{path}: a benchmark without name, time or time_unit") from error
        if run.get("run_type") != "aggregate":
            times.setdefault(name, []).append(nanoseconds)
        elif run.get("aggregate_name") == "median":
            medians[name] = [nanoseconds]
    return {**medians, **times}


def read_lines(path, text):
    """Times of each run of each cell, by command line and place in the result."""
    lines = text.split("\n")
    times, number = {}, 0
    for number, line in enumerate(lines[:-1], 1):  # text after the last line end is truncated
        try:
            value = json.loads(line)
            if number == 1:
                _ = value["settings"]
            elif "result" in value:
                for name, time in times_in(value["result"]):
                    times.setdefault(f"{' '.join(value['cell'])}: {name}", []).append(time)
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise BadInput(f"{path}:{number}: not a result of terrane bench") from error
    if number == 0:
        raise BadInput(f"{path}:1: neither JSON of Google Benchmark nor results of terrane bench")
    return times


def times_in(result):
    """Names and nanoseconds of the times in a measurement."""
    for group in TIMES:
        yield from numbers_in(result.get(group, {}), group)


def numbers_in(value, name):
    if isinstance(value, dict):
        for key, member in value.items():
            if key not in NO_TIMES:
                yield from numbers_in(member, f"{name}/{key}")
    elif isinstance(value, (int, float)):
        unit = "s" if "/seconds" in name else "ms"
        yield name, value * TO_NANOSECONDS[unit]


def middle_half(times):
    """First and third quartile; with few repetitions, minimum and maximum."""
    if len(times) < 4:
        return min(times), max(times)
    first, _, third = statistics.quantiles(times, n=4, method="inclusive")
    return first, third


class Change:
    """The change of one time."""

    def __init__(self, name, before, after, threshold):
        self.name = name
        self.before, self.after = statistics.median(before), statistics.median(after)
        self.ratio = self.after / self.before if self.before > 0 else 1.0
        limit = 1 + threshold / 100
        self.is_slower = self.ratio > limit and middle_half(after)[0] > middle_half(before)[1]
        self.is_faster = self.ratio < 1 / limit and middle_half(after)[1] < middle_half(before)[0]

    def line(self):
        word = "slower" if self.is_slower else "faster" if self.is_faster else ""
        return f"{shown(self.before):>10} {shown(self.after):>10} {100 * (self.ratio - 1):>+8.1f} %  {word:<7} {self.name}"


def shown(nanoseconds):
    for unit, size in (("s", 1e9), ("ms", 1e6), ("µs", 1e3)):
        if nanoseconds >= size:
            return f"{nanoseconds / size:.3g} {unit}"
    return f"{nanoseconds:.3g} ns"


def compare(before, after, threshold):
    """Changes of the times that both have, by name."""
    return [Change(name, before[name], after[name], threshold) for name in sorted(before) if name in after]


def report(before, after, threshold, shows_all):
    """Prints the changes; returns whether something is slower."""
    changes = compare(before, after, threshold)
    slower = [c for c in changes if c.is_slower]
    for change in changes:
        if shows_all or change.is_slower or change.is_faster:
            print(change.line())
    for name in sorted(set(before) ^ set(after)):
        print(f"only {'before' if name in before else 'after'}: {name}")
    print(f"{len(changes)} times compared, {len(slower)} slower, {sum(c.is_faster for c in changes)} faster "
          f"(by more than {threshold:g} % and beyond their spread)")
    return bool(slower)


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before")
    parser.add_argument("after")
    parser.add_argument("--threshold", type=float, default=DEFAULT_THRESHOLD, metavar="PERCENT")
    parser.add_argument("--all", action="store_true", help="show what did not change, too")
    options = parser.parse_args(arguments)
    if not options.threshold >= 0:
        parser.error("--threshold: expected a number from 0")
    try:
        (kind_before, before), (kind_after, after) = read(options.before), read(options.after)
        if kind_before != kind_after:
            raise BadInput(f"{options.before} is of {kind_before}, {options.after} of {kind_after}")
        if not set(before) & set(after):
            raise BadInput(f"{options.before} and {options.after} have no time in common")
    except BadInput as error:
        print(f"compare_benchmarks: {error}", file=sys.stderr)
        return 2
    return 1 if report(before, after, options.threshold, options.all) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
