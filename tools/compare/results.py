"""results.jsonl: one JSON object per line. `about` describes the run; each other line is one side of one job in one round,
with its values by measure or the reason of its failure."""
import json
import math
import os


class BadInput(Exception):
    """One line that names the error and its place."""


class Results:
    def __init__(self):
        self.about = {}     # machine, versions, settings of the last run
        self.values = {}    # by (measure, side): {round: number}
        self.failures = {}  # reasons by (round, job, side), without later successes
        self.done = set()   # (round, job, side)
        self.loads = {}     # load averages before, by (round, job, side)
        self.details = {}   # by (job, side): {round: object}
        self.dropped = 0    # lines that could not be read

    def take(self, line):
        """Raises ValueError, KeyError or TypeError if the line is not a result."""
        if "about" in line:
            self.about = dict(line["about"])
            return
        key = int(line["round"]), str(line["job"]), str(line["side"])
        if "load" in line:
            self.loads[key] = float(line["load"])
        if "failure" in line:
            if key not in self.done:
                self.failures[key] = str(line["failure"])
            return
        numbers = {str(name): float(value) for name, value in line["values"].items()}
        if not all(map(math.isfinite, numbers.values())):
            raise ValueError("a value is no finite number")
        self.failures.pop(key, None)
        self.done.add(key)
        self.details.setdefault(key[1:], {})[key[0]] = line.get("details") or {}
        for name, value in numbers.items():
            self.values.setdefault((name, key[2]), {})[key[0]] = value


def read_results(path):
    """Skips and counts empty or truncated lines. Raises BadInput if the file cannot be read."""
    results = Results()
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise BadInput(f"{path}: cannot be read: {error.strerror}") from error
    for line in filter(str.strip, text.split("\n")):
        try:
            results.take(json.loads(line))
        except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
            results.dropped += 1
    return results


def append_line(path, value):
    """Writes the line to disk. Starts a new line if the last one was truncated."""
    with open(path, "ab+") as file:
        file.seek(0, os.SEEK_END)
        if size := file.tell():
            file.seek(size - 1)
            if file.read(1) != b"\n":
                file.write(b"\n")
        file.write(json.dumps(value, ensure_ascii=False).encode() + b"\n")
        file.flush()
        os.fsync(file.fileno())
