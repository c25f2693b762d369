#!/usr/bin/env python3
"""Makes docs/images/together_*.jpg: two windows on one server, each showing the other player and its blocks.
Usage: together_images.py PROGRAM FOLDER

Needs xvfb, xdotool, x11-apps and ffmpeg (Debian), and the scripts of the tests."""
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.append(str(ROOT / "tests" / "app"))
import support  # noqa: E402
import window_support  # noqa: E402
from server_tools import Server  # noqa: E402

SIZE = (800, 450)
SEED = 1
POSES = {"Ann": "111.5 15.5 93.7 180 -22", "Bob": "101.5 16.5 93.7 -6 -8"}  # x y z yaw pitch, near the spawn
# Columns that Ann builds: slot of the hotbar, mouse motion from the last column, number of blocks.
COLUMNS = ((2, (-160, 0), 3), (2, (320, 0), 3), (1, (-60, 0), 1), (1, (-60, 0), 1))


class Player:
    def __init__(self, display, server, name, folder):
        data = folder / name / "terrane"
        data.mkdir(parents=True)
        (data / "bookmarks.txt").write_text(POSES[name] + "\n")
        self.display, self.name = display, name
        self.game = window_support.Game(display, folder / name, (
            "--connect", f"127.0.0.1:{server.port}", "--name", name, "--movement", "noclip", "--view-distance", "6", "--preset",
            "medium", "--size", f"{SIZE[0]}x{SIZE[1]}"))
        self.game.open()
        self.game.wait_for_image(SIZE)
        self.game.pause_after("F1")  # no help in the image
        self.game.press("F6")

    def build(self, columns):
        self.game.tap(1, SIZE[0] // 2, SIZE[1] // 2, self.game.pause)  # captures the mouse
        for slot, turn, height in columns:
            self.game.press(str(slot))
            self.display.xdotool("mousemove_relative", "--", *turn)
            time.sleep(1)
            for _ in range(height):
                self.display.xdotool("click", 3)
                time.sleep(1)

    def picture(self, folder, file):
        dump = folder / f"{self.name}.xwd"
        subprocess.run(["xwd", "-id", self.game.window, "-silent", "-display", self.display.name, "-out", dump], check=True)
        subprocess.run(["ffmpeg", "-loglevel", "error", "-y", "-i", dump, "-q:v", "3", file], check=True)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    program, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    support.set_program(program)
    screen = (SIZE[0] + 40, SIZE[1] + 40)
    with tempfile.TemporaryDirectory(prefix="terrane-together-") as name, \
            window_support.Display(screen) as first, window_support.Display(screen) as second:
        folder = pathlib.Path(name)
        server = Server(program, folder, 0, "--seed", str(SEED))
        ann, bob = Player(first, server, "Ann", folder), Player(second, server, "Bob", folder)
        time.sleep(30)  # until the terrain is loaded and shaders are compiled
        ann.build(COLUMNS)
        time.sleep(3)
        for player in (ann, bob):
            player.picture(folder, out / f"together_{player.name.lower()}.jpg")
            player.game.process.terminate()
            player.game.process.wait(60)
        server.stop()


if __name__ == "__main__":
    main()
