#!/usr/bin/env python3
"""Builds with the selection tool and writes on a sign, in the program's window on a virtual display. Usage: building_test.py PROGRAM

Needs Xvfb (without it the test is skipped, exit code 77), xdotool and xwd; Debian's packages are xvfb, xdotool and
x11-apps."""
import contextlib
import os
import pathlib
import sqlite3
import struct
import time
import zlib

import window_support
from support import Npy, ProgramTest

SIZE = (480, 300)
MIDDLE = (SIZE[0] // 2, SIZE[1] // 2)
FILL_BUTTON = (SIZE[0] - 220, 81)  # in the panel of the selection tool


def is_dark(red, green, blue):
    return max(red, green, blue) < 60


class BuildingScript(ProgramTest):
    """Actions for building."""

    def play(self, display, places, hand, start):
        """Places are bookmarks: F6 goes from one to the next, starting with the first."""
        (self.folder / "terrane").mkdir(exist_ok=True)
        (self.folder / "terrane" / "bookmarks.txt").write_text("".join(place + "\n" for place in places))
        save = self.folder / "terrane" / "home.sqlite"
        if not save.exists():
            self.succeed("generate", "--world", save, "--radius", "1", *window_support.FLAT)
            with contextlib.closing(sqlite3.connect(save)) as database, database:
                database.execute("INSERT OR REPLACE INTO settings VALUES ('hand', ?)", (hand,))
                database.execute("UPDATE settings SET value = '' WHERE name = 'checksum'")  # the program finds it
        options = ("--size", f"{SIZE[0]}x{SIZE[1]}", "--view-distance", "3", "--samples", "1", "--horizon", "0",
                   "--movement", "medium", "--time", "0.5", "--world", "home", "--bookmark", str(start), *window_support.FLAT)
        game = window_support.Game(display, self.folder, options)
        self.addCleanup(game.log.close)
        self.addCleanup(game.process.kill)
        game.open()
        game.wait_for_image(SIZE)
        self.pause = game.pause_after("F1")  # no help in the image
        game.tap(1, *MIDDLE, self.pause)  # captures the mouse
        return game

    def keep(self, display, game, name):
        """Saves the window as a PNG if TERRANE_SCREENSHOTS is set."""
        folder = os.environ.get("TERRANE_SCREENSHOTS")
        if not folder:
            return
        shot = display.screenshot(game.window)
        rows = b"".join(b"\0" + b"".join(bytes(shot.color(x, y)) for x in range(shot.width)) for y in range(shot.height))

        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        pathlib.Path(folder, name + ".png").write_bytes(
            b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", shot.width, shot.height, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))

    def press(self, game, *keys):
        for key in keys:
            game.press(key)
            time.sleep(self.pause)

    def click_here(self, display, game, button):
        """Clicks with Shift: selects the player's position."""
        display.xdotool("keydown", "shift")
        time.sleep(self.pause / 4)
        display.xdotool("click", button)
        time.sleep(self.pause / 4)
        display.xdotool("keyup", "shift")
        time.sleep(self.pause)

    def count(self, name):
        """The number of blocks of this name around the places."""
        numbers = {}
        for line in self.succeed("blocks").splitlines():
            words = line.split()
            if len(words) > 1 and words[0].isdigit():
                numbers[words[1]] = int(words[0])
        file = self.folder / "blocks.npy"
        self.succeed("dump", "--area", "-2,-2,4,4", "--world", self.folder / "terrane" / "home.sqlite", "-o", file)
        return list(Npy(file).volume()).count(numbers[name])

    def close(self, game):
        code, _, _ = game.close()
        self.assertEqual(code, 0, game.output())
        self.assertNotIn("error", game.output())


class Building(BuildingScript):
    def play_with_box(self, display):
        """Plays with a box of 6 x 2 x 4 blocks selected in front of the player, and bricks in the hand."""
        game = self.play(display, ("5.5 8.5 81.5 0 0", "10.5 9.5 84.5 0 0", "8.5 -3.5 88.5 90 -35"), "bricks", 3)
        self.press(game, "b", "F6")
        self.click_here(display, game, 1)
        self.press(game, "F6")
        self.click_here(display, game, 3)
        self.press(game, "F6")
        return game

    def test_boxes(self):
        file = self.folder / "terrane" / "structures" / "wall.structure"
        with window_support.Display() as display:
            game = self.play_with_box(display)
            self.press(game, "g")
            self.keep(display, game, "filled")
            self.press(game, "ctrl+c", "r", "ctrl+v")
            self.keep(display, game, "pasting")
            self.press(game, "ctrl+s", "w", "a", "l", "l", "Return")
            game.wait_for(file.is_file)
            game.wait_for(lambda: self.count("bricks") == 48)
            self.press(game, "Delete")
            game.wait_for(lambda: self.count("bricks") == 0)
            display.xdotool("click", 1)  # places the copy
            game.wait_for(lambda: self.count("bricks") == 48)
            self.keep(display, game, "placed")
            self.press(game, "ctrl+o")
            self.keep(display, game, "files")
            self.press(game, "Return")
            display.xdotool("click", 1)  # in front of the existing blocks
            game.wait_for(lambda: self.count("bricks") > 48)
            self.press(game, "Escape", "Escape")  # ends pasting, closes the tool
            self.close(game)
            self.assertGreater(file.stat().st_size, 40)

    def test_the_panel_of_the_tool_has_buttons(self):
        with window_support.Display() as display:
            game = self.play_with_box(display)
            game.tap(2, *MIDDLE, self.pause)  # frees the cursor
            self.keep(display, game, "buttons")
            game.tap(1, *FILL_BUTTON, self.pause)
            game.wait_for(lambda: self.count("bricks") == 48)
            game.tap(2, *MIDDLE, self.pause)
            self.press(game, "Escape")  # closes the tool
            self.close(game)

    def dark_share(self, display, game):
        """The share of dark pixels in the middle of the image, where the sign is."""
        shot = display.screenshot(game.window)
        spots = [shot.color(x, y) for x in range(MIDDLE[0] - 70, MIDDLE[0] + 70) for y in range(MIDDLE[1] - 80, MIDDLE[1])]
        return sum(is_dark(*color) for color in spots) / len(spots)

    def test_sign(self):
        places = ("8.5 8.5 82.4 90 -35",)
        with window_support.Display() as display:
            game = self.play(display, places, "sign", 1)
            display.xdotool("click", 3)  # builds it
            game.wait_for(lambda: self.count("sign") == 1)
            before = self.dark_share(display, game)
            display.xdotool("click", 3)  # opens it
            time.sleep(self.pause)
            for text in ("Hello, world", "second line", "MMMMMMMMMMMMMMMM"):
                game.type(text)
                time.sleep(self.pause)
                self.press(game, "Down")
            self.keep(display, game, "sign_dialog")
            self.press(game, "Return")
            game.wait_for(lambda: self.dark_share(display, game) > before + 0.01)
            self.keep(display, game, "sign")
            self.close(game)
            game = self.play(display, places, "sign", 1)
            game.wait_for(lambda: self.dark_share(display, game) > before + 0.01)
            self.close(game)


if __name__ == "__main__":
    window_support.main()
