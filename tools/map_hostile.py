#!/usr/bin/env python3
"""Measures the ticks and the memory of a game server while its map is under attack.

Bots walk and build. In turn there is no attack and all attacks: 1,000 clients that send one byte of a header per second,
or never read a large answer; clients that send giant headers, garbage, bodies and paths out of the folder, as fast as
they can. Prints a line for each phase: ticks, memory, opened connections, answers; at the end the delay until another
player gets an edit, over all phases. Exit code 1 if a limit is exceeded."""
import argparse
import json
import pathlib
import random
import re
import resource
import socket
import subprocess
import sys
import tempfile
import threading
import time

import child_processes
from server_tools import Server, bots_command
from web_clients import quantile, read_metrics

GIANT = b"GET / HTTP/1.1\r\nX: " + b"a" * (1 << 20)
ODD = (b"GET /../../etc/passwd HTTP/1.1\r\n\r\n", b"GET /%2e%2e/%2e%2e/etc/passwd HTTP/1.1\r\n\r\n",
       b"GET /tiles/day/0/99999999999/1.png HTTP/1.1\r\n\r\n", b"POST / HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n" + b"x" * 4096,
       b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" * 50, b"GET /" + b"%41" * 3000 + b" HTTP/1.1\r\n\r\n",
       b"GET / HTTP/1.1\r\n" + b"A: b\r\n" * 3000 + b"\r\n", b"\r\n" * 5000, b"GET / HTTP/9.9\r\n\r\n", b"\0" * 9000)


class Attack:
    """Threads that attack until stop()."""

    def __init__(self, port, slow, seed):
        self.port, self.is_over, self.opened, self.answers = port, threading.Event(), 0, {}
        self.random = random.Random(seed)
        self.threads = [threading.Thread(target=self.be_slow, args=(slow,)),
                        threading.Thread(target=self.send_giants), threading.Thread(target=self.send_odd)]
        for thread in self.threads:
            thread.start()

    def stop(self):
        self.is_over.set()
        for thread in self.threads:
            thread.join()

    def connect(self):
        self.opened += 1
        return socket.create_connection(("127.0.0.1", self.port), timeout=5)

    def be_slow(self, count):
        """Opens slow connections; reconnects those that the server closes."""
        clients = []
        while not self.is_over.wait(1):
            while len(clients) < count and not self.is_over.is_set():
                try:
                    client = self.connect()
                except OSError:
                    break
                if len(clients) % 4 == 0:  # requests a large answer, and never reads it
                    client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
                    client.sendall(b"GET /leaflet.js HTTP/1.1\r\nHost: localhost\r\n\r\n" * 50)
                clients.append(client)
            for client in list(clients):
                try:
                    client.sendall(b"G")
                except OSError:
                    clients.remove(client)
        for client in clients:
            client.close()

    def send_giants(self):
        while not self.is_over.wait(0.01):
            self.send(GIANT)

    def send_odd(self):
        while not self.is_over.wait(0.005):
            self.send(self.random.choice(ODD) if self.random.random() < 0.7 else self.random.randbytes(2000))

    def send(self, data):
        try:
            with self.connect() as client:
                client.settimeout(0.2)  # some wait for more
                client.sendall(data)
                status = client.recv(4096)[9:12].decode("latin-1")
        except OSError:
            status = "cut"
        self.answers[status] = self.answers.get(status, 0) + 1


def measure(server, web, seconds, attack):
    """Ticks in the server's statistics during the phase, and the peak of memory."""
    attacker = Attack(web, attack, 3) if attack else None
    before = len(server.statistics.read_text().splitlines())
    time.sleep(seconds)
    lines = [json.loads(line) for line in server.statistics.read_text().splitlines()[before + 1:]]
    if attacker:
        attacker.stop()
    return {"attacked": bool(attack), "tick_ms_median": quantile([line["tick_ms_median"] for line in lines], 0.5),
            "tick_ms_p99": max(line["tick_ms_p99"] for line in lines), "tick_ms_max": max(line["tick_ms_max"] for line in lines),
            "ticks_a_second": sum(line["ticks"] for line in lines) / (10 * len(lines)),
            "memory_mb": max(line["memory_mb"] for line in lines), "cpu": max(line["cpu_seconds"] for line in lines) / 10,
            "opened": attacker.opened if attacker else 0, "answers": attacker.answers if attacker else {}}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--bots", type=int, default=50)
    parser.add_argument("--slow", type=int, default=1000, help="slow clients")
    parser.add_argument("--seconds", type=float, default=45, help="of each time")
    parser.add_argument("--rounds", type=int, default=2)
    options = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(8192, resource.getrlimit(resource.RLIMIT_NOFILE)[1]),) * 2)
    with tempfile.TemporaryDirectory(prefix="terrane-hostile-") as name:
        folder = pathlib.Path(name)
        program = options.program.resolve()
        server = Server(program, folder, 0, "--http", "0")
        while not (found := re.search(r"http://[\d.]+:(\d+)/", server.output())):
            if server.process.poll() is not None:
                sys.exit(f"map_hostile: the server ended: {server.output()}")
            time.sleep(0.05)
        web = int(found[1])
        duration = options.seconds * 2 * options.rounds + 10
        bots = child_processes.start(
            bots_command(program, server.port, "--count", str(options.bots), "--seconds", str(duration)), stdout=subprocess.PIPE)
        time.sleep(5)
        rows = []
        for _ in range(options.rounds):
            for attack in (0, options.slow):
                rows.append(measure(server, web, options.seconds, attack))
                print(json.dumps(rows[-1]), flush=True)
        time.sleep(1)
        after = read_metrics(("127.0.0.1", web))
        seen = json.loads(bots.communicate()[0])
        code = server.stop()
    print(f"another player hears of an edit after {seen['seen_ms_median']:.0f} ms, {seen['seen_ms_p99']:.0f} ms at the 99th "
          f"percentile, over all of it; {seen['cuts']} bots were cut off", flush=True)
    growth = max(row["memory_mb"] for row in rows) - rows[0]["memory_mb"]
    print(f"memory grew by {growth:.0f} MB; {after['terrane_web_connections']:.0f} connections are left", flush=True)
    return 0 if code == 0 and growth < 150 and seen["cuts"] == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
