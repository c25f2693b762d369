#!/usr/bin/env python3
"""Opens the program's window on a virtual display, flies, resizes and closes it. Usage: window_test.py PROGRAM

Needs what window_support.py needs."""
import contextlib
import os
import re
import shutil
import signal
import sqlite3
import subprocess
import time
import unittest
import unittest.mock

import support
import window_support
from support import HANG_SECONDS, Npy, Image, ProgramTest
from window_support import FLAT, SCREEN, SIZE, LARGER, Display, is_green, is_brown, is_grey, Game


class Window(ProgramTest):
    def play(self, display, *arguments, size=SIZE, horizon=0):
        # Far enough that fog never hides all of the ground.
        usual = ("--size", f"{size[0]}x{size[1]}", "--view-distance", "6", "--samples", "1", "--horizon", str(horizon))
        game = Game(display, self.folder, (*usual, *arguments))
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
        self.assertNotIn("error", game.output())
        self.assertNotIn("warning", game.output())
        return place

    def test_draws_flies_resizes_and_closes(self):
        with Display() as display:
            start = self.close(self.play(display, "--movement", "fast"))

            game = self.play(display, "--movement", "fast", horizon=1024)
            display.xdotool("keydown", "w")
            time.sleep(1)
            display.xdotool("keyup", "w")
            game.wait_for_image(SIZE)
            display.xdotool("windowsize", game.window, *LARGER)
            game.wait_for_image(LARGER, x0=SIZE[0])
            game.wait_for_image(LARGER, y0=SIZE[1])
            end = self.close(game)
            distance = sum((a - b) ** 2 for a, b in zip(start, end)) ** 0.5
            self.assertGreater(distance, 5, f"the camera stayed at {end}")  # farther than a fall or a walk

    def test_keys_are_taken_before_there_is_an_image(self):
        cache = self.folder / "no shaders yet"
        with Display() as display, unittest.mock.patch.dict(os.environ, {"MESA_SHADER_CACHE_DIR": str(cache)}):
            game = Game(display, self.folder, ("--size", f"{SIZE[0]}x{SIZE[1]}", "--view-distance", "3"))
            self.addCleanup(game.log.close)
            self.addCleanup(game.process.kill)
            game.open()
            for key in ("F12", "F3", "F4", "F2", "m", "l", "F12"):
                game.press(key)
            game.wait_for_image(SIZE)
            self.assertEqual(self.screenshots(), [])  # the world is not drawn yet
            # Repeated: the panel is drawn before the world.
            game.wait_for(lambda: game.press("F12") or self.screenshots())
            self.close(game, open_things=1)

    # Above the flat world, which has grass on earth at z = 80: one block fills the middle of the image.
    def look_down(self, display, *arguments):
        (self.folder / "terrane").mkdir(exist_ok=True)
        (self.folder / "terrane" / "bookmarks.txt").write_text("8.5 8.5 84 0 -89\n")
        game = self.play(display, "--bookmark", "1", *arguments, *FLAT)
        game.pause_after("F1")  # no help in the image
        game.wait_for_ground(is_green)
        game.take_mouse()
        return game

    def test_the_gpu_makes_meshes_while_one_flies_and_builds(self):
        save = self.folder / "terrane" / "home.sqlite"
        with Display() as display:
            game = self.look_down(display, "--backend", "gpu", "--movement", "fast", "--world", "home")
            display.xdotool("keydown", "w")
            time.sleep(1)
            display.xdotool("keyup", "w")
            game.press("F6")  # to the bookmark
            game.wait_for_ground(is_green)
            display.xdotool("click", 1)
            game.wait_for_ground(is_brown)
            game.press("2")  # cobble
            display.xdotool("click", 3)
            game.wait_for_ground(is_grey)
            self.close(game)
            self.assertEqual(self.highest_block(save), 80)

    def test_a_signal_saves_and_quits(self):
        with Display() as display:
            for number in (signal.SIGINT, signal.SIGTERM):
                save = self.folder / "terrane" / f"{number}.sqlite"
                game = self.look_down(display, "--movement", "medium", "--world", save.stem)
                display.xdotool("click", 1)
                game.wait_for_ground(is_brown)
                game.pause_after("m")
                game.process.send_signal(number)
                self.assertEqual(game.process.wait(HANG_SECONDS), 0, game.output())
                self.assertEqual(self.highest_block(save), 79)
                self.assertEqual(self.setting(save, "camera"), "8.5 8.5 84 0 -89")
                self.assertEqual(self.setting(save, "movement"), "walls")

    def screenshots(self):
        return list(self.folder.glob("**/terrane-*.png"))

    def highest_block(self, save):
        """Height of the highest block of the column 8,8 in the save."""
        dump = self.folder / "blocks.npy"
        self.succeed("dump", "--area", "0,0,1,1", "--world", save, "-o", dump)
        return max(z for z, block in enumerate(Npy(dump).column(8, 8)) if block != 0)

    def setting(self, save, name):
        with contextlib.closing(sqlite3.connect(save)) as database:
            return database.execute("SELECT value FROM settings WHERE name = ?", (name,)).fetchone()[0]

    def has_edits(self, save):
        with contextlib.closing(sqlite3.connect(save)) as database:
            return database.execute("SELECT count(*) FROM chunks WHERE origin = 1 AND key < 1 << 56").fetchone()[0] > 0

    def set_setting(self, save, name, value):
        with contextlib.closing(sqlite3.connect(save)) as database, database:
            database.execute("UPDATE settings SET value = ? WHERE name = ?", (value, name))
            database.execute("UPDATE settings SET value = '' WHERE name = 'checksum'")  # the program finds it

    def test_edits_and_the_camera_outlive_the_program(self):
        save = self.folder / "terrane" / "home.sqlite"
        options = ("--world", "home", "--movement", "medium", *FLAT)
        with Display() as display:
            self.close(self.play(display, *options))
            top = self.highest_block(save)
            self.set_setting(save, "camera", f"8.5 8.5 {top + 4} 0 -89")
            game = self.play(display, *options)
            game.click(1)  # takes the mouse
            display.xdotool("click", 1)  # breaks the block in the middle: pressed and released within a frame
            # Other processes can read the save during the game.
            game.wait_for(lambda: self.highest_block(save) == top - 1)
            self.assertRegex(self.succeed("check", save), r"(?s)\Aopen in another program \(process \d+\): .*\ngood\n\Z")
            self.succeed("map", "--radius", "1", "--world", save, "-o", self.folder / "map.png")
            first = self.close(game)
            self.assertEqual(self.highest_block(save), top - 1)

            second = self.close(self.play(display, *options))
            self.assertEqual(first, second)
            self.assertEqual(self.highest_block(save), top - 1)
            self.assertTrue(self.succeed("check", save).endswith("\ngood\n"))


    def test_time_passes_while_its_key_is_held(self):
        save = self.folder / "terrane" / "flat-1.sqlite"
        with Display() as display:
            game = self.look_down(display, "--movement", "medium", "--time", "0.6")
            display.xdotool("keydown", "p")
            game.wait_for(lambda: float(self.setting(save, "time") or 0) > 0.7)  # a press alone: 0.61
            display.xdotool("keyup", "p")
            display.xdotool("keydown", "o")
            game.wait_for(lambda: float(self.setting(save, "time")) < 0.6)
            display.xdotool("keyup", "o")
            self.assertEqual(game.close()[0], 0)

    def test_without_options_everything_is_saved(self):
        """The world, the position, the time and the block in the hand survive even a kill, in any working directory."""
        save = self.folder / "terrane" / "flat-1.sqlite"
        with Display() as display:
            game = self.look_down(display, "--movement", "medium", "--time", "0.6")
            display.xdotool("click", 5)  # the wheel: the next kind of block
            display.xdotool("click", 1)
            game.wait_for_ground(is_brown)
            game.press("p")
            # Other programs may read the save meanwhile.
            game.wait_for(lambda: float(self.setting(save, "time")) > 0.61 and self.has_edits(save))
            game.process.kill()
            game.process.wait(HANG_SECONDS)
            self.assertEqual(self.highest_block(save), 79)
            self.assertEqual(self.setting(save, "camera"), "8.5 8.5 84 0 -89")
            hand = self.setting(save, "hotbar")
            self.assertNotIn(hand, ("", "stone"))

            elsewhere = self.folder / "elsewhere"
            elsewhere.mkdir()
            game = Game(display, elsewhere, ("--size", "320x180", "--view-distance", "3", *FLAT), data=self.folder)
            self.addCleanup(game.log.close)
            self.addCleanup(game.process.kill)
            game.open()
            game.wait_for_ground(is_brown)
            _, _, place = game.close()
            self.assertAlmostEqual(place[0], 8.5)
            self.assertEqual(self.setting(save, "hotbar"), hand)
            self.assertEqual(list(elsewhere.iterdir()), [], "nothing in the working directory")

    def test_not_to_save_is_a_choice(self):
        with Display() as display:
            game = self.look_down(display, "--no-save")
            display.xdotool("click", 1)
            game.wait_for_ground(is_brown)
            self.close(game)
            self.assertEqual(list(self.folder.glob("**/*.sqlite")), [])
            # If nothing can be saved, the player is told before building.
            game = Game(display, self.folder, FLAT, data="/dev/null")
            self.addCleanup(game.log.close)
            self.assertEqual(game.process.wait(HANG_SECONDS), 2)
            self.assertRegex(game.output(), r"\Aterrane: error: /dev/null/terrane: .*\(--no-save plays without saving\)\n\Z")
            # The hint is not given where it does not help.
            self.succeed("generate", "--world", self.folder / "a.sqlite", "--radius", "0", *FLAT)
            game = Game(display, self.folder, ("--world", "a.sqlite", "--seed", "9"))
            self.addCleanup(game.log.close)
            self.assertEqual(game.process.wait(HANG_SECONDS), 2)
            self.assertRegex(game.output(), r"\Aterrane: error: a.sqlite: made with seed 1, not 9\n\Z")

    def test_a_world_of_the_working_directory_is_found(self):
        with Display() as display:
            self.close(self.play(display, "--world", "home", *FLAT))
            (self.folder / "save").mkdir()
            (self.folder / "terrane" / "home.sqlite").rename(self.folder / "save" / "home.sqlite")
            game = self.play(display, "--world", "home")
            self.close(game)
            self.assertIn("save/home.sqlite: opened from the working directory; move it into", game.output())
            self.assertEqual(list((self.folder / "terrane").glob("*.sqlite")), [])

    def test_a_player_learns_that_saving_fails(self):
        save, away = self.folder / "terrane" / "home.sqlite", self.folder / "away.sqlite"
        options = ("--world", "home", "--movement", "medium", *FLAT)

        with Display() as display:
            game = self.play(display, *options, size=SCREEN)
            save.rename(away)
            game.wait_for(game.is_warned)
            game.quit()
            game.wait_for(game.asks_to_lose)  # asks instead of closing
            game.press("Escape")
            game.wait_for(lambda: not game.asks_to_lose())  # stays
            game.press("Escape")  # leaves the menu
            game.wait_for(game.is_warned)
            away.rename(save)
            game.wait_for(lambda: not game.is_warned())
            code, _, place = game.close()
            self.assertEqual(code, 0, game.output())
            self.assertIn("deleted or moved while it was open", game.output())
            self.assertEqual(self.setting(save, "camera").split()[0], f"{place[0]:g}")

            game = self.play(display, *options, size=SCREEN)
            save.rename(away)
            game.wait_for(game.is_warned)
            game.quit()
            game.wait_for(game.asks_to_lose)
            game.quit_unsaved()
            self.assertEqual(game.process.wait(HANG_SECONDS), 2)
            self.assertRegex(game.output(), r"error: .*home.sqlite: deleted or moved .*; not saved: \d+ chunks\n")

    def test_what_is_in_a_chest_is_saved(self):
        save, size = self.folder / "terrane" / "home.sqlite", (480, 300)
        options = ("--world", "home", "--movement", "medium", *FLAT)
        middle, slot = (240, 150), (64, 94)  # the slot: the first, left above
        with Display() as display:
            self.close(self.play(display, *options, size=size))
            top = self.highest_block(save)
            self.set_setting(save, "camera", f"8.5 8.5 {top + 5} 0 -89")
            self.set_setting(save, "hotbar", "0 chest")
            game = self.play(display, *options, size=size)
            pause = game.pause_after("F1")
            game.tap(1, *middle, pause)  # takes the mouse
            game.tap(3, *middle, pause)  # builds it
            game.tap(3, *middle, pause)  # opens it
            game.tap(1, *slot, pause)  # puts a chest into the chest
            game.tap(1, *slot, pause)
            game.press("Escape")  # closes it
            self.close(game)
            self.assertEqual(self.highest_block(save), top + 1)

            game = self.play(display, *options, size=size)
            pause = game.pause_after("F1")
            game.tap(1, *middle, pause)
            game.tap(3, *middle, pause)
            game.tap(3, *slot, pause)  # takes one out: it replaces the stone in the hand
            game.press("Escape")
            time.sleep(pause)
            game.tap(1, *middle, pause)  # breaks nothing: the other chest is still in it
            game.tap(3, *middle, pause)
            game.tap(3, *slot, pause)
            game.press("Escape")
            time.sleep(pause)
            for button in (1, 1, 3):  # breaks the chest and the block below it, and builds there
                game.tap(button, *middle, pause)
            self.close(game)
            self.assertEqual(self.highest_block(save), top)
            names = [line.split()[1] for line in self.succeed("blocks").splitlines()[1:]]
            self.assertEqual(names[Npy(self.folder / "blocks.npy").column(8, 8)[top]], "chest")

    def test_a_player_tries_everything_and_finds_it_again(self):
        size, settings = (480, 720), self.folder / "terrane" / "settings.toml"
        options = ("--world", "home", *FLAT)
        with Display(size) as display:
            game = self.play(display, *options, "--collect-perf-data", "perf.csv", size=size)
            game.click(1, 100, 400)  # takes the mouse
            display.xdotool("keydown", "w")
            for key in ("space", "F1", "F3", "F4", "F5", "F6", "F12", "o", "p", "i", "m", "m"):
                game.press(key)
                time.sleep(0.2)
            display.xdotool("keyup", "w")
            for button in (1, 3, 4, 5):
                game.click(button, 240, 360)
            pause = game.pause_after("F2")
            for y in range(275, 430, 23):  # down the column of the panel's switches
                game.click(1, 203, y, pause)
            end = self.close(game, open_things=1)

            self.assertEqual(len((self.folder / "terrane" / "bookmarks.txt").read_text().splitlines()), 1)
            image = Image(self.folder / "terrane" / "screenshots" / "terrane-0001.png")
            self.assertEqual((image.width, image.height), size)
            rows = [line.split(",") for line in (self.folder / "perf.csv").read_text().splitlines()]
            self.assertEqual(rows[0][:3], ["time_s", "frame_ms", "fps"])
            self.assertGreater(len(rows), 10)
            self.assertTrue(all(len(row) == len(rows[0]) for row in rows))
            self.assertAlmostEqual(float(rows[-1][0]), sum(float(row[1]) for row in rows[1:]) / 1000, delta=0.1)
            written = settings.read_text()
            save = self.folder / "terrane" / "home.sqlite"
            self.assertEqual(self.setting(save, "movement"), "medium")  # gravity, then fast
            switches = re.findall(r"^(distance-fog|god-rays|clouds|animation|sharp-filtering) = '(?:on|off)'$", written,
                                  re.MULTILINE)
            self.assertGreaterEqual(len(switches), 3, written)

            again = self.play(display, *options, size=size)
            self.assertEqual(self.close(again), end)
            self.assertEqual(settings.read_text(), written)

    def test_the_first_start_measures_which_preset_to_take(self):
        message = r"graphics: (low|medium|high|ultra), for \d+ frames/s on .+ \(measured; "

        def play():
            game = Game(display, self.folder, ("--size", f"{SIZE[0]}x{SIZE[1]}", *FLAT))
            self.addCleanup(game.log.close)
            self.addCleanup(game.process.kill)
            game.open()
            game.wait_for_image(SIZE)
            return game

        with Display() as display:
            game = play()
            preset = game.wait_for(lambda: re.search(message, game.output()))[1]
            self.close(game)
            self.assertEqual(self.lines_of_settings(), [f"preset = '{preset}'"])
            game = play()
            time.sleep(3)  # longer than a measurement
            self.close(game)
            self.assertNotRegex(game.output(), message)
            self.assertEqual(self.lines_of_settings(), [f"preset = '{preset}'"])

    def test_escape_closes_one_thing_at_a_time(self):
        options = ("--world", "home", "--movement", "medium", *FLAT)
        with Display() as display:
            start = self.close(self.play(display, *options, size=SCREEN))
            game = self.play(display, *options, size=SCREEN)
            before = self.brightness(display, game)
            pause = game.pause_after("F2")  # the panel
            game.press("Escape")  # closes it
            time.sleep(pause)
            self.assertIsNone(game.process.poll())
            game.press("Escape")
            game.wait_for(lambda: self.brightness(display, game) < 0.8 * before)  # the menu darkens the world
            display.xdotool("keydown", "w")
            time.sleep(pause)
            display.xdotool("keyup", "w")
            game.press("Escape")
            game.wait_for(lambda: self.brightness(display, game) > 0.95 * before)
            self.assertEqual(self.close(game), start)  # no movement in the menu

    def brightness(self, display, game):
        """The brightness of a corner of the sky, which has no overlay."""
        return max(1, sum(display.screenshot(game.window).color(4, 4)))

    def test_who_chooses_a_preset_is_not_measured(self):
        with Display() as display:
            for options in (("--preset", "low"), ("--clouds", "off"), ("--settings", "")):
                game = Game(display, self.folder, ("--size", f"{SIZE[0]}x{SIZE[1]}", *options, *FLAT))
                self.addCleanup(game.log.close)
                self.addCleanup(game.process.kill)
                game.open()
                game.wait_for_image(SIZE)
                time.sleep(3)  # longer than a measurement
                self.close(game)
                self.assertNotIn("graphics: ", game.output())
                self.assertFalse((self.folder / "terrane" / "settings.toml").exists())

    def lines_of_settings(self):
        path = self.folder / "terrane" / "settings.toml"
        return [line for line in path.read_text().splitlines() if line and not line.startswith("#")]

    def test_only_what_a_player_changed_is_kept(self):
        (self.folder / "terrane").mkdir(exist_ok=True)
        (self.folder / "terrane" / "settings.toml").write_text("day-minutes = 3\n")
        with Display() as display:
            self.close(self.play(display, "--clouds", "off", *FLAT))
            self.assertEqual(self.lines_of_settings(), ["day-minutes = 3"])
            game = self.play(display, "--clouds", "off", "--field-of-view", "80", *FLAT)
            game.press("l")
            self.close(game)
            lines = self.lines_of_settings()
            self.assertEqual(lines[0], "day-minutes = 3")
            self.assertRegex(lines[1], r"\Alight = '(classic|smooth)'\Z")
            self.assertEqual(len(lines), 2)

    def test_the_whole_screen_is_a_setting(self):
        settings = self.folder / "full.toml"
        settings.write_text("full-screen = true\n")
        with Display() as display:
            game = Game(display, self.folder, ("--settings", settings, "--samples", "1", "--view-distance", "6", *FLAT))
            self.addCleanup(game.log.close)
            self.addCleanup(game.process.kill)
            game.open()
            game.wait_for_image(SCREEN)
            game.press("F11")
            game.wait_for(lambda: display.screenshot(game.window).width != SCREEN[0])
            self.close(game)
        self.assertNotIn("full-screen", settings.read_text())

    def test_a_wrong_time_in_a_save_is_named(self):
        save = self.folder / "terrane" / "home.sqlite"
        with Display() as display:
            self.close(self.play(display, "--world", "home", *FLAT))
            self.set_setting(save, "time", "nan")
            game = self.play(display, "--world", "home")
            code, _, _ = game.close()
            self.assertEqual(code, 0, game.output())
            self.assertIn('warning: the save\'s time of day is not a number from 0 to 1: "nan"', game.output())
            self.close(self.play(display, "--world", "home"))  # a time is stored again

    def test_keys_do_nothing_else_while_one_types(self):
        size = (480, 720)
        with Display(size) as display:
            game = self.play(display, *FLAT, size=size)
            game.press("F2")
            display.xdotool("keydown", "Control_L")
            game.click(1, 258, 116, pause=1)  # the field of view's slider: a number can be typed
            display.xdotool("keyup", "Control_L")
            for key in ("m", "9", "Return", "m"):
                game.press_alone(key)
            self.close(game, open_things=1)
            self.assertEqual(self.lines_of_settings(), ["field-of-view = '40'"])
            self.assertEqual(self.setting(self.folder / "terrane" / "flat-1.sqlite", "movement"), "fast")

    def test_a_resource_pack_is_loaded_while_one_plays(self):
        size, pack = (480, 720), self.folder / "pk"
        pack.mkdir()
        support.write_png(pack / "grass_top.png", 16, 16, (255, 0, 0, 255))
        with Display(size) as display:
            game = self.play(display, *FLAT, size=size)
            pause = game.pause_after("F2")
            for name in ("no", "pk"):  # the first does not exist: a message, and no change
                game.click(1, 258, 676, pause)  # the field of the folder
                for key in ("BackSpace", "BackSpace", *name, "Return"):
                    game.press_alone(key, pause)
                time.sleep(2 * pause)
            def is_red():  # the ground at the window's lower left, next to the hand
                red, green, blue = display.screenshot(game.window).color(150, size[1] - 4)
                return red > 2 * max(blue, green)
            game.wait_for(is_red)
            self.close(game, open_things=1)
        self.assertEqual(self.setting(self.folder / "terrane" / "flat-1.sqlite", "resource_pack"),
                         os.path.realpath(pack))

    def test_shaders_are_read_again_while_one_plays(self):
        root = self.folder / "root"
        shader = root / "terrane" / "render" / "shade.frag.glsl"
        shader.parent.mkdir(parents=True)
        red = "layout(location = 0) out vec4 picture;\nvoid main() { picture = vec4(1, 0, 0, 1); }\n"

        def write(path, text):
            """Writes atomically: a partially written file would be read twice."""
            path.with_suffix(".new").write_text(text)
            path.with_suffix(".new").replace(path)

        def is_red(display, game):
            return display.screenshot(game.window).color(SIZE[0] - 3, 3) == (255, 0, 0)  # where nothing else is drawn

        with Display() as display:
            game = self.look_down(display, "--shader-root", root)  # waits for the world: its first shaders are read by then
            self.assertFalse(is_red(display, game))
            write(shader, red)
            game.wait_for(lambda: is_red(display, game))
            wrong = shader.with_name("debug_view.frag.glsl")
            write(wrong, "this is no shader\n")
            complaint = "debug_view.frag.glsl: the shader does not compile"
            game.wait_for(lambda: complaint in game.output())
            self.assertTrue(is_red(display, game))
            game.press_alone("l")  # needs a variant of the broken shader: the light stays unchanged, and the game continues
            game.wait_for(lambda: game.output().count(complaint) == 2)
            wrong.unlink()
            write(shader, red.replace("1, 0, 0", "0, 0, 1"))
            game.wait_for(lambda: not is_red(display, game))
            code, _, _ = game.close()
            self.assertEqual(code, 0, game.output())
            self.assertEqual(game.output().count(complaint), 2, game.output())

    @unittest.skipUnless(shutil.which("xrdb"), "xrdb is not installed (Debian: x11-xserver-utils)")
    def test_on_a_screen_of_twice_the_scale_all_is_twice_as_large(self):
        twice = (2 * SIZE[0], 2 * SIZE[1])
        with Display() as display:
            subprocess.run(["xrdb", "-merge"], input="Xft.dpi: 192\n", text=True, check=True, timeout=HANG_SECONDS,
                           env=support.environment(display.name))
            game = Game(display, self.folder, ("--size", f"{SIZE[0]}x{SIZE[1]}", "--view-distance", "6", "--samples", "1", *FLAT))
            self.addCleanup(game.log.close)
            self.addCleanup(game.process.kill)
            game.open()
            game.wait_for_image(twice)
            pause = game.pause_after("F2")
            # The slider of the view distance is twice as far from the panel's corner as on other screens.
            game.click(1, 120, 186, pause)
            self.close(game, open_things=1)
        self.assertRegex(self.lines_of_settings()[0], r"\Aview-distance = '1[0-9]'\Z")

    def test_wrong_settings_are_named(self):
        settings = self.folder / "settings.toml"
        for text, hint in (("clouds = 'many'", "settings.toml:1: clouds: "), ("cloud = 'on'", "settings.toml:1: cloud: "),
                           ("clouds = ", "settings.toml:1: "), ("view-distance = 1000", "settings.toml:1: view-distance: ")):
            settings.write_text(text)
            done = support.run("play", "--settings", settings)
            self.assertRefused(done, text)
            self.assertIn(hint, done.stderr)


if __name__ == "__main__":
    window_support.main()
