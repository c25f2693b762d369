"""Runs bots on all servers in rounds, and collects acknowledged blocks. Each round has new players, who start at the spawn:
returning ones would start where they left, move ever farther away, and load ever more terrain."""
import json
import subprocess

import child_processes


def is_kept(changes, block):
    """Whether the block that a bot was told is kept is the last one, or was replaced after a window's player had changed it:
    what she puts there (half of a door) may go with what a bot changes beside it."""
    by_bots = [player.startswith("bot") for _, player in changes]
    newest = next((k for k, (after, _) in enumerate(changes) if by_bots[k] and after == block), None)
    return newest is not None and (newest == 0 or not all(by_bots[:newest]))


class Bots:
    def __init__(self, program, folder, count, round_seconds):
        self.program, self.folder, self.count, self.round_seconds = program, folder / "bots", count, round_seconds
        self.folder.mkdir()
        self.process, self.rounds, self.edits = None, 0, 0
        self.kept = {}  # position to block
        self.problems = []

    def keep_running(self, servers, seconds_left):
        """Starts a round if none runs and there is time for one."""
        if self.process and self.process.poll() is not None:
            self.end_round()
        if self.process or seconds_left < 60:
            return
        places = [word for server in servers for word in ("--connect", f"127.0.0.1:{server.port}")]
        self.rounds += 1
        self.log_begin = (self.folder / "log.txt").stat().st_size if self.rounds > 1 else 0
        self.output = open(self.folder / f"{self.rounds}.json", "w+")
        self.log = open(self.folder / "log.txt", "a")
        seconds = min(self.round_seconds, seconds_left - 30)
        self.process = child_processes.start(
            [self.program, "bots", *places, "--count", str(self.count), "--seconds", str(seconds), "--builders", "0.2",
             "--edits-per-second", "0.3", "--joins-per-second", "5", "--name", f"bot{self.rounds}.",
             "--acknowledged", self.kept_file()],
            stdin=subprocess.DEVNULL, stdout=self.output, stderr=self.log)

    def kept_file(self):
        return self.folder / f"{self.rounds}.txt"

    def are_joining(self):
        """Whether bots are still joining: an interrupted login is not retried."""
        if not self.process:
            return False
        with open(self.folder / "log.txt", encoding="utf-8") as log:
            log.seek(self.log_begin)
            return "bots play" not in log.read()

    def end_round(self):
        code = self.process.wait()
        self.process = None
        if code != 0:
            self.problems.append(f"bots ended with {code}")
            return
        self.output.seek(0)
        self.edits += json.load(self.output)["edits"]
        for line in self.kept_file().read_text().splitlines():
            x, y, z, name = line.split()
            self.kept[int(x), int(y), int(z)] = name
        self.kept = {pos: name for pos, name in self.kept.items() if name != "?"}  # undecided blocks

    def finish(self):
        """Waits for the last round; returns the problems of all rounds."""
        if self.process:
            self.end_round()
        return self.problems
