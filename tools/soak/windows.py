"""A window on a virtual display with a game on a server, and a player who acts randomly."""
import contextlib
import os
import pathlib
import random
import subprocess
import threading
import time

import child_processes
from virtual_display import Display

SIZE = (320, 180)
HELD = ("w", "w", "w", "a", "s", "d", "space")
# Software rendering must not take CPU time from the servers.
NICE = 19


def yield_to_others(process):
    """Linux divides the CPU among sessions first; nice then counts only within one."""
    with contextlib.suppress(OSError):
        pathlib.Path(f"/proc/{process.pid}/autogroup").write_text(str(NICE), encoding="ascii")


class Window:
    def __init__(self, program, folder, name, port, seed):
        folder.mkdir(exist_ok=True)
        self.name, self.seed, self.edits_file = name, seed, folder / "known_edits.txt"
        self.display = Display((SIZE[0] + 40, SIZE[1] + 40)).__enter__()
        self.log = open(folder / "log.txt", "a+")
        environment = os.environ | {"DISPLAY": self.display.name, "XDG_DATA_HOME": str(folder), "LIBGL_ALWAYS_SOFTWARE": "1"}
        self.process = child_processes.start(
            ["nice", "-n", str(NICE), program, "play", "--connect", f"127.0.0.1:{port}", "--name", name, "--preset", "low",
             "--shadows", "off", "--view-distance", "6", "--horizon", "128", "--settings", "", "--size",
             f"{SIZE[0]}x{SIZE[1]}", "--known-edits", self.edits_file],
            stdin=subprocess.DEVNULL, stdout=self.log, stderr=self.log, env=environment, start_new_session=True)
        yield_to_others(self.process)
        self.is_resting = threading.Event()
        self.player = threading.Thread(target=self.play, args=(random.Random(seed),), daemon=True)
        self.player.start()

    def take_window(self):
        while self.process.poll() is None and not self.is_resting.is_set():
            if window := self.display.xdotool("search", "--onlyvisible", "--name", "^Terrane$"):
                # There is no window manager that places the window and gives it the focus.
                self.display.xdotool("windowmove", window, 0, 0, "windowfocus", window)
                break
            time.sleep(1)
        self.is_resting.wait(20)
        self.display.xdotool("mousemove", SIZE[0] // 2, SIZE[1] // 2, "click", 1)  # takes the mouse

    def play(self, chance):
        self.take_window()
        while not self.is_resting.is_set() and self.process.poll() is None:
            self.act(chance)
            self.is_resting.wait(chance.uniform(0.2, 1.5))

    def act(self, chance):
        roll = chance.random()
        if roll < 0.35:
            key = chance.choice(HELD)
            self.display.xdotool("keydown", key, "sleep", round(chance.uniform(0.3, 2), 2), "keyup", key)
        elif roll < 0.6:
            self.display.xdotool("mousemove_relative", "--", chance.randint(-150, 150), chance.randint(-40, 45))
        elif roll < 0.75:
            self.display.xdotool("key", chance.choice("123456789"))
        else:
            self.display.xdotool("click", chance.choice((1, 3, 3)))

    def rest(self):
        self.is_resting.set()
        self.player.join(60)

    def kill(self):
        self.process.kill()
        self.process.wait()
        self.rest()
        self.display.__exit__()

    def close(self):
        """Quits as a player does; returns problems."""
        self.process.terminate()
        code = self.process.wait(120)
        self.display.__exit__()
        return [] if code == 0 else [f"ended with {code}"]

    def known(self):
        """The last chunk of the player, and position to block of all edits around it."""
        lines = self.edits_file.read_text().splitlines()
        center = tuple(int(v) for v in lines[0].split()[1:])
        return center, {tuple(int(v) for v in line.split()[:3]): line.split()[3] for line in lines[1:]}
