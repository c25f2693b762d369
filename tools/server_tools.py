"""A server of the program, and bots on it, for measurements and tests of many players."""
import os
import re
import signal
import subprocess
import time

import child_processes


class Server:
    """A server on a free port. `folder` keeps its world, log and statistics; `url`: the world is in a database."""

    def __init__(self, program, folder, port=0, *arguments, url=None):
        self.world, self.statistics = folder / "world.sqlite", folder / "statistics.jsonl"
        self.log = open(folder / "log.txt", "a+", encoding="utf-8")
        self.begin = self.log.seek(0, os.SEEK_END)
        self.process = child_processes.start(
            [program, "serve", "--world", url or self.world, "--address", "127.0.0.1", "--port", str(port), "--max-players",
             "4096", "--statistics", self.statistics, *arguments],
            stdin=subprocess.DEVNULL, stdout=self.log, stderr=self.log,
            # For its key, if the world is not a file.
            env={**os.environ, "XDG_DATA_HOME": str(folder)})
        self.port = self.wait_for_port()

    def wait_for_port(self):
        while self.process.poll() is None:
            if found := re.search(r"on port (\d+)", self.output()):
                return int(found[1])
            time.sleep(0.02)
        raise RuntimeError(f"the server ended: {self.output()}")

    def output(self):
        """The log since the start."""
        self.log.seek(self.begin)
        return self.log.read()

    def stop(self, how=signal.SIGTERM):
        self.process.send_signal(how)
        code = self.process.wait(60)
        self.log.close()
        return code


def bots_command(program, port, *arguments):
    return [program, "bots", "--connect", f"127.0.0.1:{port}", *arguments]
