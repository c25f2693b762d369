#!/usr/bin/env python3
"""The program and its commands that need no save, end to end. Usage: cli_test.py PROGRAM"""
import json
import pathlib
import re
import tomllib

import support
from support import Image, ProgramTest, run

COMMANDS = ("play", "render", "record", "flight-bench", "generate", "map", "dump", "check", "copy", "backup", "import", "export", "work", "serve", "history", "bots", "blocks", "packs", "info", "bench", "completion", "man")
FLAT = ("--generator", "flat")
BLOCKS_FILE = pathlib.Path(__file__).resolve().parents[2] / "assets" / "blocks.toml"


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

    def test_levels(self):
        levels = [self.digest("--radius", "1", "--level", level) for level in (0, 1, 5, 15)]
        self.assertEqual(levels[0], self.digest("--radius", "1"))
        self.assertEqual(len(set(levels)), 4)
        for level, digest in zip((1, 5, 15), levels[1:]):
            for options in (["--threads", "1"], ["--backend", "gpu"]):
                self.assertEqual(self.succeed("generate", "--digest", "--radius", "1", "--level", level, *options), digest)
        last = 2**27 >> 5
        self.digest("--level", "5", f"--area={-last},{last - 1},{1 - last},{last}")
        self.assertIn("chunk 3,4 of level 2", self.succeed("generate", "--explain", "--area", "3,4,4,5", "--level", "2", *FLAT))

    def test_levels_that_there_are_not(self):
        last = 2**27 >> 5
        for text, *arguments in (("--level", "--level", "16", "--radius", "0"), ("--level", "--level", "-1", "--radius", "0"),
                                 ("of level 5: outside of the world", "--level", "5", f"--area={last},0,{last + 1},1"),
                                 ("worlds store", "--level", "1", "--radius", "0", "--world", self.folder / "a.sqlite")):
            done = run("generate", "--digest", *arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(text, done.stderr)
        self.assertFalse((self.folder / "a.sqlite").exists())

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


def blocks_of(tables):
    """The tables of a file's blocks, each with the keys of the block that it is like."""
    blocks = {}
    for table in tables:
        keys = dict(blocks.get(table.get("like"), {}))
        if "texture" in table or "textures" in table:
            keys.pop("texture", None)
            keys.pop("textures", None)
        blocks[table["name"]] = keys | table
    return list(blocks.values())


def textures_of(entry):
    return {entry["texture"]} if "texture" in entry else set(entry["textures"].values())


class Blocks(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        file = tomllib.loads(BLOCKS_FILE.read_text())
        cls.in_file, cls.shapes = blocks_of(file["block"]), {shape["name"] for shape in file["shape"]}

    def test_json_lists_the_blocks_of_the_file_in_its_order(self):
        listed = json.loads(self.succeed("blocks", "--json"))
        names = [block["name"] for block in listed]
        self.assertEqual(names, ["air", *(block["name"] for block in self.in_file), "missing"])
        self.assertEqual([block["id"] for block in listed], list(range(len(listed))))
        for block, entry in zip(listed[1:-1], self.in_file):
            with self.subTest(block=block["name"]):
                self.assertEqual(block["opacity"], entry.get("opacity", 15))
                self.assertEqual(block["emission"], entry.get("emission", [0, 0, 0]))
                self.assertEqual(block["collision"] != [], entry.get("collides", True))
                self.assertEqual(block["generated"], entry.get("generated", True))
                self.assertEqual(block["shape"] == "model", entry["shape"] in self.shapes)
                self.assertEqual(len(block["textures"]), 6)
                self.assertLessEqual(set(block["textures"]), textures_of(entry))

    def test_air_has_nothing(self):
        air = json.loads(self.succeed("blocks", "--json"))[0]
        self.assertEqual((air["opacity"], air["emission"], air["collision"], air["textures"]), (0, [0, 0, 0], [], []))

    def test_text_names_every_block(self):
        text = self.succeed("blocks")
        for block in self.in_file:
            self.assertIn(f" {block['name']} ", text)


class Info(ProgramTest):
    def test_json(self):
        text = self.succeed("info", "--json")
        self.assertEqual(text.count("\n"), 1)
        info = json.loads(text)
        self.assertLessEqual({"version", "processors", "simd", "generators", "graphics"}, set(info))
        self.assertLessEqual({"overworld", "continents", "wilderness", "flat"}, set(info["generators"]))
        self.assertGreaterEqual(info["processors"], 1)
        self.assertTrue(info["graphics"]["version"].startswith("4."))
        self.assertGreaterEqual(info["graphics"]["max_samples"], 4)
        self.assertTrue(info["graphics"]["indirect_draws"], "the driver of the tests passes the check of drivers")
        self.assertIn(info["graphics"]["subpixel_bits"], range(4, 17))

    def test_text(self):
        self.assertIn("generators", self.succeed("info"))


if __name__ == "__main__":
    support.main()
