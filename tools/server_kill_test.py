#!/usr/bin/env python3
"""Repeatedly kills a server under load, and checks the world.

    server_kill_test.py PROGRAM [KILLS [BOTS]]     4 kills of a server with 20 bots by default

Bots build all the time. After each kill (SIGKILL, at a random moment, sometimes while bots reconnect) the server is
restarted, and all bots must reconnect by themselves. At the end every block that the server acknowledged must be in the
world. Needs nothing but Python; exit code 1 if a block is lost or a bot does not return."""
import json
import pathlib
import random
import re
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time

import child_processes
from acknowledged_blocks import lost_blocks, read_kept
from server_tools import Server, bots_command
from wait_for import wait_for


def joined(server):
    return set(re.findall(r"(\S+) joined from", server.output()))


def wait_for_all(server, bots, count):
    """Seconds until all bots have joined."""
    def are_here():
        if bots.poll() is not None:
            sys.exit("server_kill_test: the bots ended by themselves")
        return len(joined(server)) >= count
    return wait_for(are_here, "the return of all bots")


def count_edits(server):
    """The number of edits in the server's history."""
    with sqlite3.connect(f"file:{server.world.with_suffix('.server.sqlite')}?mode=ro", uri=True) as database:
        count = database.execute("SELECT count(*) FROM edits").fetchone()[0]
    database.close()
    return count


def check_blocks(program, world, acknowledged, folder):
    """Returns the number of checked blocks."""
    kept = read_kept(acknowledged)
    if not kept:
        sys.exit("server_kill_test: no block was built: the test shows nothing")
    lost = lost_blocks(program, world, kept, folder)
    if lost:
        sys.exit(f"server_kill_test: {len(lost)} of {len(kept)} blocks are lost, such as {lost[0]}")
    return len(kept)


def main():
    if len(sys.argv) not in (2, 3, 4):
        sys.exit(__doc__)
    program = pathlib.Path(sys.argv[1]).resolve()
    kills = int(sys.argv[2]) if len(sys.argv) > 2 else 4
    count = int(sys.argv[3]) if len(sys.argv) > 3 else 20
    generator = random.Random(1)
    with tempfile.TemporaryDirectory(prefix="terrane_server_kill_") as name:
        folder = pathlib.Path(name)
        server = Server(program, folder, 0, "--spawn-radius", "60")
        port, acknowledged, report = server.port, folder / "acknowledged.txt", folder / "bots.json"
        with open(report, "w", encoding="utf-8") as out:
            bots = child_processes.start(bots_command(
                program, port, "--count", str(count), "--seconds", "100000", "--behaviour", "build", "--edits-per-second",
                "2", "--keys", folder, "--acknowledged", acknowledged), stdout=out, stderr=subprocess.DEVNULL)
        wait_for_all(server, bots, count)
        back = []
        for _ in range(kills):
            time.sleep(generator.random())  # a random moment of play
            server.stop(signal.SIGKILL)
            server = Server(program, folder, port)
            if generator.random() < 0.7:
                back.append(wait_for_all(server, bots, count))
        back.append(wait_for_all(server, bots, count))
        # Bots that go on building have read that they joined.
        edits = count_edits(server)
        wait_for(lambda: count_edits(server) >= edits + 2 * count, "building", 0.2)
        bots.send_signal(signal.SIGINT)
        if bots.wait() != 0:
            sys.exit(f"server_kill_test: the bots end with {bots.returncode}")
        if server.stop() != 0:
            sys.exit("server_kill_test: the server does not end well")
        told = json.loads(report.read_text())
        if told["joined"] != count:
            sys.exit(f"server_kill_test: {told['joined']} of {count} bots are there in the end")
        subprocess.run([program, "check", folder / "world.sqlite"], check=True, stdout=subprocess.DEVNULL)
        blocks = check_blocks(program, folder / "world.sqlite", acknowledged, folder)
    back.sort()
    print(f"server_kill_test: {kills} kills, {count} bots, {told['cuts']} cuts, {told['edits']} edits, {blocks} blocks, all "
          f"there; all bots back within {back[len(back) // 2]:.1f} s (median), {back[-1]:.1f} s (longest)")


if __name__ == "__main__":
    main()
