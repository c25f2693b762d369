#!/usr/bin/env python3
"""Picks blocks, names places and goes back to them, in the program's window on a virtual display. Usage: hud_test.py PROGRAM

Needs what window_support.py needs."""
import contextlib
import sqlite3
import time

import building_test
import window_support


class Hud(building_test.BuildingScript):
    def setting(self, name):
        with contextlib.closing(sqlite3.connect(f"file:{self.folder / 'terrane' / 'home.sqlite'}?mode=ro", uri=True)) as database:
            row = database.execute("SELECT value FROM settings WHERE name = ?", (name,)).fetchone()
            return row[0] if row else ""

    def wait_for_setting(self, game, name, is_it):
        game.wait_for(lambda: is_it(self.setting(name)))

    def hold(self, game, key):
        """Holds a key long enough for a dialog, which misses presses within one frame."""
        game.display.xdotool("keydown", key)
        time.sleep(self.pause)
        game.display.xdotool("keyup", key)
        time.sleep(self.pause)

    def test_a_block_is_picked_and_chosen(self):
        with window_support.Display() as display:
            game = self.play(display, ("8.5 8.5 84 0 -89",), "bricks", 1)
            self.press(game, "3")
            self.wait_for_setting(game, "hotbar", lambda hotbar: hotbar.startswith("2 bricks cobble stone_bricks"))
            game.click(2)  # picks the targeted block
            self.wait_for_setting(game, "hotbar", lambda hotbar: hotbar.startswith("2 bricks cobble grass"))
            self.hold(game, "Tab")
            self.keep(display, game, "palette")
            game.type("chest")
            self.hold(game, "Return")
            self.wait_for_setting(game, "hotbar", lambda hotbar: hotbar.startswith("2 bricks cobble chest"))
            self.press(game, "ctrl+5")  # Control sinks
            self.wait_for_setting(game, "hotbar", lambda hotbar: hotbar.startswith("4 bricks"))
            self.press(game, "3")
            display.xdotool("click", 4)  # the wheel
            self.wait_for_setting(game, "hotbar", lambda hotbar: hotbar.startswith("1 bricks"))
            self.close(game)

    def test_places_are_named_and_found_again(self):
        with window_support.Display() as display:
            game = self.play(display, ("8.5 8.5 84 0 -89", "100.5 -40.5 95 180 -20"), "bricks", 2)
            self.hold(game, "n")
            game.type("far away")
            self.hold(game, "Return")
            self.wait_for_setting(game, "places", lambda places: places == "100.5 -40.5 95 180 -20 far away\n")
            self.keep(display, game, "places")
            self.press(game, "Escape", "F7")
            self.press(game, "h")  # to the spawn
            self.wait_for_setting(game, "camera", lambda camera: not camera.startswith("100.5 "))
            self.keep(display, game, "facts")
            game = self.again(display, game)
            self.assertIn("far away", self.setting("places"))
            self.close(game)

    def test_a_held_key_that_opens_a_text_field_does_not_type_into_it(self):
        with window_support.Display(repeats_keys=True) as display:
            game = self.play(display, ("8.5 8.5 84 0 -89",), "bricks", 1)
            # The display repeats the key; its last repetition is not in a frame with typed text.
            display.xdotool("keydown", "n", "sleep", "2.5", "keyup", "n", "sleep", "1.5")
            game.type("no")
            self.hold(game, "Return")
            self.wait_for_setting(game, "places", lambda places: places != "")
            self.assertEqual(self.setting("places").split(" ", 5)[5], "no\n")
            self.press(game, "Escape")
            self.close(game)

    def again(self, display, game):
        self.close(game)
        return self.play(display, ("8.5 8.5 84 0 -89",), "bricks", 1)

    def test_a_screenshot_is_shown(self):
        folder = self.folder / "terrane" / "screenshots"
        with window_support.Display() as display:
            game = self.play(display, ("8.5 8.5 84 0 -89",), "bricks", 1)
            self.press(game, "F12")
            game.wait_for(lambda: list(folder.glob("*.png")))
            self.keep(display, game, "screenshot")
            # Its white border, near the right edge, stays when the HUD is hidden.
            def is_bordered():
                shot = display.screenshot(game.window)
                return any(min(shot.color(shot.width - 11 - x, 40)) > 250 for x in range(4))
            game.wait_for(is_bordered)
            game.wait_for(lambda: not is_bordered())
            self.close(game)


if __name__ == "__main__":
    window_support.main()
