#!/usr/bin/env python3
"""Plays for hours on servers of one world in PostgreSQL, with kills, and compares the world on all sides at the end.

    tools/soak.py PROGRAM FOLDER [--minutes 120] [--bots 100] [--round 20] [--pause 60] [--seed 1]

Three servers, bots on all of them, two windows on virtual displays whose players walk, look around, break and place.
Every --pause seconds one thing happens, in turn: a server is killed, the database is stopped, another server is
killed, the database is killed, a window is killed; each is started again after 5 s. The third server and the first
window run all the time: their memory is told, and may grow by a quarter and 8 MB from the second quarter of the time to
the last. Bots come and go in rounds of --round minutes.

At the end, when all is quiet, one world must be in the database's chunks, in its history (played again on land that is
generated anew), in a copy in one file, in what the bots were told is kept, and in what the windows know.

FOLDER gets samples.jsonl (memory of all, every 10 s), events.jsonl, result.json and the logs; soak_plot.py draws them.
Exit code 1 if something is wrong. Needs PostgreSQL, Xvfb, xdotool, NumPy (Debian: python3-numpy)."""
import argparse
import json
import pathlib
import sys
import time

from scratch_postgres import ScratchPostgres, free_port
from soak import GENERATOR
from soak.bots import Bots
from soak.checks import compare_worlds, history_problems
from soak.events import Events
from soak.record import Record
from soak.windows import Window
from server_tools import Server

QUIET_SECONDS = 60  # without events, at the end


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--minutes", type=float, default=120)
    parser.add_argument("--bots", type=int, default=100)
    parser.add_argument("--round", type=float, default=20, help="minutes of a round of bots (20)")
    parser.add_argument("--pause", type=float, default=60, help="seconds from one event to the next (60)")
    parser.add_argument("--seed", type=int, default=1, help="of the players in the windows")
    return parser.parse_args()


class Soak:
    """All running processes."""

    def __init__(self, options, postgres):
        self.program, self.folder, self.postgres = options.program.resolve(), options.folder, postgres
        self.record = Record(options.folder)
        self.servers = [self.start_server(k, free_port()) for k in range(3)]
        self.windows = [self.start_window(k, options.seed + k) for k in range(2)]
        self.bots = Bots(self.program, self.folder, options.bots, options.round * 60)

    def start_server(self, number, port):
        folder = self.folder / f"server{number}"
        folder.mkdir(exist_ok=True)
        return Server(self.program, folder, port, "--generator", GENERATOR, "--spawn-radius", "60", url=self.postgres.url())

    def start_window(self, number, seed):
        ports = [server.port for server in self.servers]
        return Window(self.program, self.folder / f"window{number}", ("Ann", "Bob")[number], ports[2 - number], seed)

    def processes(self):
        """Name to process."""
        found = {f"server {k + 1}": server.process for k, server in enumerate(self.servers)}
        found |= {f"window {k + 1}": window.process for k, window in enumerate(self.windows)}
        return found | ({"bots": self.bots.process} if self.bots.process else {})

    def ended(self):
        """Names of processes that ended with an error."""
        return [name for name, process in self.processes().items() if process.poll() not in (None, 0)]

    def run(self, minutes, pause):
        end = time.monotonic() + minutes * 60
        events = Events(self, pause)
        while time.monotonic() < end:
            left = end - time.monotonic()
            if minutes * 60 - left > QUIET_SECONDS / 4:  # the servers have generated their terrain
                self.bots.keep_running(self.servers, left)
            if left > QUIET_SECONDS:
                events.update()
            self.record.sample(self.processes(), self.postgres.folder)
            if ended := self.ended():
                return [f"{name} ended by itself" for name in ended]
            time.sleep(1)
        return []

    def stop(self):
        """Stops players first, so that all their edits reach the servers; returns problems."""
        problems = []
        for window in self.windows:
            window.rest()
        problems += self.bots.finish()
        time.sleep(20)
        problems += [f"{window.name}: {problem}" for window in self.windows for problem in window.close()]
        problems += [f"server {k + 1} ended badly" for k, server in enumerate(self.servers) if server.stop() != 0]
        return problems


def main():
    options = parse()
    options.folder = options.folder.resolve()
    if options.folder.exists():
        sys.exit(f"soak: {options.folder}: exists already: name a new folder")
    if not options.program.is_file():
        sys.exit(f"soak: {options.program}: no such program")
    options.folder.mkdir(parents=True)
    with ScratchPostgres(durable=True) as postgres:
        soak = Soak(options, postgres)
        start = time.time()
        problems = soak.run(options.minutes, options.pause)
        hours = (time.time() - start) / 3600
        problems += soak.record.memory_problems()
        problems += soak.stop()
        problems += history_problems(postgres)
        worlds, more = compare_worlds(soak.program, postgres, options.folder, soak.windows, soak.bots)
        problems += more
    result = {"hours": round(hours, 2), "bots": options.bots, "events": soak.record.event_counts(),
              "edits": soak.bots.edits, "worlds": worlds, "memory_mb": soak.record.memory(), "problems": problems}
    (options.folder / "result.json").write_text(json.dumps(result, indent=1) + "\n")
    print(json.dumps(result, indent=1))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
