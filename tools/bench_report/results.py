"""results.jsonl: one JSON value per line. The first has the settings. Each other one is a run of a cell: a command line
of the program and its result, or the reason of its failure."""

import json
import math

import pandas


class BadInput(Exception):
    """One line: the mistake and its place."""


class Results:
    """Numbers are medians over the runs of a cell; arrays come from the first run that has them."""

    def __init__(self, about, runs, arrays, failures):
        self.about = about        # settings of the run, by name
        self.runs = runs          # one row per run, one column per JSON pointer of a number; "cell" names the cell
        self.arrays = arrays      # by cell and JSON pointer
        self.failures = failures  # reasons by cell, of cells whose last run failed
        self.medians = runs.groupby("cell").median()

    def has(self, cell):
        return cell in self.medians.index

    def was_tried(self, cell):
        return self.has(cell) or cell in self.failures

    def number(self, cell, pointer):
        """None if missing. A pointer into an array ends with an index."""
        array, _, index = pointer.rpartition("/")
        if (cell, array) in self.arrays:
            numbers = self.arrays[cell, array]
            return float(numbers[int(index)]) if index.isdigit() and int(index) < len(numbers) else None
        if not self.has(cell) or pointer not in self.medians.columns:
            return None
        number = self.medians.at[cell, pointer]
        return None if math.isnan(number) else float(number)


def read_results(path):
    """Raises BadInput. Ignores text after the last line end: a line that was cut short."""
    try:
        lines = path.read_bytes().split(b"\n")[:-1]
    except OSError as error:
        raise BadInput(f"{path}: cannot be read: {error.strerror}") from error
    about = parse(lines[0]) if lines else None
    if not isinstance(about, dict) or not isinstance(about.get("settings"), dict):
        raise BadInput(f"{path}:1: not results of terrane bench")
    runs, arrays, failures = [], {}, {}
    for number, line in enumerate(lines[1:], 2):
        try:
            take_run(parse(line), runs, arrays, failures)
        except (ValueError, KeyError, TypeError) as error:
            raise BadInput(f"{path}:{number}: not a result of terrane bench") from error
    frame = pandas.DataFrame(runs, columns=None if runs else ["cell"])
    return Results(about["settings"], frame, arrays, failures)


# Names of commands and flags in files that 0.1 wrote.
FORMER_NAMES = {"fly": "flight-bench", "--for": "--duration", "--aggregation": "--merging",
                "--region-height": "--mesh-section-height", "--atmosphere": "--distance-fog",
                "--better-texturing": "--sharp-filtering", "--save-game": "--world"}


def parse(line):
    """None if the line is not JSON."""
    def refuse(word):
        raise ValueError(word)
    try:
        return json.loads(line, parse_constant=refuse)
    except (ValueError, RecursionError):
        return None


def take_run(line, runs, arrays, failures):
    """Adds a run. ValueError, KeyError, TypeError: the line is not a run."""
    cell = " ".join(FORMER_NAMES.get(word, word) for word in line["cell"])
    if "result" not in line:
        failures[cell] = str(line["failure"])
        return
    if not isinstance(line["result"], dict):
        raise ValueError("a result is an object")
    failures.pop(cell, None)
    run = {"cell": cell}
    for pointer, value in leaves(line["result"], ""):
        if isinstance(value, list):
            arrays.setdefault((cell, pointer), value)
        else:
            run[pointer] = value
    runs.append(run)


def leaves(value, pointer):
    """Numbers and arrays of numbers in `value` with their JSON pointers."""
    if isinstance(value, dict):
        for key, member in value.items():
            yield from leaves(member, f"{pointer}/{key}")
    elif isinstance(value, list):
        if all(is_number(member) for member in value):
            yield pointer, value
    elif is_number(value):
        yield pointer, float(value)


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < 1e300
