#!/usr/bin/env python3
"""A content pack that changes during the game: terrain is regenerated, edits stay. Usage: watch_test.py PROGRAM

Needs what window_support.py needs."""
import json
import signal

import window_support
from support import HANG_SECONDS, Npy, ProgramTest
from window_support import SCREEN, SIZE, is_brown, is_green

SCRIPT = """
g:pass3D("ground", function(p)
  local soil = select(p.z:lt(80), p:block("dirt"), p:block("%s"))
  p:setBlock(select(p.z:le(80), soil, p:block("air")))
end)
"""


class Watch(ProgramTest):
    def setUp(self):
        super().setUp()
        self.pack = self.folder / "mine"
        (self.pack / "generators").mkdir(parents=True)
        (self.pack / "pack.toml").write_text('format = 1\nname = "mine"\n')
        self.script = self.pack / "generators" / "plain.lua"
        self.script.write_text(SCRIPT % "grass")
        (self.folder / "terrane").mkdir()
        (self.folder / "terrane" / "bookmarks.txt").write_text("8.5 8.5 84 0 -89\n")

    def blocks_of(self, world):
        file = self.folder / "blocks.npy"
        self.succeed("dump", "--world", world, "--content", self.pack, "--area", "0,0,2,1", "-o", file)
        return Npy(file)

    def play(self, display, world, size):
        game = window_support.Game(display, self.folder, (
            "--content", self.pack, "--generator", "mine:plain", "--watch", "--world", world, "--recreate",
            "--bookmark", "1", "--movement", "fast", "--view-distance", "2", "--samples", "1", "--size", f"{size[0]}x{size[1]}"))
        self.addCleanup(game.log.close)
        self.addCleanup(game.process.kill)
        game.open()
        game.wait_for_image(size)
        game.pause_after("F1")  # no help in the image
        return game

    def test_a_script_that_changes(self):
        world = self.folder / "w.sqlite"
        with window_support.Display() as display:
            game = self.play(display, world, SIZE)
            game.wait_for_ground(is_green)
            game.take_mouse()
            display.xdotool("click", 1)
            game.wait_for_ground(is_brown)
            self.script.write_text("p:oops(")
            game.wait_for(lambda: "plain.lua:1" in game.output())
            self.script.write_text(SCRIPT % "stone")
            game.wait_for(lambda: "regenerated except for chunks with edits" in game.output())
            game.wait_for_ground(is_brown)  # the hole is still there
            game.process.send_signal(signal.SIGTERM)
            self.assertEqual(game.process.wait(HANG_SECONDS), 0, game.output())
        self.assertEqual(len(list(self.folder.glob("w*.sqlite"))), 1)  # no copies
        ids = {block["name"]: block["id"] for block in json.loads(self.succeed("blocks", "--json"))}
        blocks = self.blocks_of(world)
        self.assertEqual(blocks.column(8, 8)[80], ids["air"])
        self.assertEqual(blocks.column(2, 2)[80], ids["grass"])  # the edited chunk stays as it was
        self.assertEqual(blocks.column(20, 2)[80], ids["stone"])

    def test_a_change_while_saving_fails(self):
        world = self.folder / "w.sqlite"
        with window_support.Display() as display:
            game = self.play(display, world, SCREEN)
            world.rename(self.folder / "away.sqlite")
            game.wait_for(game.is_warned)
            self.script.write_text(SCRIPT % "stone")
            game.wait_for(game.asks_to_lose)  # before the world is opened again
            game.quit_unsaved()
            self.assertEqual(game.process.wait(HANG_SECONDS), 2)
            self.assertRegex(game.output(), r"error: .*w.sqlite: deleted or moved .*; not saved: \d+ chunks\n")
        self.assertFalse(world.exists())


if __name__ == "__main__":
    window_support.main()
