#!/usr/bin/env python3
"""Kills random workers of a world in PostgreSQL at random moments, while the database restarts.

    tools/work_kill_test.py PROGRAM [RADIUS [KILLS [WORKERS [GENERATOR]]]]      96, 60, 4, voronoi

At the end each chunk exists once, and the digest equals that of one process that generates in memory. Killed workers are
restarted at once. The database is stopped after a third of the kills, and killed after two thirds. The leases of a killed
worker end at once, as if their time had passed.
"""

import json
import random
import subprocess
import sys
import time

import child_processes
from scratch_postgres import ScratchPostgres
from wait_for import wait_for


def start_worker(program, url, radius, generator):
    return child_processes.start(
        [program, "work", url, "--radius", str(radius), "--threads", "1", "--backend", "cpu", "--generator", generator],
        stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def status(program, url):
    answer = subprocess.run([program, "work", url, "--status", "--json"], check=True, capture_output=True, text=True)
    return json.loads(answer.stdout)


def has_begun(server, worker):
    """Whether the worker is in the list of workers, or has ended: one that is still starting ends with an error if the
    database stops."""
    if worker.poll() is not None:
        return True
    if not server.query("SELECT to_regclass('terrane.workers')"):
        return False
    return server.query(f"SELECT count(*) FROM terrane.workers WHERE name LIKE '% process {worker.pid}'") == "1"


def disturb(program, server, workers, radius, generator, kills):
    """Kills random workers; returns the number of kills during work."""
    killed, choice = 0, random.Random(1)
    for n in range(kills):
        for worker in workers:
            wait_for(lambda: has_begun(server, worker), "the start of a worker")
        time.sleep(choice.random() / 2)  # a random moment of the work
        if n == kills // 3:
            server.stop()
            server.start()
        if n == 2 * kills // 3:
            server.kill()
            server.start()
        k = choice.randrange(len(workers))
        if workers[k].poll() is None:
            killed += 1
        elif workers[k].returncode != 0:
            raise SystemExit(f"a worker ended with {workers[k].returncode}")
        workers[k].kill()
        workers[k].wait()
        server.query("UPDATE terrane.jobs SET lease = clock_timestamp() FROM terrane.workers WHERE state = 0 AND "
                     f"worker = workers.number AND name LIKE '% process {workers[k].pid}'")
        workers[k] = start_worker(program, server.url(), radius, generator)
    return killed


def main():
    program = sys.argv[1]
    given = sys.argv[2:] + ["96", "60", "4", "voronoi"][len(sys.argv) - 2:]
    radius, kills, count = (int(v) for v in given[:3])
    generator = given[3]
    expected = (2 * radius + 1) ** 2
    with ScratchPostgres() as server:
        start = time.monotonic()
        workers = [start_worker(program, server.url(), radius, generator) for _ in range(count)]
        killed = disturb(program, server, workers, radius, generator, kills)
        for worker in workers:
            if worker.wait() != 0:
                raise SystemExit(f"a worker ended with {worker.returncode}")
        seconds = time.monotonic() - start
        work = status(program, server.url())
        rows = int(server.query("SELECT count(*) FROM terrane.chunks WHERE key < (1::bigint << 56)"))
        attempts = server.query("SELECT sum(attempts), count(*) FROM terrane.jobs")
        area = ["generate", "--radius", str(radius), "--digest", "--generator", generator]
        one = subprocess.run([program, *area], check=True, capture_output=True, text=True).stdout
        all_workers = subprocess.run([program, *area, "--world", server.url(), "--json"], check=True,
                                     capture_output=True, text=True).stdout
        checked = subprocess.run([program, "check", server.url()], capture_output=True, text=True)
    print(f"{killed} workers killed, {seconds:.0f} s, {rows} chunks, attempts and jobs {attempts}, digest {one.strip()}")
    problems = []
    if work["jobs"]["waiting"] + work["jobs"]["working"] != 0 or work["chunks_done"] != expected:
        problems.append(f"the queue says {work}")
    if rows != expected:
        problems.append(f"{rows} chunks, expected {expected}")
    made = json.loads(all_workers)
    if made["digest"] != one.strip() or made["chunks"] != 0:
        problems.append(f"digest of all: {made}")
    if checked.returncode != 0:
        problems.append(checked.stdout)
    if killed == 0:
        problems.append("no worker was killed while it worked")
    for problem in problems:
        print("failed:", problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
