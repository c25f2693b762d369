#!/usr/bin/env python3
"""Compares a world in PostgreSQL with one in a file, in turn on one machine; prints JSON.

    tools/postgres_figures.py PROGRAM [ROUNDS]      3

- workers: chunks per second of one worker and of two, one thread each;
- cpu: CPU seconds to generate and write an area into a file, and into PostgreSQL including the server's;
- loading: the view within 16 chunks (`terrane render`) from both: time until all is lit and meshed, and its part for
  reading and decoding chunks;
- bytes per chunk.
The database commits to disk (fsync).
"""
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

from scratch_postgres import ScratchPostgres

RADIUS = 64
AREA, AREA_CHUNKS = "-128,-128,128,128", 256 * 256  # of workers: 64 whole squares


def processor_seconds_of(pids):
    """CPU seconds of processes and of their ended children."""
    ticks = 0
    for pid in pids:
        fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
        ticks += sum(int(v) for v in fields[11:15])
    return ticks / os.sysconf("SC_CLK_TCK")


def server_pids(postgres):
    main = int((pathlib.Path(postgres.folder) / "data/postmaster.pid").read_text().split()[0])
    children = subprocess.run(["pgrep", "-P", str(main)], capture_output=True, text=True, check=True).stdout.split()
    return [main, *map(int, children)]


def run(*command):
    """Returns the standard output and the CPU seconds."""
    before = os.times()
    done = subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True)
    after = os.times()
    return done.stdout, after.children_user + after.children_system - before.children_user - before.children_system


def workers(program, postgres, schema, count):
    """Chunks per second of several workers together, from the start of the first to the end of the last."""
    url = postgres.url(schema)
    run(program, "work", url, "--area", AREA, "--add-only")
    start = time.monotonic()
    processes = [subprocess.Popen([program, "work", url, "--threads", "1", "--backend", "cpu"], stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL) for _ in range(count)]
    for process in processes:
        assert process.wait() == 0
    return AREA_CHUNKS / (time.monotonic() - start)


def cpu(program, postgres, folder, n):
    area = ("generate", "--radius", RADIUS, "--threads", "1", "--backend", "cpu", "--world")
    _, of_file = run(program, *area, folder / f"cpu{n}.sqlite")
    postgres.query("CHECKPOINT")
    before = processor_seconds_of(server_pids(postgres))
    _, of_client = run(program, *area, postgres.url(f"cpu{n}"))
    time.sleep(0.2)  # its connections end
    return of_file, of_client + processor_seconds_of(server_pids(postgres)) - before


def loading(program, world, image):
    out, _ = run(program, "render", "--world", world, "--at", "8,8,120", "--view-distance", "16", "--horizon", "0", "--size", "64x36",
                 "--samples", "1", "--json", "-o", image)
    report = json.loads(out)
    return report["milliseconds"]["load"], report["tasks"]["load"]["milliseconds"], report["tasks"]["load"]["count"]


def main():
    program = sys.argv[1]
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 3
    figures = {name: [] for name in ("one", "two", "cpu_file", "cpu_database", "load_file", "load_database", "read_file",
                                     "read_database")}
    with tempfile.TemporaryDirectory() as folder, ScratchPostgres(durable=True) as postgres:
        folder = pathlib.Path(folder)
        for n in range(rounds):
            figures["one"].append(workers(program, postgres, f"one{n}", 1))
            figures["two"].append(workers(program, postgres, f"two{n}", 2))
            of_file, of_database = cpu(program, postgres, folder, n)
            figures["cpu_file"].append(of_file)
            figures["cpu_database"].append(of_database)
        for n in range(3 * rounds):
            for name, world in (("file", folder / "cpu0.sqlite"), ("database", postgres.url("cpu0"))):
                load, read, count = loading(program, world, folder / "image.png")
                figures[f"load_{name}"].append(load)
                figures[f"read_{name}"].append(read)
        chunk_bytes = int(postgres.query("SELECT pg_total_relation_size('cpu0.chunks')")) / (2 * RADIUS + 1) ** 2
    median = {name: statistics.median(values) for name, values in figures.items()}
    median |= {"two_to_one": median["two"] / median["one"], "cpu": median["cpu_database"] / median["cpu_file"],
               "load": median["load_database"] / median["load_file"], "read": median["read_database"] / median["read_file"],
               "chunks_loaded": count, "bytes_a_chunk": chunk_bytes}
    print(json.dumps({name: round(value, 3) for name, value in median.items()}, indent=1))


if __name__ == "__main__":
    main()
