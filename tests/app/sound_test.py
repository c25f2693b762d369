#!/usr/bin/env python3
"""Plays in the program's window and checks the sound that OpenAL writes to a file. Usage: sound_test.py PROGRAM

Needs Xvfb (without it the test is skipped, exit code 77), xdotool and xwd; Debian's packages are xvfb, xdotool and
x11-apps."""
import array
import os
import pathlib
import sys
import time
import unittest.mock

from support import ProgramTest

sys.path.append(str(pathlib.Path(__file__).parent))
import window_support  # noqa: E402
from window_support import FLAT, SIZE, Display, Game, is_green  # noqa: E402

HEADER_BYTES = 68  # of OpenAL's WAV file


class Sound(ProgramTest):
    def listen(self, **variables):
        for name in ("ALSOFT_DRIVERS", "PULSE_SERVER", "XDG_RUNTIME_DIR"):
            variables.setdefault(name, "")
        patch = unittest.mock.patch.dict(os.environ, variables)
        patch.start()
        self.addCleanup(patch.stop)

    def play(self, display, *arguments):
        """Looks down at the flat world from its ground."""
        (self.folder / "terrane").mkdir(exist_ok=True)
        (self.folder / "terrane" / "bookmarks.txt").write_text("8.5 8.5 82 0 -89\n")
        game = Game(display, self.folder, ("--size", f"{SIZE[0]}x{SIZE[1]}", "--view-distance", "4", "--samples", "1",
                                           "--bookmark", "1", "--no-save", *FLAT, *arguments))
        self.addCleanup(game.log.close)
        self.addCleanup(game.process.kill)
        game.open()
        game.wait_for_image(SIZE)
        game.pause_after("F1")
        game.wait_for_ground(is_green)
        return game

    def loudest(self, file, since=0):
        """The peak of the samples after the byte `since`, 0 to 1."""
        data = file.read_bytes()[max(since, HEADER_BYTES) & ~3:]
        samples = array.array("h", data[:len(data) & ~3])
        return max((abs(sample) for sample in samples), default=0) / 32768

    def test_a_block_that_breaks_is_heard(self):
        file, config = self.folder / "heard.wav", self.folder / "alsoft.conf"
        config.write_text(f"drivers = wave\nchannels = stereo\nsample-type = int16\n[wave]\nfile = {file}\n")
        self.listen(ALSOFT_DRIVERS="wave", ALSOFT_CONF=str(config))
        with Display() as display:
            game = self.play(display, "--sound-volume", "1")
            if "this build has no sounds" in game.output():
                self.skipTest("this build has no sounds")
            game.take_mouse()
            time.sleep(1)
            before = file.stat().st_size
            wind = self.loudest(file, before // 2)
            self.assertGreater(wind, 0, "there is wind")
            game.click(1)
            game.wait_for(lambda: self.loudest(file, before) > max(0.1, 3 * wind))
            self.assertEqual(game.close()[0], 0, game.output())
            self.assertNotIn("without sounds", game.output())

    def test_without_a_device_one_line_says_so(self):
        self.listen(ALSOFT_DRIVERS="")
        if any(pathlib.Path("/dev/snd").glob("pcm*p")):
            self.skipTest("this machine has a sound card")
        with Display() as display:
            game = self.play(display)
            game.wait_for(lambda: "without sounds: " in game.output())
            self.assertEqual(game.close()[0], 0, game.output())
            lines = [line for line in game.output().splitlines() if "sound" in line or "AL" in line]
            self.assertEqual(len(lines), 1, lines)
            self.assertTrue(lines[0].startswith("terrane: without sounds: "), lines)

    def test_volume_0_opens_nothing(self):
        self.listen()
        with Display() as display:
            game = self.play(display, "--sound-volume", "0")
            time.sleep(1)
            self.assertEqual(game.close()[0], 0, game.output())
            self.assertNotIn("sounds", game.output())


if __name__ == "__main__":
    window_support.main()
