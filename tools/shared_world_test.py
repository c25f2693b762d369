#!/usr/bin/env python3
"""Several servers of one world in PostgreSQL, with bots spread over them; one server is killed.

    tools/shared_world_test.py PROGRAM [BOTS [SECONDS [SERVERS [BUILDERS]]]]      300, 60, 3, 0.1

Before the kill, edits are timed from one server's bot to another server's (seen_ms_p99); after it the bots of the killed
server must be on the others within 5 s. At the end all is stopped; then each acknowledged block must be in the world
(removed ones: water or sand may be there), the history must have no gap and match the chunks, and far tiles must match the chunks.
"""
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

import child_processes
from acknowledged_blocks import lost_blocks, read_kept
from scratch_postgres import ScratchPostgres
from server_tools import Server
from wait_for import wait_for

GENERATOR = "overworld"


def start_bots(program, servers, count, seconds, builders, name, folder):
    places = [word for server in servers for word in ("--connect", f"127.0.0.1:{server.port}")]
    return child_processes.start(
        [program, "bots", *places, "--count", str(count), "--seconds", str(seconds), "--builders", str(builders), "--name",
         name, "--acknowledged", str(folder / f"{name}.txt")], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)


def online(postgres):
    return int(postgres.query("SELECT count(*) FROM terrane.online"))


def wait_until_acquainted(postgres, server_count):
    """Until all servers know each other: each has read the list of servers since the last one started."""
    now = postgres.query("SELECT clock_timestamp()")
    wait_for(lambda: postgres.query(f"SELECT count(*) FROM terrane.servers WHERE seen > '{now}'") == str(server_count),
             "the heartbeat of all servers")


def seconds_until_back(postgres, count, gone):
    """Seconds from now until all players are on the remaining servers."""
    return wait_for(
        lambda: int(postgres.query(f"SELECT count(*) FROM terrane.online WHERE server <> {gone}")) >= count,
        "the return of all bots")


def tiles_digest(postgres):
    return postgres.query("SELECT count(*), md5(string_agg(key || ' ' || encode(data, 'hex'), ',' ORDER BY key)) "
                          "FROM terrane.chunks WHERE key >= 1::bigint << 56")


def derive_tiles_again(program, postgres, folder):
    """Derives all tiles again from the chunks, by a server that finds no mark of existing tiles."""
    postgres.query("DELETE FROM terrane.settings WHERE name = 'tiles'")
    (folder / "again").mkdir()
    return Server(program, folder / "again", 0, url=postgres.url()).stop()


def main():
    program = sys.argv[1]
    given = sys.argv[2:] + ["300", "60", "3", "0.1"][len(sys.argv) - 2:]
    count, seconds, server_count = (int(v) for v in given[:3])
    builders = float(given[3])
    problems = []
    with tempfile.TemporaryDirectory() as folder, ScratchPostgres(durable=True) as postgres:
        folder = pathlib.Path(folder)
        servers = []
        for n in range(server_count):
            (folder / str(n)).mkdir()
            servers.append(Server(program, folder / str(n), 0, "--generator", GENERATOR,
                                  "--spawn-radius", "100", url=postgres.url()))
        wait_until_acquainted(postgres, server_count)
        quiet = start_bots(program, servers, count, seconds / 2, builders, "quiet", folder)
        before = json.loads(quiet.communicate()[0])
        bots = start_bots(program, servers, count, 1000000, builders, "bot", folder)
        wait_for(lambda: online(postgres) >= count, "the coming of all bots")
        time.sleep(seconds / 6)
        gone = postgres.query(
            f"SELECT number FROM terrane.servers WHERE address = '127.0.0.1:{servers[-1].port}'")
        servers.pop().stop(signal.SIGKILL)
        back = seconds_until_back(postgres, count, gone)
        time.sleep(seconds / 6)
        bots.send_signal(signal.SIGINT)
        after = json.loads(bots.communicate()[0])
        # The other servers save the pending edits of the killed one.
        wait_for(lambda: postgres.query("SELECT count(*) FROM terrane.servers") == str(len(servers)),
                 "the end of the killed server's work", 0.2)
        for server in servers:
            if server.stop() != 0:
                problems.append("a server ended badly")
        left = postgres.query("SELECT newest, saved, (SELECT count(*) FROM terrane.edits), "
                              "(SELECT count(*) FROM terrane.servers) FROM terrane.history").split("|")
        kept = read_kept(folder / "quiet.txt", folder / "bot.txt")
        lost = lost_blocks(program, postgres.url(), kept, folder)
        checked = subprocess.run([program, "check", postgres.url()], capture_output=True, text=True)
        tiles = tiles_digest(postgres)
        if derive_tiles_again(program, postgres, folder) != 0 or tiles_digest(postgres) != tiles:
            problems.append("tiles do not follow from the chunks")
    print(f"{count} bots on {server_count} servers, {before['edits'] + after['edits']} edits, seen by others after "
          f"{before['seen_ms_median']:.0f} ms, 99 %: {before['seen_ms_p99']:.0f} ms (decided {before['decided_ms_p99']:.0f}); "
          f"after a kill all were back within {back:.1f} s, {after['cuts']} cuts; {len(kept)} blocks kept, {len(lost)} lost; "
          f"history {left[0]}, saved {left[1]}, rows {left[2]}, tiles {tiles.split('|')[0]}")
    # Times are checked only with many bots: a short test on a busy machine is too noisy.
    is_measured = count >= 100
    if is_measured and back > 5:
        problems.append("not all bots were back in time")
    if lost:
        problems.append(f"lost: {lost[:10]}")
    if len(kept) < 10:
        problems.append("hardly any edits")
    if is_measured and before["seen_ms_p99"] > 250:
        problems.append("edits crossed servers in more than 250 ms")
    if left[0] != left[1] or left[0] != left[2] or left[3] != "0":
        problems.append(f"newest, saved, rows of the history, servers: {left}")
    if checked.returncode != 0:
        problems.append(checked.stdout)
    for problem in problems:
        print("failed:", problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
