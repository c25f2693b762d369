#!/usr/bin/env python3
"""A new player's first ten minutes, on a virtual display: a world from the title, a house, a pond, undo, quit, continue,
kill. Usage: first_minutes_test.py PROGRAM

Needs what window_support.py needs. TERRANE_SCREENSHOTS names a folder for images of the window on the way."""
import time

import building_test
import title_test
import window_support
from support import HANG_SECONDS, Npy

# The house is in the air, above the terrain of every generator: a floor of two layers, and a wall at the back.
FLOOR, EYES = 231, 235
CORNERS = ((1, 1, FLOOR - 1), (10, 10, FLOOR), (1, 10, FLOOR + 1), (10, 10, FLOOR + 3))
STAIRS, DOOR, TORCH, LAMP, POND, MISTAKE = (3, 3), (5, 3), (7, 3), (3, 6), (7, 6), (5, 6)


class FirstMinutes(title_test.TitleScript, building_test.BuildingScript):
    """Places are bookmarks: F6 goes from one to the next."""

    def places(self):
        corners = [f"{x}.5 {y}.5 {z}.5 90 -20" for x, y, z in CORNERS]
        spots = [f"{x}.5 {y}.5 {EYES} 90 -89" for x, y in (STAIRS, DOOR, TORCH, LAMP, POND, MISTAKE)]
        return [*corners, *spots, f"5.5 -3.5 {EYES} 90 -30"]

    def there(self):
        """Returns a function from a position to the name of its block in the saved world."""
        names = {}
        for line in self.succeed("blocks").splitlines():
            words = line.split()
            if len(words) > 1 and words[0].isdigit():
                names[int(words[0])] = words[1]
        file = self.folder / "blocks.npy"
        self.succeed("dump", "--area", "0,0,1,1", "--world", self.worlds / "World.sqlite", "-o", file)
        volume = list(Npy(file).volume())
        return lambda x, y, z: names[volume[(x * 16 + y) * 256 + z]]

    def look(self, display, player):
        """Goes to the next place, and waits until it is drawn."""
        self.press(player, "F6")
        player.settle()

    def mark(self, display, player):
        """Selects the box between the next two places."""
        self.look(display, player)
        self.click_here(display, player, 1)
        self.look(display, player)
        self.click_here(display, player, 3)

    def is_in_hand(self, block):
        chosen, *blocks = (self.setting("World", "hotbar") or "0").split()
        return int(chosen) < len(blocks) and blocks[int(chosen)] == block

    def take(self, player, name, block):
        """Takes a block from the palette into the hand."""
        player.press_once("Tab")
        player.type(name)
        player.settle()  # the typed text is drawn: a later change is the effect of Return
        player.press_once("Return")
        player.wait_for(lambda: self.is_in_hand(block))
        player.settle()

    def choose_slot(self, player, key, block):
        self.press(player, key)
        player.wait_for(lambda: self.is_in_hand(block))

    def build(self, display, player, button=3):
        display.xdotool("click", button)
        time.sleep(self.pause)
        player.settle()

    def make_world(self, display):
        player = self.open(display)
        player.choose()  # New world
        player.choose()  # Create
        player.wait_for(lambda: self.setting("World", "camera"))
        self.pause = player.pause_after("F1")
        player.tap(1, *building_test.MIDDLE, self.pause)  # captures the mouse
        player.press("m")  # through everything
        player.wait_for(lambda: self.setting("World", "movement") == "fast")
        return player

    def build_house(self, display, player):
        self.press(player, "b")
        self.mark(display, player)
        self.press(player, "3", "g")  # a floor of stone bricks
        self.mark(display, player)
        self.press(player, "4", "g", "b")  # a wall of glass
        for slot, block in (("5", "oak_stairs"), ("7", "oak_door"), ("8", "torch")):
            self.look(display, player)
            self.choose_slot(player, slot, block)
            self.build(display, player)
        self.look(display, player)
        self.take(player, "white lamp", "lamp_white")
        self.build(display, player)

    def build_pond(self, display, player):
        self.look(display, player)
        self.build(display, player, button=1)
        self.take(player, "water", "water")
        self.build(display, player)

    def undo_a_mistake(self, display, player):
        self.look(display, player)
        self.choose_slot(player, "2", "cobble")
        self.build(display, player)
        self.keep(display, player, "mistake")
        self.press(player, "ctrl+z")
        player.settle()

    def assert_all_is_there(self):
        there = self.there()
        self.assertEqual([there(*CORNERS[k]) for k in range(4)], ["stone_bricks"] * 2 + ["glass"] * 2)
        self.assertEqual([there(*spot, FLOOR + 1) for spot in (STAIRS, DOOR, TORCH, LAMP)],
                         ["oak_stairs", "oak_door", "torch", "lamp_white"])
        self.assertEqual(there(*DOOR, FLOOR + 2), "oak_door_top")
        self.assertEqual(there(*POND, FLOOR), "water")
        self.assertEqual(there(*MISTAKE, FLOOR + 1), "air")

    def test_a_house_and_a_pond(self):
        self.worlds.mkdir(exist_ok=True)
        (self.worlds / "bookmarks.txt").write_text("".join(place + "\n" for place in self.places()))
        with window_support.Display() as display:
            player = self.make_world(display)
            self.build_house(display, player)
            self.build_pond(display, player)
            self.undo_a_mistake(display, player)
            self.look(display, player)
            self.keep(display, player, "house")
            player.press("Escape")
            player.settle()
            player.press("q")
            self.assertEqual(player.process.wait(HANG_SECONDS), 0, player.output())
            self.assertNotRegex(player.output(), "error|warning")
            self.assert_all_is_there()

            player = self.open(display)
            player.choose()  # Continue
            player.wait_for(lambda: self.is_played("World"))
            player.settle()
            self.keep(display, player, "continued")
            player.process.kill()
            player.process.wait(HANG_SECONDS)
        self.assert_all_is_there()
        self.assertTrue(self.succeed("check", self.worlds / "World.sqlite").endswith("good\n"))


if __name__ == "__main__":
    window_support.main()
