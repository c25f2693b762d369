#!/usr/bin/env python3
"""Two windows on one server: each player sees the blocks of the other. Usage: together_test.py PROGRAM

Needs what window_support.py needs. TERRANE_SCREENSHOTS names a folder for images of the windows."""
import os
import pathlib
import signal
import subprocess

import support
import window_support
from support import HANG_SECONDS, ProgramTest
from window_support import SIZE, is_green, is_grey


class Server(support.RunningProgram):
    """A server of a flat world on a free port."""

    def __init__(self, folder):
        self.world = folder / "world.sqlite"
        super().__init__(folder, "serve", "--world", self.world, "--generator", "flat", "--address", "127.0.0.1", "--port", "0")
        self.port = int(self.wait_for(r"on port (\d+)")[1])


def keep(display, game, name):
    if folder := os.environ.get("TERRANE_SCREENSHOTS"):
        dump = pathlib.Path(folder) / f"{name}.xwd"
        subprocess.run(["xwd", "-id", game.window, "-silent", "-display", display.name, "-out", dump],
                       timeout=HANG_SECONDS, check=True)


class Together(ProgramTest):
    def setUp(self):
        super().setUp()
        self.server = Server(self.folder)
        self.addCleanup(self.server.clean_up)

    def join(self, display, name, pose):
        """A player who goes to its only bookmark."""
        data = self.folder / name
        (data / "terrane").mkdir(parents=True)
        (data / "terrane" / "bookmarks.txt").write_text(pose + "\n")
        game = window_support.Game(display, data, (
            "--connect", f"127.0.0.1:{self.server.port}", "--name", name, "--movement", "noclip", "--view-distance", "3",
            "--samples", "1", "--horizon", "0", "--size", f"{SIZE[0]}x{SIZE[1]}"))
        self.addCleanup(game.log.close)
        self.addCleanup(game.process.kill)
        game.open()
        game.wait_for_image(SIZE)
        game.pause_after("F1")  # no help in the image
        game.press("F6")
        return game

    def history(self):
        return self.succeed("history", "--world", self.server.world)

    def stop(self):
        self.server.process.send_signal(signal.SIGTERM)
        self.assertEqual(self.server.process.wait(HANG_SECONDS), 0, self.server.output())

    def test_what_one_builds_the_other_sees(self):
        with window_support.Display() as first, window_support.Display() as second:
            ann = self.join(first, "Ann", "8.5 8.5 84 0 -89")
            bob = self.join(second, "Bob", "3.5 8.5 84 0 -26")  # looks at the same block
            ann.wait_for_ground(is_green)
            bob.wait_for_ground(is_green)
            ann.take_mouse()
            ann.press("2")  # cobble
            keep(second, bob, "before")
            first.xdotool("click", 3)
            ann.wait_for_ground(is_grey)
            bob.wait_for_ground(is_grey)
            keep(first, ann, "ann")
            keep(second, bob, "bob")
            self.stop()
            self.assertRegex(self.history(), r"Ann at 8 8 81: air to cobble")

    def test_the_console_and_a_clean_end(self):
        self.server.say("help")
        self.server.wait_for(r"rollback PLAYER")
        self.server.say("list")
        self.server.wait_for(r"0 of 100 players")
        self.server.say("x" * 10000 + " stop")
        self.server.wait_for(r"a line of more than 4096 bytes")
        self.server.say("op Nobody")
        self.server.wait_for(r"no player called Nobody has ever joined")
        bots = self.succeed("bots", "--connect", f"127.0.0.1:{self.server.port}", "--count", "5", "--seconds", "5",
                            "--behaviour", "build", "--edits-per-second", "5")
        self.assertIn('"joined": 5', bots)
        self.assertIn("air to stone", self.history())
        self.stop()
        self.succeed("check", self.server.world)


if __name__ == "__main__":
    window_support.main()
