#!/usr/bin/env python3
"""Goes through the title screen on a virtual display, by keyboard alone. Usage: title_test.py PROGRAM

Needs what window_support.py needs."""
import contextlib
import re
import sqlite3
import subprocess
import time

import support
import window_support
from support import HANG_SECONDS, ProgramTest

SIZE = (480, 300)
# The world behind the title is still, so only keys change the image.
USUAL = ("--size", f"{SIZE[0]}x{SIZE[1]}", "--view-distance", "2", "--horizon", "0", "--samples", "1", "--reduced-motion",
         "--animation", "off", "--clouds", "off")
CLOSED = re.compile(r"closed after \d+ frames at (\S+)$", re.MULTILINE)


class Player(window_support.Game):
    """The program and a simulated keyboard."""

    def __init__(self, display, folder, *arguments):
        self.display, self.window = display, None
        self.log = window_support.tempfile.TemporaryFile(mode="w+")
        self.process = subprocess.Popen([support.program(), "--debug-gl", *USUAL, *arguments], cwd=folder,
                                        env=support.environment(display.name, folder), stdout=self.log, stderr=self.log)

    def pixels(self):
        return self.display.screenshot(self.window).pixels

    def settle(self, seconds=3, still=0.6):
        """Waits until the image stops changing, or changes only with the time of day: at most `seconds`. It must be unchanged
        for `still` seconds, and for longer after slow changes."""
        start = changed = time.monotonic()
        before, longest = self.pixels(), 0.2
        while time.monotonic() - start < seconds and time.monotonic() - changed < max(still, 3 * longest):
            time.sleep(0.15)
            now = self.pixels()
            if now != before:
                longest = max(longest, time.monotonic() - changed)
                before, changed = now, time.monotonic()

    def press_once(self, *keys):
        """Waits after each key until the image has changed and is stable, for longer after slow changes."""
        for key in keys:
            before, start = self.pixels(), time.monotonic()
            with self.asleep():
                self.press(key)
            while self.process.poll() is None and self.pixels() == before and time.monotonic() - start < 5:
                time.sleep(0.02)
            frame = time.monotonic() - start
            self.settle(max(3, 6 * frame), still=max(0.6, 3 * frame))

    def choose(self, *keys):
        self.press_once(*keys, "Return")

    def places(self):
        """The positions at which played worlds were left."""
        return CLOSED.findall(self.output())


class TitleScript(ProgramTest):
    """Actions on the title screen."""

    def setUp(self):
        super().setUp()
        self.worlds = self.folder / "terrane"

    def open(self, display, *arguments):
        player = Player(display, self.folder, *arguments)
        self.addCleanup(player.log.close)
        self.addCleanup(player.process.kill)
        player.open()
        player.wait_for_image(SIZE)
        player.settle()
        return player

    def quit(self, player):
        """Quits from the main page."""
        player.press("q")
        self.assertEqual(player.process.wait(HANG_SECONDS), 0, player.output())
        self.assertNotRegex(player.output(), "error|warning")

    def names(self):
        return sorted(path.stem for path in self.worlds.glob("*.sqlite"))

    def setting(self, world, name):
        try:
            with contextlib.closing(sqlite3.connect(f"file:{self.worlds / world}.sqlite?mode=ro", uri=True)) as database:
                row = database.execute("SELECT value FROM settings WHERE name = ?", (name,)).fetchone()
                return row[0] if row else None
        except sqlite3.OperationalError:  # no table yet
            return None

    def is_played(self, world):
        """Whether a process plays the world: it then writes its id into the lock, unlike one that only shows it."""
        lock = self.worlds / f"{world}.sqlite-lock"
        return lock.exists() and lock.read_text() != ""

    def leave_for_title(self, player):
        left = len(player.places())
        player.press("Escape")
        player.settle()
        start = time.monotonic()
        player.press("t")
        player.wait_for(lambda: len(player.places()) > left)
        # The game's last image stays until the title is drawn. The title's world is still once it is loaded, some time
        # after the first image.
        before, deadline = player.pixels(), time.monotonic() + 8
        while player.pixels() == before and time.monotonic() < deadline:
            time.sleep(0.05)
        player.settle(30, still=max(2, time.monotonic() - start))


class Title(TitleScript):
    def test_a_new_world_is_made_left_and_continued(self):
        with window_support.Display() as display:
            player = self.open(display)
            player.choose()  # New world: the only entry
            player.choose()  # Create
            player.wait_for(lambda: self.setting("World", "camera"))
            self.assertEqual(self.setting("World", "generator"), "continents")
            self.assertEqual(self.setting("World", "movement"), "gravity")
            player.press("m")
            player.wait_for(lambda: self.setting("World", "movement") == "fast")
            self.leave_for_title(player)
            self.assertTrue((self.worlds / "World.png").exists())
            player.choose()  # Continue
            player.wait_for(lambda: self.is_played("World"))
            player.settle()
            self.leave_for_title(player)
            first, second = player.places()
            self.assertEqual(first, second)
            # A new world starts with default settings.
            player.choose("Down", "Down")
            player.choose()
            player.wait_for(lambda: self.setting("World 2", "camera"))
            self.assertEqual(self.setting("World 2", "movement"), "gravity")
            self.assertEqual(self.setting("World", "movement"), "fast")
            player.press("Escape")
            player.settle()
            player.press("q")
            self.assertEqual(player.process.wait(HANG_SECONDS), 0, player.output())
            self.assertNotRegex(player.output(), "error|warning")

    def test_worlds_are_renamed_copied_and_deleted(self):
        self.worlds.mkdir(exist_ok=True)
        self.succeed("generate", "--world", self.worlds / "home.sqlite", "--radius", "1", "--generator", "flat")
        with window_support.Display() as display:
            player = self.open(display)
            player.choose("Down")  # Worlds
            player.press_once("Down", "Right", "Right")
            player.choose()  # Rename
            player.type("hut")
            player.press_once("Return")
            player.wait_for(lambda: self.names() == ["hut"])
            player.settle()
            player.press_once("Down", "Right", "Right", "Right")
            player.choose()  # Copy
            player.press_once("Return")  # with the proposed name
            player.wait_for(lambda: self.names() == ["hut", "hut copy"])
            player.settle()
            player.press_once("Down", "Down", "Right", "Right", "Right", "Right")
            player.choose()  # Delete
            player.choose()  # Keep it
            self.assertEqual(len(self.names()), 2)
            player.press_once("Down", "Down", "Right", "Right", "Right", "Right")
            player.choose()
            player.choose("Right")
            player.wait_for(lambda: len(self.names()) == 1)
            player.settle()
            player.press_once("Escape")
            self.quit(player)
        self.assertTrue(self.succeed("check", self.worlds / f"{self.names()[0]}.sqlite").endswith("good\n"))

    def test_a_key_that_is_held_chooses_once(self):
        with window_support.Display(repeats_keys=True) as display:
            player = self.open(display)
            display.xdotool("keydown", "Return", "sleep", "3", "keyup", "Return")  # New world, with Create in focus
            player.settle()
            self.assertEqual(self.names(), [])
            player.press_once("Escape")
            self.quit(player)

    def test_settings_are_kept(self):
        settings = self.folder / "terrane" / "settings.toml"
        with window_support.Display() as display:
            for expected in (True, False):
                player = self.open(display)
                player.choose("Down", "Down")  # Settings
                player.choose("Right")  # Controls
                player.choose("Down", "Down")  # the switch below the slider
                player.press_once("Escape")
                self.quit(player)
                text = settings.read_text() if settings.exists() else ""
                self.assertEqual("invert-y = 'true'" in text, expected, text)

    def test_a_world_that_is_named_is_opened_at_once(self):
        with window_support.Display() as display:
            player = self.open(display, "--world", "home", "--generator", "flat")
            player.wait_for(lambda: self.setting("home", "camera"))
            player.press("Escape")
            player.settle()
            player.press("q")
            self.assertEqual(player.process.wait(HANG_SECONDS), 0, player.output())
            self.assertEqual(len(player.places()), 1)

    def test_a_world_that_cannot_be_opened_is_told(self):
        self.worlds.mkdir(exist_ok=True)
        (self.worlds / "bad.sqlite").write_text("no save")
        with window_support.Display() as display:
            player = self.open(display)
            player.choose("Up")  # Worlds
            player.choose()  # plays the only world: a message
            player.choose()  # OK
            player.press_once("Escape")
            self.quit(player)
        self.assertEqual((self.worlds / "bad.sqlite").read_text(), "no save")


if __name__ == "__main__":
    window_support.main()
