#!/usr/bin/env python3
"""The program and its commands that need no save, end to end. Usage: cli_test.py PROGRAM"""
import json
import re

import support
from support import Image, ProgramTest, run

COMMANDS = ("play", "render", "record", "flight-bench", "generate", "map", "dump", "check", "copy", "import", "export", "work", "serve", "history", "bots", "blocks", "packs", "info", "bench", "completion", "man")
FLAT = ("--generator", "flat")

# Light opacity and emission by name.
BLOCKS = {
    "air": (0, [0, 0, 0]), "stone": (15, [0, 0, 0]), "dirt": (15, [0, 0, 0]), "grass": (15, [0, 0, 0]),
    "sand": (15, [0, 0, 0]), "snow": (15, [0, 0, 0]), "glowing_ore": (15, [2, 1, 0]), "oak_log": (15, [0, 0, 0]),
    "oak_leaves": (3, [0, 0, 0]), "grass_tuft": (3, [0, 0, 0]), "blue_orchid": (3, [0, 0, 0]),
    "poppy": (3, [0, 0, 0]), "oxeye_daisy": (3, [0, 0, 0]), "wheat": (4, [0, 0, 0]),
    "red_mushroom": (2, [0, 0, 0]), "brown_mushroom": (2, [0, 0, 0]), "glowing_mushroom": (0, [5, 10, 8]),
    "cactus": (11, [0, 0, 0]), "lamp_white": (15, [15, 13, 13]), "lamp_red": (15, [15, 0, 0]),
    "lamp_green": (15, [0, 15, 0]), "lamp_blue": (15, [0, 0, 15]), "cyan_glass": (3, [0, 0, 0]),
    "water": (1, [0, 0, 0]), "chest": (15, [0, 0, 0]),
    "birch_log": (15, [0, 0, 0]), "birch_leaves": (3, [0, 0, 0]), "spruce_log": (15, [0, 0, 0]),
    "spruce_leaves": (3, [0, 0, 0]), "pine_log": (15, [0, 0, 0]), "pine_leaves": (3, [0, 0, 0]),
    "acacia_log": (15, [0, 0, 0]), "acacia_leaves": (3, [0, 0, 0]), "willow_log": (15, [0, 0, 0]),
    "willow_leaves": (3, [0, 0, 0]), "palm_log": (15, [0, 0, 0]), "palm_leaves": (3, [0, 0, 0]),
    "dead_log": (15, [0, 0, 0]), "moss": (15, [0, 0, 0]), "mossy_stone": (15, [0, 0, 0]),
    "gravel": (15, [0, 0, 0]), "clay": (15, [0, 0, 0]), "mud": (15, [0, 0, 0]), "ice": (15, [0, 0, 0]),
    "red_sand": (15, [0, 0, 0]), "sandstone": (15, [0, 0, 0]), "red_sandstone": (15, [0, 0, 0]),
    "terracotta": (15, [0, 0, 0]), "basalt": (15, [0, 0, 0]), "limestone": (15, [0, 0, 0]),
    "tall_grass": (3, [0, 0, 0]), "savanna_grass": (3, [0, 0, 0]), "fern": (3, [0, 0, 0]),
    "reeds": (3, [0, 0, 0]), "heather": (3, [0, 0, 0]), "bluebell": (3, [0, 0, 0]), "dead_bush": (2, [0, 0, 0]),
    "crystal": (0, [6, 8, 13]), "coral_red": (15, [0, 0, 0]), "coral_yellow": (15, [0, 0, 0]),
    "seagrass": (15, [0, 0, 0]), "mushroom_stem": (15, [0, 0, 0]), "mushroom_cap": (15, [0, 0, 0]),
}
NO_COLLISION = {"air", "grass_tuft", "blue_orchid", "poppy", "oxeye_daisy", "wheat", "red_mushroom",
                "brown_mushroom", "glowing_mushroom", "water",
                "tall_grass", "savanna_grass", "fern", "reeds", "heather", "bluebell", "dead_bush", "crystal"}
PLACED_ONLY = {"lamp_white", "lamp_red", "lamp_green", "lamp_blue", "cyan_glass", "chest"}


class Help(ProgramTest):
    def test_lists_every_command(self):
        text = self.succeed("--help")
        for command in COMMANDS:
            self.assertIn(f"\n  {command} ", text)

    def test_every_command_explains_itself(self):
        for command in COMMANDS:
            self.assertIn("Usage: terrane " + command, self.succeed(command, "--help"))

    def test_version(self):
        self.assertRegex(self.succeed("--version"), r"\A\d+\.\d+\.\d+\n\Z")


class FormerNames(ProgramTest):
    FLAGS = ("--for", "--better-texturing", "--atmosphere", "--position", "--aggregation", "--region-height")

    def test_they_work(self):
        place = (*FLAT, "--size", "64x36", "--view-distance", "2", "--samples", "1")
        self.succeed("fly", *place, "--for", "0.2", "--json")
        old, new = self.folder / "old.png", self.folder / "new.png"
        place = (*place, "--at", "8,8,100")
        self.succeed("render", *place, "--atmosphere", "off", "--better-texturing=off", "--aggregation", "lines",
                     "--region-height", "32", "--view", "aggregation", "-o", old)
        self.succeed("render", *place, "--distance-fog", "off", "--sharp-filtering", "off", "--merging", "lines",
                     "--mesh-section-height", "32", "--view", "merging", "-o", new)
        self.assertEqual(old.read_bytes(), new.read_bytes())

    def test_no_help_lists_hidden_options(self):
        texts = [self.succeed("--help"), self.succeed("man").replace("\\-", "-"), self.succeed("completion", "bash")]
        texts += [self.succeed(command, "--help") for command in COMMANDS]
        for text in texts:
            for name in (*self.FLAGS, "--known-edits", "--memory-copy", "aggregation"):
                self.assertNotRegex(text, rf"(?<![\w-]){name}(?![\w-])")
            # The name as a command: in lists, before its options, and as a title.
            self.assertNotRegex(text, r"(?m)^ *fly\b|'fly\b|\bterrane fly\b|flight-bench fly\b|\bfly flight-bench\b")


class Generate(ProgramTest):
    def digest(self, *arguments):
        text = self.succeed("generate", "--digest", "--backend", "cpu", *arguments)
        self.assertRegex(text, r"\A[0-9a-f]{32}\n\Z")
        return text

    def test_threads_and_repetition_change_nothing(self):
        first = self.digest("--radius", "4", "--threads", "1")
        self.assertEqual(self.digest("--radius", "4", "--threads", "2"), first)
        self.assertEqual(self.digest("--radius", "4", "--threads", "2"), first)

    def test_instruction_sets_change_nothing(self):
        first = self.digest("--radius", "2")
        targets = json.loads(self.succeed("info", "--json"))["simd"]
        self.assertGreater(len(targets), 0)
        for target in targets:
            self.assertEqual(self.digest("--radius", "2", "--simd", target), first, target)

    def test_the_digest_is_of_the_area(self):
        small = self.digest("--radius", "1")
        self.assertEqual(self.digest("--area", "-1,-1,2,2"), small)
        self.assertNotEqual(self.digest("--area", "-1,-1,2,3"), small)
        self.assertNotEqual(self.digest("--radius", "1", "--seed", "2"), small)
        self.assertNotEqual(self.digest("--radius", "1", *FLAT), small)

    def test_a_seed_may_be_a_text(self):
        for text in ("abc", "1.5", "0x10", "gr\u00fc\u00dfe und \u8272", "12 "):
            number = support.xxh64(text.encode(), 0)
            done = run("generate", "--digest", "--backend", "cpu", "--radius", "0", "--seed", text)
            self.assertEqual((done.returncode, done.stdout), (0, self.digest("--radius", "0", "--seed", number)), done.stderr)
            self.assertIn(f'terrane: the seed "{text}" is the number {number}\n', done.stderr)
        self.assertEqual(support.xxh64(b"abc", 0), 0x44BC2CF5AD770999)  # as xxh64sum prints it
        self.assertNotIn("the number", run("generate", "--digest", "--radius", "0", "--seed", "007").stderr)
        self.assertEqual(self.digest("--radius", "0", "--seed", "007"), self.digest("--radius", "0", "--seed", "7"))

    def test_a_save_keeps_the_number_of_a_seed(self):
        save, area = self.folder / "a.sqlite", ("--radius", "0", *FLAT)
        self.succeed("generate", "--world", save, *area, "--seed", "abc")
        self.assertEqual(json.loads(self.succeed("check", save, "--json"))["seed"], 0x44BC2CF5AD770999)
        for seed in ("abc", 0x44BC2CF5AD770999):
            self.succeed("generate", "--world", save, *area, "--seed", seed)
        done = run("generate", "--world", save, *area, "--seed", "abd")
        self.assertEqual(done.returncode, 2)
        self.assertIn(f"seed {0x44BC2CF5AD770999}, not {support.xxh64(b'abd', 0)}", done.stderr)

    def test_the_corners_of_the_world(self):
        low, high = -2**27, 2**27
        self.digest("--area", f"{low},{low},{low + 1},{low + 1}")
        self.digest("--area", f"{high - 1},{high - 1},{high},{high}")

    def test_json(self):
        text = self.succeed("generate", "--radius", "1", "--digest", "--json", "--threads", "2")
        self.assertEqual(text.count("\n"), 1)
        result = json.loads(text)
        self.assertEqual(set(result), {"chunks", "seconds", "chunks_per_second", "threads", "backend", "digest"})
        self.assertEqual((result["chunks"], result["threads"]), (9, 2))
        self.assertIn(result["backend"], ("cpu", "gpu"))
        self.assertAlmostEqual(result["chunks_per_second"] * result["seconds"], 9, delta=0.01)
        self.assertEqual(result["digest"] + "\n", self.digest("--radius", "1"))
        self.assertNotIn("digest", json.loads(self.succeed("generate", "--radius", "0", "--json")))

    def test_explain(self):
        text = self.succeed("generate", "--explain", "--area", "3,4,4,5", *FLAT)
        self.assertIn("pass 0", text)
        self.assertIn("chunk 3,4", text)
        layers = [line for line in text.splitlines() if ": layers: " in line]
        self.assertEqual(sum(int(n) for n in re.findall(r"(?:: |, )(\d+) [a-z]", layers[0])), 256)


class Map(ProgramTest):
    def test_one_pixel_a_block(self):
        path = self.folder / "map.png"
        self.succeed("map", "--radius", "1", "-o", path)
        image = Image(path)
        self.assertEqual((image.width, image.height), (48, 48))
        self.assertGreater(len(image.colors()), 1)

    def test_an_ending_may_be_written_large(self):
        path = self.folder / "MAP.PNG"
        self.succeed("map", *FLAT, "--radius", "0", "-o", path)
        self.assertEqual(Image(path).width, 16)

    def test_a_pixel_of_a_level_is_as_wide_as_its_columns(self):
        path = self.folder / "map.png"
        self.succeed("map", "--area", "-70,0,58,63", "--level", "6", "-o", path)
        image = Image(path)
        self.assertEqual((image.width, image.height), (48, 16), "three tiles over chunks -128 to 63")
        self.assertGreater(len(image.colors()), 3)


class Blocks(ProgramTest):
    def test_json_lists_every_block(self):
        blocks = {block["name"]: block for block in json.loads(self.succeed("blocks", "--json"))}
        self.assertLess(set(BLOCKS) | {"missing"}, set(blocks))
        for name in set(blocks) - set(BLOCKS):
            self.assertFalse(blocks[name]["generated"], name)
        self.assertEqual((blocks["oak_stairs"]["shape"], blocks["torch"]["emission"]), ("model", [14, 11, 6]))
        for name, (opacity, emission) in BLOCKS.items():
            block = blocks[name]
            self.assertEqual((block["opacity"], block["emission"]), (opacity, emission), name)
            self.assertEqual(block["collision"] == [], name in NO_COLLISION, name)
            self.assertEqual(not block["generated"], name in PLACED_ONLY, name)
            self.assertEqual(len(block["textures"]), 0 if name == "air" else 6, name)

    def test_ids_are_the_places_in_the_list(self):
        blocks = json.loads(self.succeed("blocks", "--json"))
        self.assertEqual([block["id"] for block in blocks], list(range(len(blocks))))
        self.assertEqual(blocks[0]["name"], "air")

    def test_text_names_every_block(self):
        text = self.succeed("blocks")
        for name in BLOCKS:
            self.assertIn(f" {name} ", text)


class Info(ProgramTest):
    def test_json(self):
        text = self.succeed("info", "--json")
        self.assertEqual(text.count("\n"), 1)
        info = json.loads(text)
        self.assertLessEqual({"version", "processors", "simd", "generators", "graphics"}, set(info))
        self.assertLessEqual({"overworld", "continents", "flat"}, set(info["generators"]))
        self.assertGreaterEqual(info["processors"], 1)
        self.assertTrue(info["graphics"]["version"].startswith("4."))
        self.assertGreaterEqual(info["graphics"]["max_samples"], 4)

    def test_text(self):
        self.assertIn("generators", self.succeed("info"))


if __name__ == "__main__":
    support.main()
