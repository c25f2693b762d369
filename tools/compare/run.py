#!/usr/bin/env python3
"""Measures other programs and Terrane on this machine, in turn, and makes one table.

    tools/compare/run.py -o FOLDER [--program build/terrane] [--rounds 5] [--only luanti,floors] [--quick] [--install]
                         [--prepare]

Writes FOLDER/results.jsonl, a line after each measurement, and FOLDER/report.md. A stopped run continues if it is
started again with the same folder; failed measurements are repeated. FOLDER/work has the worlds. Needs xvfb, and
minetest with minetest-server (Luanti), which --install gets from Debian. Exit code: 0, 1 if a measurement failed, 2 if
nothing could be measured."""
import argparse
import hashlib
import os
import pathlib
import signal
import subprocess
import sys
import time

import report
from jobs import FULL, QUICK, Comparison, clean
from machine import load_average, machine, versions
from process import CompareError
from results import BadInput, Results, append_line, read_results

# Packages of Debian 12 and of later releases.
PEERS = (("minetest", "minetest-server"), ("luanti", "luanti-server"))
OTHER_PACKAGES = ("xvfb", "xauth")
FAILURES = (CompareError, OSError, subprocess.SubprocessError, ValueError, LookupError, TypeError, RuntimeError, SystemExit)


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=pathlib.Path, metavar="FOLDER", required=True)
    parser.add_argument("--program", type=pathlib.Path, default=pathlib.Path("build/terrane"))
    parser.add_argument("--rounds", type=int, help="each measures all of both sides once (default: 5, quick 1)")
    parser.add_argument("--only", type=lambda text: text.split(","), metavar="NAME,…",
                        help="groups or jobs: luanti, floors, world, joining, frames_128, …")
    parser.add_argument("--quick", action="store_true",
                        help="one round of small sizes, to see that all works: its figures mean little")
    parser.add_argument("--prepare", action="store_true",
                        help="measure nothing: only choose the places and generate Luanti's land there, which may be done "
                        "while the machine is busy")
    parser.add_argument("--install", action="store_true", help="install Luanti and Xvfb first, with apt-get")
    options = parser.parse_args(arguments)
    options.rounds = options.rounds or (1 if options.quick else 5)
    return options


def install():
    exists = lambda name: subprocess.run(["apt-cache", "show", name], capture_output=True, check=False).returncode == 0
    peer = next((packages for packages in PEERS if all(map(exists, packages))), PEERS[0])
    command = ["apt-get", "install", "--yes", "--no-install-recommends", *peer, *OTHER_PACKAGES]
    subprocess.run(command if os.geteuid() == 0 else ["sudo", *command], check=True,
                   env={**os.environ, "DEBIAN_FRONTEND": "noninteractive"})


def about(options):
    digest = hashlib.sha256(options.program.read_bytes()).hexdigest()[:16]
    return {"machine": machine(), "versions": {**versions(options.program), "Terrane, digest of the program": digest},
            "settings": {"sizes": "quick" if options.quick else "full"}}


def chosen(jobs, only):
    jobs = list(jobs)
    known = {name for job in jobs for name in (job.name, job.group)}
    if unknown := set(only or ()) - known:
        raise CompareError(f"--only: no {', '.join(sorted(unknown))}; there are {', '.join(sorted(known))}")
    return [job for job in jobs if not only or {job.name, job.group} & set(only)]


def begin(path, options):
    """Returns earlier results. Raises CompareError if they are from another comparison."""
    now = about(options)
    before = read_results(path) if path.exists() else Results()
    if before.about:
        for part, values in now.items():
            if before.about.get(part) != values:
                raise CompareError(f"{path}: was measured with other {part}: choose another folder")
    else:
        append_line(path, {"about": now})
    return before


def measure(job, side, number):
    """Returns the line for results.jsonl."""
    line = {"round": number, "job": job.name, "side": side, "load": load_average()}
    start = time.monotonic()
    try:
        line["values"], line["details"] = job.side(side)(number)
    # A failing program loses only its own values. joining.py reports by SystemExit.
    except FAILURES as error:
        kind = "" if isinstance(error, (CompareError, SystemExit)) else f"{type(error).__name__}: "
        line["failure"] = " ".join(f"{kind}{error}".split())[:400]
    line["seconds"] = round(time.monotonic() - start, 1)
    return line


def run(options):
    """Returns whether all jobs succeeded."""
    work = options.output / "work"
    work.mkdir(parents=True, exist_ok=True)
    clean(work)
    comparison = Comparison(options.program.resolve(), work.resolve(), QUICK if options.quick else FULL)
    if options.prepare:
        comparison.prepare()
        return True
    jobs = chosen(comparison.jobs(), options.only)
    path, complete = options.output / "results.jsonl", True
    done = begin(path, options).done
    for number in range(1, options.rounds + 1):
        for job in jobs:
            for side in ("terrane", "peer") if number % 2 else ("peer", "terrane"):
                if (number, job.name, side) in done:
                    continue
                line = measure(job, side, number)
                append_line(path, line)
                complete = complete and "failure" not in line
                print(f"round {number}, {job.name}, {side}: {line.get('failure', 'done')} ({line['seconds']:.0f} s, load "
                      f"{line['load']:.1f})", file=sys.stderr, flush=True)
    return complete


def main(arguments=None):
    options = parse(arguments)
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # ends running programs, as Ctrl+C does
    try:
        if options.install:
            install()
        if not options.program.is_file():
            raise CompareError(f"{options.program}: no such program; build Terrane, or name it with --program")
        complete = run(options)
        if options.prepare:
            return 0
        report.write_report(options.output, options.output)
    except (CompareError, BadInput, OSError, subprocess.CalledProcessError) as error:
        print(f"compare: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print(f"compare: ended; start it again with -o {options.output} to go on", file=sys.stderr)
        return 130
    print(f"compare: {options.output / 'report.md'}", file=sys.stderr)
    return 0 if complete else 1


if __name__ == "__main__":
    sys.exit(main())
