"""Measurements of a soak: memory of all processes, and events with their time."""
import collections
import json
import os
import pathlib
import statistics
import time

SAMPLE_SECONDS = 10
# Allowed growth of memory from the second to the last quarter: players see other terrain in each round.
MOST_GROWTH, MOST_GROWTH_MB = 1.25, 8


def resident_mb(pid):
    """Memory of a process in MB, with its share of shared pages (PSS)."""
    try:
        for line in pathlib.Path(f"/proc/{pid}/smaps_rollup").read_text(encoding="ascii").splitlines():
            if line.startswith("Pss:"):
                return int(line.split()[1]) / 1024
    except (FileNotFoundError, ProcessLookupError, PermissionError):
        pass
    return 0.0


def children_of(folder):
    """Processes of the database with its data in `folder`, and their children."""
    first = [int(p) for p in os.listdir("/proc") if p.isdigit() and is_database_of(p, folder)]
    return first + [int(p) for p in os.listdir("/proc") if p.isdigit() and parent_of(p) in first]


def is_database_of(pid, folder):
    try:
        line = pathlib.Path(f"/proc/{pid}/cmdline").read_bytes()
    except OSError:
        return False
    return line.split(b"\0")[0].endswith(b"/postgres") and f"{folder}/data".encode() in line


def parent_of(pid):
    try:
        return int(pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="utf-8", errors="replace").rpartition(")")[2].split()[1])
    except (OSError, IndexError):
        return 0


class Record:
    def __init__(self, folder):
        self.samples, self.events = open(folder / "samples.jsonl", "w"), open(folder / "events.jsonl", "w")
        self.start, self.next = time.monotonic(), 0.0
        self.series = collections.defaultdict(list)  # name to (seconds, megabytes, process)
        self.counts = collections.Counter()

    def seconds(self):
        return round(time.monotonic() - self.start, 1)

    def event(self, what, **more):
        self.counts[what] += 1
        print(json.dumps({"seconds": self.seconds(), "event": what, **more}), file=self.events, flush=True)

    def sample(self, processes, database_folder):
        if self.seconds() < self.next:
            return
        self.next = self.seconds() + SAMPLE_SECONDS
        memory = {name: round(resident_mb(process.pid), 1) for name, process in processes.items()}
        memory["database"] = round(sum(map(resident_mb, children_of(database_folder))), 1)
        print(json.dumps({"seconds": self.seconds(), "memory_mb": memory}), file=self.samples, flush=True)
        for name, megabytes in memory.items():
            pid = processes[name].pid if name in processes else 0
            self.series[name].append((self.seconds(), megabytes, pid))

    def event_counts(self):
        return dict(self.counts)

    def memory(self):
        """Medians of the second and the last quarter, for processes that ran from the first to the last sample."""
        found = {}
        for name, samples in self.series.items():
            if len(samples) < 8 or samples[0][2] != samples[-1][2]:
                continue
            values = [megabytes for _, megabytes, _ in samples]
            quarter = len(values) // 4
            found[name] = {"second_quarter": statistics.median(values[quarter:2 * quarter]),
                           "last_quarter": statistics.median(values[-quarter:]), "most": max(values)}
        return found

    def memory_problems(self):
        return [f"{name}: memory grows from {found['second_quarter']:.0f} to {found['last_quarter']:.0f} MB"
                for name, found in self.memory().items()
                if found["last_quarter"] > MOST_GROWTH * found["second_quarter"] + MOST_GROWTH_MB]
