#!/usr/bin/env python3
"""Plays randomly in a window on a virtual display: keys, mouse, wheel, clicks, the panel, options, resizing.

Usage: random_player.py PROGRAM [MINUTES] [--seed N] [--title] [--folder DIR]

Fails (exit code 1) when the program ends by itself or badly, reports a warning or an error (its own, a sanitizer's, or the
graphics driver's), does not end when Esc is pressed, or when its memory still grows toward the end.
Needs Xvfb and xdotool (Debian: xvfb, xdotool; exit code 77 without them). The same seed does the same things in the same
order; when each falls into a frame is chance."""
import argparse
import csv
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import virtual_display

SKIPPED = 77
HANG_SECONDS = 60  # under sanitizers a frame may take seconds
SCREEN = (640, 480)
SIZES = ((480, 300), (320, 180), (200, 400), (640, 480), (101, 77))
HELD = ("w", "a", "s", "d", "space", "Shift_L", "e", "q", "Up", "Left")
PRESSED = ("F1", "F2", "F3", "F4", "F5", "F6", "F11", "F12", "o", "p", "i", "m", "l", "m", "F2",
           "F7", "F8", "1", "2", "5", "9", "n", "h", "Escape", "Return", "ctrl+z", "ctrl+z", "ctrl+y",
           "b", "g", "x", "r", "f", "Delete", "ctrl+c", "ctrl+v", "ctrl+s", "ctrl+o")
TAKEN = ("water", "water", "sand", "torch", "door", "stairs", "sign", "chest", "fence", "lamp")  # from the palette
MENU = ("Return", "Return", "Down", "Right", "Escape", "t")
# Allowed growth of memory during a game: caches fill, textures and buffers double, and a view distance chosen in the
# panel adds chunks (0.4 MB each including data of a software renderer, more under sanitizers).
GROWTH = 1.5
MEGABYTES_A_CHUNK = 0.8
BAD = re.compile(r"warning|error|AddressSanitizer|LeakSanitizer|runtime error", re.IGNORECASE)


class Player:
    """The program, and random input to it."""

    def __init__(self, program, folder, options, display):
        seed = options.seed
        self.random, self.display, self.folder = random.Random(seed), display, folder
        variables = {**os.environ, "DISPLAY": display.name, "XDG_CONFIG_HOME": str(folder), "XDG_DATA_HOME": str(folder),
                     # Drivers keep memory until the process ends; leaks of the program show as growth.
                     "ASAN_OPTIONS": "detect_leaks=0:abort_on_error=1", "UBSAN_OPTIONS": "print_stacktrace=1"}
        self.log = open(folder / "log.txt", "w+", encoding="utf-8")
        self.pressed = PRESSED + (MENU if options.title else ())
        world = [] if options.title else ["--world", "random", "--collect-perf-data", "perf.csv"]
        self.command = [program, "play", "--debug-gl", "--view-distance", "4", "--samples", "1", "--size", "480x300", *world]
        self.variables = variables
        self.start()
        self.most = 0  # bytes in memory
        self.down = set()
        self.actions = self.quits = 0

    def start(self):
        self.process = subprocess.Popen(self.command, cwd=self.folder, env=self.variables, stdout=self.log, stderr=self.log)

    def open(self):
        deadline = time.monotonic() + 2 * HANG_SECONDS
        while time.monotonic() < deadline and self.process.poll() is None:
            self.window = self.display.xdotool("search", "--onlyvisible", "--name", "^Terrane$")
            if self.window:
                self.display.xdotool("windowmove", self.window, 0, 0, "windowfocus", self.window)
                return
            time.sleep(0.2)
        raise RuntimeError("no window")

    def resident(self):
        pages = pathlib.Path(f"/proc/{self.process.pid}/statm").read_text(encoding="ascii").split()[1]
        return int(pages) * os.sysconf("SC_PAGESIZE")

    def act(self):
        """One random action, weighted as in real games."""
        choice, xdotool = self.random.random(), self.display.xdotool
        if choice < 0.30:
            key = self.random.choice(HELD)
            xdotool("keyup" if key in self.down else "keydown", key)
            self.down ^= {key}
        elif choice < 0.50:
            xdotool("key", self.random.choice(self.pressed))
        elif choice < 0.70:
            xdotool("mousemove", self.random.randrange(SCREEN[0]), self.random.randrange(SCREEN[1]))
        elif choice < 0.78:
            xdotool("mousemove_relative", "--", self.random.randint(-200, 200), self.random.randint(-100, 100))
        elif choice < 0.81:
            xdotool("key", "Tab", "type", "--delay", "60", self.random.choice(TAKEN))
            xdotool("key", self.random.choice(("Return", "Return", "Escape")))
        elif choice < 0.92:
            button = self.random.choice((1, 1, 1, 2, 3, 3, 3, 4, 5))
            xdotool("mousedown", button)
            time.sleep(self.random.choice((0, 0.05, 0.5)))
            xdotool("mouseup", button)
        elif choice < 0.96:  # typed into a slider or a field
            xdotool("keydown", "Control_L", "click", 1, "keyup", "Control_L")
            xdotool("key", *self.random.choices("0123456789.-emw", k=3), self.random.choice(("Return", "BackSpace", "Tab")))
        elif choice < 0.98:
            xdotool("windowsize", self.window, *self.random.choice(SIZES))
        else:
            xdotool("windowfocus", self.window)
        self.actions += 1

    def play(self, seconds):
        end, next_look = time.monotonic() + seconds, 0
        while time.monotonic() < end:
            if self.process.poll() == 0:  # "Quit" was chosen
                self.quits += 1
                self.start()
                self.open()
            if self.process.poll() is not None:
                raise RuntimeError(f"the program ended by itself with {self.process.returncode}")
            self.act()
            time.sleep(self.random.choice((0.02, 0.1, 0.3)))
            if time.monotonic() > next_look:
                self.most = max(self.most, self.resident())
                next_look = time.monotonic() + 1

    def close(self):
        """Quits by the menu, or from the title. Esc may first end text input or close a chest."""
        for key in self.down:
            self.display.xdotool("keyup", key)
        deadline = time.monotonic() + 2 * HANG_SECONDS
        while self.process.poll() is None:
            if time.monotonic() > deadline:
                self.process.send_signal(signal.SIGABRT)
                raise RuntimeError("the program does not answer")
            self.display.xdotool("windowfocus", self.window, "keydown", "Escape")
            time.sleep(1)
            self.display.xdotool("keyup", "Escape", "key", "q")  # quits if the menu is open now
            time.sleep(1)
        return self.process.returncode

    def complaints(self):
        self.log.flush()
        lines = (self.folder / "log.txt").read_text(encoding="utf-8", errors="replace").splitlines()
        return [line for line in lines if BAD.search(line)]


def growth(statistics):
    """Describes growth of memory, from the program's statistics of each frame; None if there is none.

    Compares the maximum in the last quarter of the time with the maximum in the second one."""
    rows = list(csv.DictReader(statistics.read_text(encoding="ascii").splitlines()))
    if not rows:
        return "no statistics were written"
    end = float(rows[-1]["time_s"])
    def most(column, quarter):
        return max((float(row[column]) for row in rows if quarter <= 4 * float(row["time_s"]) / end <= quarter + 1), default=0)
    before, after = most("ram_mb", 1), most("ram_mb", 3)
    chunks = most("active_chunks", 3) - most("active_chunks", 1)
    allowed = GROWTH * before + MEGABYTES_A_CHUNK * max(chunks, 0)
    return f"memory grows from {before:.0f} to {after:.0f} MB with {chunks:.0f} chunks more" if after > allowed else None


def faults_of(player, minutes):
    try:
        player.open()
        player.play(60 * minutes)
        code = player.close()
        return [f"exit code {code}"] if code != 0 else []
    except (RuntimeError, subprocess.TimeoutExpired, OSError) as error:
        return [str(error)]
    finally:
        if player.process.poll() is None:
            player.process.kill()
            player.process.wait()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("minutes", type=float, nargs="?", default=1)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--title", action="store_true", help="begin at the title; the memory is not judged")
    parser.add_argument("--folder", type=pathlib.Path, help="keep the log, the save and the statistics here")
    options = parser.parse_args()
    if not shutil.which("Xvfb") or not shutil.which("xdotool"):
        print("skipped: Xvfb or xdotool is not installed (Debian: xvfb, xdotool)")
        sys.exit(SKIPPED)
    folder = options.folder or pathlib.Path(tempfile.mkdtemp(prefix="terrane_player_"))
    folder.mkdir(parents=True, exist_ok=True)
    with virtual_display.Display(SCREEN) as display:
        player = Player(options.program.resolve(), folder, options, display)
        faults = faults_of(player, options.minutes)
    faults += player.complaints()
    if not faults and not options.title and (grown := growth(folder / "perf.csv")):
        faults.append(grown)
    print(f"{player.actions} actions in {options.minutes:g} minutes, {player.quits} times quit, at most {player.most / 1e6:.0f} MB, seed {options.seed}")
    for fault in faults:
        print("fault:", fault)
    if not options.folder and not faults:
        shutil.rmtree(folder)
    elif faults:
        print("kept:", folder)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
