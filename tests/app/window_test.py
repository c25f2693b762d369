#!/usr/bin/env python3
"""The program in a real window, on a virtual display: what GLFW and the display server do. The tests of menus, dialogs and
play run without a display (tests/window). Usage: window_test.py PROGRAM

Needs what window_support.py needs."""
import contextlib
import shutil
import sqlite3
import subprocess
import tempfile
import time
import unittest

import support
import window_support
from support import HANG_SECONDS, ProgramTest
from window_support import FLAT, SCREEN, SIZE, LARGER, Display, Game


class Window(ProgramTest):
    def play(self, display, *arguments, size=SIZE):
        game = Game(display, self.folder, ("--view-distance", "3", "--samples", "1", "--horizon", "0", *arguments))
        self.addCleanup(game.log.close)
        self.addCleanup(game.process.kill)  # no effect if it has ended
        game.open()
        game.wait_for_image(size)
        return game

    def close(self, game, open_things=0):
        """Quits, and returns the last position of the camera."""
        code, frames, place = game.close(open_things)
        self.assertEqual(code, 0, game.output())
        self.assertGreater(frames, 0)
        self.assertNotRegex(game.output(), "error|warning")
        return place

    def setting(self, name):
        """Of the save; None before the program wrote it."""
        with contextlib.closing(sqlite3.connect(self.folder / "terrane" / "home.sqlite")) as database:
            row = database.execute("SELECT value FROM settings WHERE name = ?", (name,)).fetchone()
            return row and row[0]

    def test_draws_flies_resizes_and_closes(self):
        with Display() as display:
            game = self.play(display, "--movement", "noclip", "--size", f"{SIZE[0]}x{SIZE[1]}", "--world", "home", *FLAT)
            saved = game.wait_for(lambda: self.setting("camera"))
            start = tuple(map(float, saved.split()[:3]))
            display.xdotool("windowsize", game.window, *LARGER)
            game.wait_for_image(LARGER, x0=SIZE[0])
            game.wait_for_image(LARGER, y0=SIZE[1])
            display.xdotool("keydown", "w")  # last: the flight leads into the ground, which has few colors
            game.wait_for(lambda: self.setting("camera").split()[:2] != saved.split()[:2])
            display.xdotool("keyup", "w")
            self.assertNotEqual(self.close(game), start)

    def test_mouse_and_text_reach_the_game(self):
        with Display() as display:
            game = self.play(display, "--size", f"{SIZE[0]}x{SIZE[1]}", "--world", "home", *FLAT)
            hotbar = game.wait_for(lambda: self.setting("hotbar"))
            yaw = game.wait_for(lambda: self.setting("camera")).split()[3]
            game.pause_after("F1")
            game.take_mouse()
            display.xdotool("click", 5)  # the wheel
            game.wait_for(lambda: self.setting("hotbar") != hotbar)
            display.xdotool("mousemove_relative", 30, 0)
            display.xdotool("mousemove_relative", 30, 0)
            game.wait_for(lambda: self.setting("camera").split()[3] != yaw)
            game.press_alone("n", game.pause)
            game.type("here and now")
            time.sleep(game.pause)
            game.press_alone("Return", game.pause)
            game.wait_for(lambda: (self.setting("places") or "").endswith(" here and now\n"))
            self.close(game, open_things=1)

    def test_full_screen(self):
        settings = self.folder / "full.toml"
        settings.write_text("full-screen = true\n")
        with Display() as display:
            game = self.play(display, "--settings", settings, *FLAT, size=SCREEN)
            game.press("F11")
            game.wait_for(lambda: display.screenshot(game.window).width != SCREEN[0])
            self.close(game)

    @unittest.skipUnless(shutil.which("xrdb"), "xrdb is not installed (Debian: x11-xserver-utils)")
    def test_on_a_screen_of_twice_the_scale_the_window_is_twice_as_large(self):
        with Display() as display:
            subprocess.run(["xrdb", "-merge"], input="Xft.dpi: 192\n", text=True, check=True, timeout=HANG_SECONDS,
                           env=support.environment(display.name))
            game = self.play(display, "--size", f"{SIZE[0]}x{SIZE[1]}", *FLAT, size=(2 * SIZE[0], 2 * SIZE[1]))
            self.close(game)

    def test_an_error_at_the_start_is_shown_to_a_player_without_a_terminal(self):
        settings = self.folder / "terrane" / "settings.toml"
        settings.parent.mkdir(exist_ok=True)
        former_driver = {"MESA_GL_VERSION_OVERRIDE": "3.3", "MESA_GLSL_VERSION_OVERRIDE": "330"}
        for name, text, driver, error in (("settings", "preset = low\n", {}, f"{settings}:1: "),
                                          ("driver", "", former_driver, "no window with an OpenGL 4.5 core context: ")):
            settings.write_text(text)
            with self.subTest(name), Display() as display, tempfile.TemporaryFile(mode="w+") as log:
                process = subprocess.Popen([support.program(), "play"], cwd=self.folder, stdin=subprocess.DEVNULL,
                                           stdout=log, stderr=log,
                                           env={**support.environment(display.name, self.folder), **driver})
                self.addCleanup(process.kill)  # no effect if it has ended
                window = self.wait_for(process, lambda: display.xdotool("search", "--onlyvisible", "--name", "^Terrane$"))
                # A dialog with text, on a plain ground.
                self.wait_for(process, lambda: len(display.screenshot(window).colors()) > 20)
                display.xdotool("windowfocus", window)
                display.xdotool("key", "q")
                self.assertEqual(process.wait(HANG_SECONDS), 2)
                log.seek(0)
                self.assertIn(f"terrane: error: {error}", log.read())
            self.assertEqual(settings.read_text(), text)

    def test_without_a_display_an_error_is_a_line(self):
        with tempfile.TemporaryFile(mode="w+") as log:
            process = subprocess.Popen([support.program(), "play"], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=log,
                                       stderr=log, env=support.environment(None, self.folder))
            self.assertEqual(process.wait(HANG_SECONDS), 2)
            log.seek(0)
            self.assertRegex(log.read(), r"\Aterrane: error: no display: [^\n]+\n\Z")

    def wait_for(self, process, condition):
        deadline = time.monotonic() + HANG_SECONDS
        while not condition():
            self.assertIsNone(process.poll(), "the program ended")
            self.assertLess(time.monotonic(), deadline, "nothing happens")
            time.sleep(0.05)
        return condition()


if __name__ == "__main__":
    window_support.main()
