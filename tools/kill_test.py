#!/usr/bin/env python3
"""Repeatedly kills a program that edits and saves, and checks the save.

    kill_test.py SAVE_LOOP PROGRAM [KILLS]     8 kills by default

SAVE_LOOP is the test program tests/store/save_loop, PROGRAM is terrane, or "-" to skip terrane check. After each
kill (SIGKILL, at a random moment) the file must pass SQLite's integrity check and terrane check, hold every save
that was reported as durable, and have exactly the tiles that follow from its chunks. Needs nothing but Python; exits
with 1 when something is lost or damaged."""
import pathlib
import random
import sqlite3
import subprocess
import sys
import tempfile
import time

LONGEST_SECONDS = 0.4  # lifetime after the first report


def run_and_kill(loop, save, first, generator):
    """Starts the loop and kills it after a while. Returns the last number reported as durable, or None."""
    process = subprocess.Popen([loop, save, str(first)], stdout=subprocess.PIPE, text=True)
    if generator.random() < 0.7:  # else the kill may hit opening or creating the file
        reported = process.stdout.readline()
        time.sleep(generator.random() * LONGEST_SECONDS)
    else:
        reported = ""
        time.sleep(generator.random() * 0.05)
    process.kill()
    lines = (reported + process.stdout.read()).split("\n")[:-1]  # without a truncated line
    process.wait()
    if process.returncode != -9:
        sys.exit(f"kill_test: {loop} ended by itself with {process.returncode}")
    return int(lines[-1]) if lines else None


def integrity(save):
    with sqlite3.connect(save) as database:
        answer = database.execute("PRAGMA integrity_check").fetchall()
    database.close()
    return answer


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    loop, program = sys.argv[1:3]
    kills = int(sys.argv[3]) if len(sys.argv) == 4 else 8
    generator = random.Random(1)
    durable = most_tiles = 0
    with tempfile.TemporaryDirectory(prefix="terrane_kill_") as folder:
        save = str(pathlib.Path(folder) / "a.sqlite")
        for number in range(1, kills + 1):
            reported = run_and_kill(loop, save, durable + 1, generator)
            durable = durable if reported is None else reported
            if durable == 0:
                continue  # there may be no file yet
            if number % 2:  # in turn the log is replayed by the other checks and by the loop
                answer = integrity(save)
                if answer != [("ok",)]:
                    sys.exit(f"kill_test: kill {number}: integrity_check says {answer}")
            checks = [[loop, save, "verify", str(durable)]]
            if program != "-":
                checks.append([program, "check", save])
            for check in checks:
                done = subprocess.run(check, capture_output=True, text=True, check=False)
                if done.returncode != 0:
                    sys.exit(f"kill_test: kill {number}: {' '.join(check)}: {done.stdout}{done.stderr}")
                if "verify" in check:
                    most_tiles = max(most_tiles, int(done.stdout.split()[2]))  # "100 chunks, 34 tiles"
    if durable == 0:
        sys.exit("kill_test: nothing was ever reported as durable: the test shows nothing")
    if most_tiles == 0:
        sys.exit("kill_test: no tile was ever found: the test shows nothing of them")
    print(f"kill_test: {kills} kills, {durable} durable saves, all there; up to {most_tiles} tiles, all right")


if __name__ == "__main__":
    main()
