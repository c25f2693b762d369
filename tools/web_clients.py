"""Clients of a map's web server, for measurements: many connections on one thread, each sends the next request after its
answer. A request is a path; answers have a Content-Length."""
import selectors
import socket
import time
import urllib.request


class Client:
    """One connection."""

    def __init__(self, address):
        self.address = address
        self.socket = None
        self.open()

    def open(self):
        self.socket = socket.create_connection(self.address, timeout=30)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.received, self.expected, self.status = bytearray(), None, 0

    def ask(self, path):
        self.received, self.expected = bytearray(), None
        self.begun = time.perf_counter()
        self.socket.sendall(f"GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())

    def take(self):
        """Reads available data. Returns the seconds since ask() once the answer is complete, None before. Raises
        ConnectionError if the server closed the connection."""
        data = self.socket.recv(1 << 18)
        if not data:
            raise ConnectionError("closed")
        self.received += data
        if self.expected is None:
            end = self.received.find(b"\r\n\r\n")
            if end < 0:
                return None
            head = bytes(self.received[:end]).decode("latin-1").lower()
            self.status = int(head.split(" ", 2)[1])
            length = next((int(line.split(":")[1]) for line in head.split("\r\n") if line.startswith("content-length:")), 0)
            self.expected = end + 4 + length
        return time.perf_counter() - self.begun if len(self.received) >= self.expected else None


def ask_all(address, paths, clients):
    """Requests each path once, on the given number of connections. Returns (seconds, status, bytes) of each answer."""
    answers, waiting = [], iter(paths)
    selector = selectors.DefaultSelector()
    busy = 0
    for _ in range(clients):
        client = Client(address)
        if (path := next(waiting, None)) is None:
            break
        client.ask(path)
        selector.register(client.socket, selectors.EVENT_READ, client)
        busy += 1
    while busy:
        for key, _ in selector.select():
            client = key.data
            if (seconds := client.take()) is None:
                continue
            answers.append((seconds, client.status, client.expected))
            if (path := next(waiting, None)) is not None:
                client.ask(path)
                continue
            selector.unregister(client.socket)
            client.socket.close()
            busy -= 1
    return answers


def quantile(values, share):
    values = sorted(values)
    return values[min(int(share * len(values)), len(values) - 1)]


def read_metrics(address):
    """The values of /metrics by name."""
    with urllib.request.urlopen(f"http://{address[0]}:{address[1]}/metrics", timeout=30) as answer:
        lines = answer.read().decode().splitlines()
    return {name: float(value) for name, value in (line.rsplit(" ", 1) for line in lines if not line.startswith("#"))}
