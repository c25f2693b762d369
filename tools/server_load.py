#!/usr/bin/env python3
"""Measures a server with increasing numbers of bots on this machine.

For each number a new world is served, bots join, walk and build (one in ten), and a line is
printed: ticks of the server, delay until another player gets an edit, bytes, memory. server_load_plot.py draws them."""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

from server_tools import Server, bots_command

COLUMNS = ("bots", "tick_ms_median", "tick_ms_p99", "tick_ms_worst_p99", "seen_ms_median", "seen_ms_p99",
           "decided_ms_p99", "received_kb_s", "sent_kb_s", "server_mb", "server_cpu", "edits", "joined", "cuts")


def windows_with(statistics, count):
    """The statistics while all bots were connected."""
    lines = [json.loads(line) for line in statistics.read_text().splitlines()]
    full = [line for line in lines if line["players"] == count]
    return full[1:] or full  # the first one includes joins


def measure(program, folder, count, options):
    folder.mkdir()
    world = [*(["--generator", options.generator] if options.generator else []),
             *(["--content", options.content] if options.content else [])]
    server = Server(program, folder, 0, "--spawn-radius",
                    str(10 if options.behaviour == "crowd" else options.spawn_radius), *world)
    try:
        done = subprocess.run(
            bots_command(program, server.port, "--count", str(count), "--seconds", str(options.seconds), "--behaviour",
                         options.behaviour), stdout=subprocess.PIPE, check=True)
    finally:
        code = server.stop()
    if code != 0:
        raise RuntimeError(f"the server ended with {code}")
    bots, windows = json.loads(done.stdout), windows_with(server.statistics, count)
    worst = [window["tick_ms_p99"] for window in windows]
    middle = lambda name: sorted(window[name] for window in windows)[len(windows) // 2]
    return {"bots": count, "tick_ms_median": middle("tick_ms_median"), "tick_ms_p99": middle("tick_ms_p99"),
            "tick_ms_worst_p99": max(worst), "seen_ms_median": bots["seen_ms_median"],
            "seen_ms_p99": bots["seen_ms_p99"], "decided_ms_p99": bots["decided_ms_p99"],
            "received_kb_s": bots["received_kb_s_player"], "sent_kb_s": bots["sent_kb_s_player"],
            "server_mb": max(window["memory_mb"] for window in windows), "server_cpu": middle("cpu_seconds") / 10,
            "edits": bots["edits"], "joined": bots["joined"], "cuts": bots["cuts"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--counts", default="10,30,100,300,500,1000", help="how many bots, in turn")
    parser.add_argument("--seconds", type=float, default=60, help="with all of them there")
    parser.add_argument("--behaviour", choices=("walk", "build", "crowd"), default="walk")
    parser.add_argument("--spawn-radius", type=int, default=1000, help="blocks over which they are spread; a crowd begins in 10")
    parser.add_argument("--generator", help="of the world; else the program's default")
    parser.add_argument("--content", help="the content pack that has the generator")
    options = parser.parse_args()
    print("\t".join(COLUMNS), flush=True)
    with tempfile.TemporaryDirectory(prefix="terrane-load-") as folder:
        for count in map(int, options.counts.split(",")):
            row = measure(options.program.resolve(), pathlib.Path(folder) / str(count), count, options)
            print("\t".join(f"{row[name]:.2f}" if isinstance(row[name], float) else str(row[name]) for name in COLUMNS),
                  flush=True)


if __name__ == "__main__":
    sys.exit(main())
