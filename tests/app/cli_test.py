#!/usr/bin/env python3
"""Every command of the program, end to end. Usage: cli_test.py PROGRAM"""
import contextlib
import fcntl
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import sqlite3
import struct
import subprocess
import time

import support
from support import Npy, Image, ProgramTest, run

COMMANDS = ("play", "render", "record", "flight-bench", "generate", "map", "dump", "check", "copy", "import", "export", "work", "serve", "history", "bots", "blocks", "packs", "info", "bench", "completion", "man")
FLAT = ("--generator", "flat")

# Name: opacity to light, emission. Of all blocks that the game starts with.
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

    def test_no_help_lists_them(self):
        texts = [self.succeed("--help"), self.succeed("man").replace("\\-", "-"), self.succeed("completion", "bash")]
        texts += [self.succeed(command, "--help") for command in COMMANDS]
        for text in texts:
            for name in (*self.FLAGS, "aggregation"):
                self.assertNotRegex(text, rf"(?<![\w-]){name}(?![\w-])")
            # As a command: in lists of them, before its options, and as a title.
            self.assertNotRegex(text, r"(?m)^ *fly\b|'fly\b|\bterrane fly\b|flight-bench fly\b|\bfly flight-bench\b")


class FlightBench(ProgramTest):
    def test_every_frame_has_a_line(self):
        table = self.folder / "flight.csv"
        done = run("flight-bench", *FLAT, "--size", "64x36", "--view-distance", "2", "--samples", "1", "--duration", "1",
                   "--look", "0,0", "--debug-gl", "-o", table)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [line.split(",") for line in table.read_text().splitlines()]
        self.assertEqual(rows[0][:5], ["time_s", "frame_ms", "follow_ms", "upload_ms", "draw_ms"])
        self.assertGreater(len(rows), 3)
        self.assertTrue(all(len(row) == len(rows[0]) for row in rows))
        for row in rows[1:]:
            whole, parts = float(row[1]), sum(map(float, row[2:5]))
            self.assertAlmostEqual(whole, parts, delta=0.5 + 0.5 * whole)
        frames, x = re.search(r"(\d+) frames to (-?\d+),8,120", done.stderr).groups()
        self.assertEqual(int(frames), len(rows) - 1)
        self.assertGreater(int(x), 20)  # 60 blocks a second, but long frames move no farther than a quarter of one

    def test_statistics_as_json(self):
        for backend in ("cpu", "gpu"):
            self.check_statistics(self.succeed("flight-bench", "--scene", "landscape", "--preset", "low", "--size", "64x36",
                                            "--duration", "2", "--horizon", "0", "--view-distance", "2", "--backend", backend, "--debug-gl", "--json"))

    def check_statistics(self, text):
        flight = json.loads(text)["flight"]
        self.assertGreaterEqual(flight["seconds_of_flight"], 2)
        self.assertGreater(flight["seconds_to_load"], 0)
        self.assertGreater(flight["frames"], 0)
        self.assertGreaterEqual(flight["slowest_frame_ms"], flight["frame_ms"])
        self.assertLessEqual(flight["of_these_by_loading"], flight["frames_over_twice_the_median"])
        seconds = flight["by_second"]
        self.assertGreater(sum(seconds["frames"]), flight["frames"])
        self.assertEqual(seconds["visible"][-1], 25)
        self.assertEqual(len({len(values) for values in seconds.values()}), 1)


class Render(ProgramTest):
    SMALL = ("--size", "64x36", "--view-distance", "2", "--samples", "1", "--horizon", "0")

    def render(self, name, *arguments):
        path = self.folder / name
        text = self.succeed("render", *arguments, *self.SMALL, "-o", path)
        image = Image(path)
        self.assertEqual((image.width, image.height), (64, 36))
        return image, text

    def test_scenes_are_drawn(self):
        for scene in ("ocean", "desert", "landscape", "cave"):
            image, text = self.render("scene.png", "--scene", scene, "--debug-gl")
            self.assertGreater(len(image.colors()), 20, scene)
            self.assertEqual(text, "")

    def test_land_goes_on_to_the_horizon(self):
        """Without an option, too."""
        place = ("render", "--scene", "landscape", "--preset", "low", "--debug-gl", "--size", "64x36", "--view-distance", "2")
        near, far = self.folder / "near.png", self.folder / "far.png"
        self.succeed(*place, "--horizon", "0", "-o", near)
        self.succeed(*place, "-o", far)
        self.assertNotEqual(Image(near).rows, Image(far).rows)

    def test_a_small_memory_budget_makes_the_view_shorter(self):
        draw = ("render", "--scene", "landscape", "--size", "64x36", "--preset", "low", "--t-junctions", "open", "--json",
                "--debug-gl")
        short, whole = self.folder / "short.png", self.folder / "whole.png"
        done = run(*draw, "--view-distance", "12", "--gpu-memory", "24", "-o", short)
        self.assertEqual(done.returncode, 0, done.stderr)
        result = json.loads(done.stdout)
        reached = result["view_distance"]
        self.assertLess(reached, 12)
        self.assertGreaterEqual(reached, 4)
        self.assertEqual(result["bytes"]["gpu_budget"], 24 << 20)
        self.assertLessEqual(result["bytes"]["gpu"], 24 << 20)
        told = [line for line in done.stderr.splitlines() if "--gpu-memory" in line]
        self.assertEqual(len(told), 1, done.stderr)
        self.assertIn(f"view distance {reached} in place of 12: 24 MiB", told[0])
        enough = run(*draw, "--view-distance", str(reached), "--horizon", "0", "-o", whole)
        self.assertNotIn("--gpu-memory", enough.stderr)
        self.assertEqual(json.loads(enough.stdout)["view_distance"], reached)
        self.assertEqual(Image(short).rows, Image(whole).rows)

    def test_json_tells_counts_and_times(self):
        _, text = self.render("a.png", "--scene", "landscape", "--json")
        self.assertEqual(text.count("\n"), 1)
        result = json.loads(text)
        self.assertEqual(result["file"], str(self.folder / "a.png"))
        self.assertGreaterEqual(result["chunks"], 49)
        for key in ("quads", "regions", "draw_commands"):
            self.assertGreater(result[key], 0, key)
        for key in ("opaque", "shadow"):
            self.assertGreater(result["triangles"][key], 0, key)
        self.assertEqual(result["triangles"]["opaque"] + result["triangles"]["transparent"], 2 * result["quads"])
        for key in ("set_up", "load", "draw", "all"):
            self.assertGreater(result["milliseconds"][key], 0, key)
        for key in ("blocks", "light", "light_gpu", "quads_gpu", "generator_cache", "process_peak"):
            self.assertGreater(result["bytes"][key], 0, key)
        for task in ("generate", "local light", "light", "mesh"):
            self.assertGreater(result["tasks"][task]["count"], 0, task)
            self.assertGreater(result["tasks"][task]["milliseconds"], 0, task)
        self.assertEqual(result["chunks_in_view"], 25)
        day = result["shadow_triangles_over_the_day"]
        self.assertEqual((day["time"][0], day["time"][20], day["time"][-1]), (0, 0.5, 1))
        self.assertEqual(len(day["time"]), len(day["triangles"]))
        self.assertGreater(len(set(day["triangles"])), 3)

    def test_the_image_does_not_depend_on_threads(self):
        one, _ = self.render("one.png", "--scene", "desert", "--threads", "1")
        two, _ = self.render("two.png", "--scene", "desert", "--threads", "2")
        self.assertEqual(one.rows, two.rows)

    def test_scenes_are_places_of_the_overworld(self):
        scene, _ = self.render("scene.png", "--scene", "ocean")
        named, _ = self.render("named.png", "--scene", "ocean", "--generator", "overworld")
        other, _ = self.render("other.png", "--scene", "ocean", "--generator", "flat")
        self.assertEqual(scene.rows, named.rows)
        self.assertNotEqual(scene.rows, other.rows)

    def test_merging_changes_the_count_of_triangles_only(self):
        scene = ("--scene", "landscape", "--json")
        quads = {}
        for method in ("none", "lines", "squares", "squares-ext", "greedy"):
            _, text = self.render("m.png", *scene, "--merging", method)
            quads[method] = json.loads(text)["quads"]
        self.assertLess(quads["greedy"], 0.92 * quads["squares-ext"])
        self.assertLess(quads["squares-ext"], quads["squares"])
        self.assertLess(max(quads["squares"], quads["lines"]), quads["none"])
        meshSections = [json.loads(self.render("r.png", *scene, "--mesh-section-height", height)[1])["regions"]
                   for height in ("8", "128")]
        self.assertGreater(meshSections[0], meshSections[1])

    def test_the_image_does_not_depend_on_the_back_end(self):
        for scene, samples in (("landscape", "1"), ("ocean", "4")):
            arguments = ("--scene", scene, "--size", "160x90", "--view-distance", "4", "--preset", "medium", "--samples",
                         samples, "--debug-gl")
            for backend in ("cpu", "gpu"):
                self.succeed("render", *arguments, "--backend", backend, "-o", self.folder / (backend + ".png"))
            self.assertEqual(Image(self.folder / "cpu.png").rows, Image(self.folder / "gpu.png").rows, scene)

    def test_views_show_something_else(self):
        images = [self.render("v.png", "--scene", "landscape", "--view", view)[0].rows
                    for view in ("color", "normal", "depth", "merging", "light")]
        for k, image in enumerate(images):
            self.assertNotIn(image, images[:k])
        self.assertTrue(all(r == g == b for row in images[2] for r, g, b in row), "depth is grey")

    def test_presets_and_the_flags_that_change_them(self):
        scene = ("--scene", "landscape")
        low, _ = self.render("low.png", *scene, "--preset", "low")
        for preset in ("medium", "high", "ultra", "thesis"):
            self.assertTrue(self.render("a.png", *scene, "--preset", preset)[0].rows != low.rows, preset)
        self.assertEqual(self.render("a.png", *scene, "--preset", "low", "--shadows", "off")[0].rows, low.rows)
        for flag, word, look in (("--shading", "off", "136,-6"), ("--distance-fog", "off", "136,-6"),
                                 ("--god-rays", "on", "40,45"), ("--ssao", "raw", "136,-6"), ("--clouds", "on", "40,45")):
            plain, _ = self.render("b.png", *scene, "--preset", "low", "--look", look)
            changed, _ = self.render("c.png", *scene, "--preset", "low", "--look", look, flag, word)
            self.assertTrue(plain.rows != changed.rows, flag)

    def test_frames_are_measured(self):
        _, text = self.render("a.png", "--scene", "ocean", "--frames", "4", "--json", "--preset", "medium")
        result = json.loads(text)
        self.assertGreater(result["milliseconds"]["frame"], 0)
        self.assertGreater(result["milliseconds"]["frame_processor"], 0)
        for name in ("cull", "shadow map", "surfaces", "sky", "shade", "final"):
            self.assertIn(name, result["passes"])

    def test_place_direction_and_time_count(self):
        at = ("--at", "8.5,8.5,84", *FLAT)
        ahead, _ = self.render("a.png", *at)
        down, _ = self.render("b.png", *at, "--look", "0,-90")
        night, _ = self.render("c.png", *at, "--look", "0,-90", "--time", "0")
        self.assertNotEqual(ahead.rows, down.rows)
        red, green, blue = down.rows[18][32]
        self.assertTrue(green > red and green > blue, "grass below")
        self.assertLess(night.rows[18][32][1], green, "darker at night")

    def test_a_resource_pack_changes_the_faces_it_has(self):
        # Down on the flat world: nothing but the tops of grass is seen.
        view = (*FLAT, "--at", "8.5,8.5,100", "--look", "0,-90", "--time", "0.5", "--distance-fog", "off")
        before, _ = self.render("before.png", *view)
        pack = self.folder / "pack"
        pack.mkdir()
        other = self.folder / "other"
        other.mkdir()
        support.write_png(pack / "grass_top.png", 32, 32, (255, 0, 0, 255))
        support.write_png(other / "stone.png", 1, 1, (255, 0, 0, 255))
        red, _ = self.render("red.png", *view, "--resource-pack", pack)
        self.assertTrue(all(r > 2 * g and r > 2 * b for row in red.rows for r, g, b in row))
        same, _ = self.render("same.png", *view, "--resource-pack", other)
        self.assertEqual(same.rows, before.rows)
        map_file = self.folder / "map.png"
        self.succeed("map", *FLAT, "--radius", "0", "--resource-pack", pack, "-o", map_file)
        self.assertTrue(all(r > 2 * g for r, g, _ in Image(map_file).colors()))

    def test_a_wrong_resource_pack_is_refused(self):
        support.write_png(self.folder / "stone.png", 16, 24, (255, 0, 0, 255))
        done = run("render", "--scene", "ocean", *self.SMALL, "--resource-pack", self.folder, "-o", self.folder / "a.png")
        self.assertRefused(done, "16 × 24")
        self.assertIn("stone.png: 16 × 24 pixels", done.stderr)
        self.assertFalse((self.folder / "a.png").exists())

    def test_more_samples(self):
        path = self.folder / "a.png"
        self.succeed("render", "--scene", "cave", "--size", "40x30", "--view-distance", "1", "--samples", "4", "-o", path)
        self.assertEqual(Image(path).width, 40)


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


class Dump(ProgramTest):
    def dump(self, what, area, *arguments):
        path = self.folder / f"{what}.npy"
        self.assertEqual(self.succeed("dump", "--what", what, "--area", area, "-o", path, *arguments), "")
        return Npy(path)

    def ids(self):
        return {block["name"]: block["id"] for block in json.loads(self.succeed("blocks", "--json"))}

    def test_blocks_of_the_flat_world(self):
        ids = self.ids()
        blocks = self.dump("blocks", "-1,0,1,3", *FLAT)
        self.assertEqual((blocks.descr, blocks.shape), ("<u2", (32, 48, 256)))
        expected = [ids["stone"]] * 77 + [ids["dirt"]] * 3 + [ids["grass"]] + [ids["air"]] * (256 - 81)
        for x, y in ((0, 0), (31, 47), (5, 20)):
            self.assertEqual(blocks.column(x, y), expected)
        self.assertEqual(sum(blocks.volume()), 32 * 48 * sum(expected))

    def test_blocks_of_the_land_are_known(self):
        blocks = self.dump("blocks", "3,-2,5,0")
        self.assertEqual(blocks.shape, (32, 32, 256))
        found = set(blocks.volume())
        self.assertLessEqual(found, set(self.ids().values()))
        self.assertGreater(len(found), 3)

    def test_an_area_is_made_of_its_chunks(self):
        both = self.dump("blocks", "3,7,5,8")
        second = self.dump("blocks", "4,7,5,8")
        for x, y in ((0, 0), (15, 15), (9, 4)):
            self.assertEqual(both.column(16 + x, y), second.column(x, y))

    # Areas are written in squares of 32 chunks.
    def test_an_area_of_several_squares(self):
        small = {pos: self.dump("blocks", "{0},{1},{2},{3}".format(*pos, pos[0] + 1, pos[1] + 1))
                 for pos in ((-20, 5), (11, 5), (12, 5), (13, 6))}
        large = self.dump("blocks", "-20,5,14,7")
        self.assertEqual(large.shape, (34 * 16, 32, 256))
        for (x, y), chunk in small.items():
            for block_x, block_y in ((0, 0), (15, 15), (3, 9)):
                self.assertEqual(large.column((x + 20) * 16 + block_x, (y - 5) * 16 + block_y), chunk.column(block_x, block_y))
        lights = self.dump("light", "-4,-30,-3,4"), self.dump("light", "-4,1,-3,3")
        for x, y in ((0, 0), (15, 31), (8, 16)):
            self.assertEqual(lights[0].column(x, 31 * 16 + y), lights[1].column(x, y), "across the end of a square")

    # One quad a chunk: 65 x 64 chunks are more than an area could have when it was held in memory.
    def test_an_area_may_be_large(self):
        quads = self.dump("quads", "-3,-2,62,62", *FLAT)
        self.assertEqual(quads.shape, (65 * 64,))
        found = {struct.unpack_from("<ii", quads.data, k * 19) for k in range(65 * 64)}
        self.assertEqual(found, {(x, y) for x in range(-3, 62) for y in range(-2, 62)})

    def test_memory_does_not_grow_with_the_area(self):
        def peak(area):
            words = ("dump", "--area", area, *FLAT, "--threads", "2", "-o", self.folder / "blocks.npy")
            child = subprocess.Popen([support.program(), *map(str, words)], stderr=subprocess.DEVNULL,
                                     env=support.environment())
            _, status, used = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
            self.assertEqual(child.returncode, 0, area)
            return used.ru_maxrss
        small, large = peak("0,0,1,1"), peak("0,0,33,33")
        self.assertEqual((self.folder / "blocks.npy").stat().st_size, 128 + 33 * 33 * 131072)
        self.assertLess(large - small, 64 << 10, "KiB more; the file has 136 MiB")

    def limited(self, limit_bytes, *arguments):
        """Runs where no file may grow larger, as on a full disk."""
        def bound():
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit_bytes, limit_bytes))
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        words = [support.program(), *map(str, arguments)]
        return subprocess.run(words, capture_output=True, text=True, timeout=support.HANG_SECONDS, preexec_fn=bound,
                              restore_signals=False, env=support.environment(), check=False)

    def test_a_full_disk_leaves_nothing(self):
        path = self.folder / "a.npy"
        for what, area, hint in (("blocks", "0,0,8,8", "8388736 bytes do not fit"), ("quads", "0,0,2,2", "cannot be written")):
            done = self.limited(8192, "dump", "--what", what, "--area", area, "-o", path)
            self.assertRefused(done, what)
            self.assertIn(f"{path}: {hint}", done.stderr)
            self.assertEqual(list(self.folder.iterdir()), [], what)

    def writes(self, pid):
        """Whether a process has a file of this test's folder open, be it one without a name."""
        opened = []
        for link in pathlib.Path(f"/proc/{pid}/fd").iterdir():
            with contextlib.suppress(FileNotFoundError):  # closed meanwhile
                opened.append(os.readlink(link))
        return any(name.startswith(f"{self.folder}/") for name in opened)

    def test_stopped_it_leaves_nothing(self):
        path = self.folder / "a.npy"
        words = ("dump", "--what", "quads", "--area", "0,0,100000,100000", *FLAT, "--threads", "1", "-o", path)
        child = subprocess.Popen([support.program(), *map(str, words)], stderr=subprocess.PIPE, text=True,
                                 env=support.environment())
        self.addCleanup(child.kill)
        with child.stderr:
            deadline = time.monotonic() + support.HANG_SECONDS
            while not self.writes(child.pid):
                self.assertIsNone(child.poll())
                self.assertLess(time.monotonic(), deadline, "it opens no file")
            child.send_signal(signal.SIGTERM)
            said = child.stderr.read()
        self.assertEqual(child.wait(support.HANG_SECONDS), 2, said)
        self.assertRegex(said, r"stopped after \d+ of 10000000000 chunks\n")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_light_of_the_flat_world(self):
        light = self.dump("light", "0,0,2,1", *FLAT)
        self.assertEqual((light.descr, light.shape), ("<u2", (32, 16, 256)))
        for x, y in ((0, 0), (31, 15)):
            column = light.column(x, y)
            self.assertEqual([value >> 12 for value in column], [0] * 81 + [15] * 175)
            self.assertEqual({value & 0xFFF for value in column}, {0}, "nothing shines")

    def test_light_of_the_land_is_dark_in_stone(self):
        stone = self.ids()["stone"]
        blocks, light = self.dump("blocks", "0,0,1,1"), self.dump("light", "0,0,1,1")
        for block, level in zip(blocks.volume(), light.volume()):
            if block == stone:
                self.assertEqual(level >> 12, 0)
        self.assertEqual({light.column(x, 3)[255] >> 12 for x in range(16)}, {15})

    def test_light_is_the_same_on_both_back_ends(self):
        cpu = self.dump("light", "7,-3,10,-1", "--backend", "cpu")
        gpu = self.dump("light", "7,-3,10,-1", "--backend", "gpu")
        self.assertEqual(cpu.data, gpu.data)

    def test_quads_of_the_flat_world(self):
        quads = self.dump("quads", "-3,5,-1,6", *FLAT)
        names = [name for name, _ in quads.descr]
        self.assertEqual(names, ["chunk_x", "chunk_y", "x", "y", "z", "shape_face", "extent_u", "extent_v", "material",
                                 "context", "group"])
        record = struct.Struct("<ii3BH2BH2B")
        self.assertEqual("".join(kind for _, kind in quads.descr), "<i4" * 2 + "|u1" * 3 + "<u2" + "|u1" * 2 + "<u2" + "|u1" * 2)
        self.assertEqual(len(quads.data), quads.shape[0] * record.size)
        values = [record.unpack_from(quads.data, k * record.size) for k in range(quads.shape[0])]
        material = values[0][8]
        top = (0, 0, 80, 5, 16, 16, material, 0, 5)  # the grass: a square of 16 × 16 that looks up
        self.assertEqual(values, [(-3, 5, *top), (-2, 5, *top)])

    def test_quads_of_the_land(self):
        quads = self.dump("quads", "0,0,2,2")
        self.assertGreater(quads.shape[0], 500)
        for k in range(quads.shape[0]):
            chunk_x, chunk_y, x, y, z, face, u, v, _, context, group = struct.unpack_from("<ii3BH2BH2B", quads.data, k * 19)
            self.assertTrue(0 <= chunk_x < 2 and 0 <= chunk_y < 2 and x < 16 and y < 16 and z < 256)
            self.assertTrue(face < 21 and 1 <= u <= 16 and 1 <= v <= 16 and context < 6 and group < 7)

    def test_quads_are_the_same_on_both_back_ends(self):
        cpu = self.dump("quads", "7,-3,10,-1", "--backend", "cpu")
        gpu = self.dump("quads", "7,-3,10,-1", "--backend", "gpu")
        self.assertEqual(cpu.data, gpu.data)

    def test_every_merge_method_has_the_same_quads_on_both_back_ends(self):
        counts = {}
        for method in ("none", "lines", "squares", "squares-ext", "greedy"):
            arguments = ("7,-3,9,-2", "--merging", method, "--mesh-section-height", "16")
            cpu = self.dump("quads", *arguments, "--backend", "cpu")
            gpu = self.dump("quads", *arguments, "--backend", "gpu")
            self.assertEqual(cpu.data, gpu.data, method)
            counts[method] = cpu.shape[0]
        self.assertGreater(counts["none"], counts["squares"])
        self.assertGreater(counts["squares"], counts["squares-ext"])
        self.assertGreater(counts["squares-ext"], counts["greedy"])
        self.assertGreater(counts["none"], counts["lines"])


class Saves(ProgramTest):
    """generate, dump and check with a save."""

    def setUp(self):
        super().setUp()
        self.save = self.folder / "a.sqlite"

    def generate(self, *arguments):
        text = self.succeed("generate", "--backend", "cpu", "--json", "--digest", *arguments)
        return json.loads(text)

    def sql(self, text):
        with sqlite3.connect(self.save) as database:
            rows = database.execute(text).fetchall()
            if not text.startswith("SELECT"):  # the program finds the checksum
                database.execute("UPDATE settings SET value = '' WHERE name = 'checksum'")
        database.close()
        return rows

    def mark_as_edited(self, key):
        with sqlite3.connect(self.save) as database:
            data = database.execute("SELECT data FROM chunks WHERE key = ?", (key,)).fetchone()[0]
            database.execute("UPDATE chunks SET origin = 1, data = ? WHERE key = ?", (support.seal(data, key, 1), key))
        database.close()

    def test_only_what_is_missing_is_generated(self):
        first = self.generate("--world", self.save, "--seed", "5", "--radius", "1")
        self.assertEqual((first["chunks"], first["skipped"]), (9, 0))
        again = self.generate("--world", self.save, "--radius", "1")
        self.assertEqual((again["chunks"], again["skipped"], again["digest"]), (0, 9, first["digest"]))
        more = self.generate("--world", self.save, "--radius", "2")
        self.assertEqual((more["chunks"], more["skipped"]), (16, 9))
        self.assertEqual(more["digest"], self.generate("--seed", "5", "--radius", "2")["digest"])

    def test_another_world_is_refused(self):
        self.generate("--world", self.save, "--seed", "5", "--radius", "0")
        before = self.save.read_bytes()
        for arguments, hint in ((("--seed", "6"), "seed 5, not 6"), (FLAT, "generator continents, not flat")):
            for more in ((), ("--recreate",)):
                done = run("generate", "--world", self.save, "--radius", "0", *arguments, *more)
                self.assertRefused(done, (arguments, more))
                self.assertIn(hint, done.stderr)
        self.assertEqual(self.save.read_bytes(), before)
        self.assertFalse((self.folder / "a.backup-1.sqlite").exists())

    def test_recreate_keeps_the_generator_that_made_the_world(self):
        first = self.generate("--world", self.save, "--radius", "1", *FLAT)
        anew = self.generate("--world", self.save, "--radius", "1", "--recreate")
        self.assertEqual((anew["skipped"], anew["digest"]), (0, first["digest"]))
        self.sql("UPDATE settings SET value = 'gone' WHERE name = 'generator'")
        done = run("generate", "--world", self.save, "--radius", "1", "--recreate")
        self.assertRefused(done, "a generator of another program")
        self.assertIn("made by the generator gone, which this program does not have", done.stderr)

    def test_another_version_of_the_generator_is_refused_and_recreate_makes_it_anew(self):
        self.generate("--world", self.save, "--radius", "1", "--seed", "5")
        self.sql("UPDATE settings SET value = '99' WHERE name = 'generator_version'")
        done = run("generate", "--world", self.save, "--radius", "1")
        self.assertRefused(done, "version")
        self.assertIn("version 99", done.stderr)
        anew = self.generate("--world", self.save, "--radius", "1", "--recreate")
        self.assertEqual((anew["chunks"], anew["skipped"]), (9, 0))
        self.assertEqual(self.sql("SELECT value FROM settings WHERE name = 'seed'"), [("5",)])
        self.assertTrue((self.folder / "a.backup-1.sqlite").exists())

    def test_chunks_with_edits_stay_where_the_generator_has_changed(self):
        self.generate("--world", self.save, "--radius", "1", "--seed", "5")
        self.sql("UPDATE settings SET value = '99' WHERE name = 'generator_version'")
        key = 2**27 << 28 | 2**27
        self.mark_as_edited(key)
        kept = self.sql(f"SELECT data FROM chunks WHERE key = {key}")
        anew = self.generate("--world", self.save, "--radius", "1", "--regenerate", "keep-edits")
        self.assertEqual((anew["chunks"], anew["skipped"]), (8, 1))
        self.assertEqual(self.sql(f"SELECT data FROM chunks WHERE key = {key}"), kept)
        self.assertTrue((self.folder / "a.backup-1.sqlite").exists())
        for arguments in (("--regenerate", "all"), ("--recreate", "--regenerate", "keep-edits")):
            self.assertRefused(run("generate", "--world", self.save, "--radius", "1", *arguments), arguments)

    def test_a_world_without_generated_chunks(self):
        fly = ("flight-bench", "--at", "8,8,120", "--world", self.save, "--horizon", "0", "--view-distance", "1", "--size", "32x18", "--preset",
               "low", "--duration", "0.1", "--json")
        self.succeed(*fly, "--store-generated", "off")
        self.succeed(*fly)
        self.assertEqual(self.sql("SELECT count(*) FROM chunks"), [(0,)], "the world keeps it")
        self.succeed(*fly, "--store-generated", "on")
        self.assertGreater(self.sql("SELECT count(*) FROM chunks")[0][0], 8)

    def test_dump_takes_what_the_save_has(self):
        self.succeed("generate", "--world", self.save, "--radius", "1", *FLAT)
        plain, saved = self.folder / "plain.npy", self.folder / "saved.npy"
        self.succeed("dump", "--area", "0,0,3,1", "-o", plain, *FLAT)
        self.succeed("dump", "--area", "0,0,3,1", "-o", saved, "--world", self.save)
        self.assertEqual(Npy(plain).data, Npy(saved).data, "two chunks are in the save, one is generated")
        # Another name for the same id shows that the blocks come from the save.
        self.sql("UPDATE blocks SET name = 'sand_' WHERE name = 'sand'")
        self.sql("UPDATE blocks SET name = 'sand' WHERE name = 'stone'")
        self.succeed("dump", "--area", "0,0,1,1", "-o", saved, "--world", self.save)
        ids = {block["name"]: block["id"] for block in json.loads(self.succeed("blocks", "--json"))}
        self.assertEqual(Npy(saved).column(3, 3)[0], ids["sand"])

    def test_map_and_record_show_what_the_save_has_and_leave_it_as_it_is(self):
        self.succeed("generate", "--world", self.save, "--radius", "2", *FLAT)
        plain, drawn = self.folder / "plain.png", self.folder / "drawn.png"
        area = ("--area", "-1,-1,2,2")
        self.succeed("map", *area, "-o", plain, *FLAT)
        self.succeed("map", *area, "-o", drawn, "--world", self.save)
        self.assertEqual(plain.read_bytes(), drawn.read_bytes(), "the save has the generator, too")
        middle = (2**27 << 28) + 2**27  # chunk 0,0: what nobody edited is as generated
        self.edit_chunk(middle, self.sql(f"SELECT data FROM chunks WHERE key = {middle}")[0][0])
        self.sql("UPDATE blocks SET name = 'sand_' WHERE name = 'sand'")
        self.sql("UPDATE blocks SET name = 'sand' WHERE name = 'grass'")
        before = self.save.read_bytes()
        self.succeed("map", *area, "-o", drawn, "--world", self.save)
        self.assertNotEqual(plain.read_bytes(), drawn.read_bytes(), "sand in place of grass")
        path = self.folder / "path.toml"
        path.write_text("[[shot]]\nseconds = 1\nkey = [{ at = [8, 8, 90], look = [0, -80] }]\n"
                        "edit = [{ at = [8, 8, 81], block = 'stone' }]\n")
        self.succeed("record", "--path", path, "--frames-dir", self.folder / "frames", "--size", "64x48", "--fps", "1",
                     "--view-distance", "1", "--preset", "low", "--world", self.save)
        self.assertEqual(self.save.read_bytes(), before)

    def edit_chunk(self, key, data):
        """Puts what an editor made into the save in place of a chunk."""
        with sqlite3.connect(self.save) as database:
            database.execute("INSERT OR REPLACE INTO chunks VALUES (?, 1, ?)", (key, support.seal(data, key, 1)))
        database.close()

    def test_a_map_shows_edits_and_generates_the_rest(self):
        land = self.folder / "land.sqlite"
        self.succeed("generate", "--world", land, "--area", "0,0,1,1", "--generator", "overworld")
        with sqlite3.connect(land) as database:
            hill = database.execute("SELECT data FROM chunks").fetchone()[0]
        database.close()
        self.succeed("generate", "--world", self.save, "--area", "0,0,1,1", *FLAT)
        self.edit_chunk((1 + 2**27 << 28) + 2**27, hill)  # chunk 1,0
        before = self.save.read_bytes()
        for level, size in (("0", 16), ("1", 8)):
            area = ("--area", "-2,-2,4,4", "--level", level)
            self.succeed("map", *area, *FLAT, "-o", self.folder / "plain.png")
            self.succeed("map", *area, "--world", self.save, "-o", self.folder / "edited.png")
            plain, edited = Image(self.folder / "plain.png").rows, Image(self.folder / "edited.png").rows
            changed = {(x // size, y // size) for y, row in enumerate(plain) for x, pixel in enumerate(row)
                       if edited[y][x] != pixel}
            places = {(3 - x, y - 2) for x, y in changed}  # north, -y, is up, and east, -x, to the right
            self.assertIn((1, 0), places)
            self.assertTrue(all(abs(x - 1) <= 1 and abs(y) <= 1 for x, y in places), "shade may reach a neighbor")
        self.assertEqual(self.save.read_bytes(), before)

    def run_here(self, *arguments):
        """Runs where worlds by name lie in the folder of the test."""
        variables = {**support.environment(), "XDG_DATA_HOME": str(self.folder)}
        return subprocess.run([support.program(), *map(str, arguments)], capture_output=True, text=True, cwd=self.folder,
                              timeout=support.HANG_SECONDS, env=variables, check=False)

    def test_a_world_has_a_name_a_file_or_a_url(self):
        area = ("--backend", "cpu", "--json", "--radius", "0")
        made = self.run_here("generate", *area, "--world", "home", "--seed", "5")
        self.assertEqual((made.returncode, json.loads(made.stdout)["chunks"]), (0, 1), made.stderr)
        (self.save,) = self.folder.glob("*/home.sqlite")
        for name in ("home", self.save, self.save.relative_to(self.folder)):
            again = self.run_here("generate", *area, "--world", name)
            self.assertEqual((again.returncode, json.loads(again.stdout)["skipped"]), (0, 1), again.stderr)
        self.assertTrue(self.run_here("check", "home").stdout.endswith("\ngood\n"))
        shutil.copy(self.save, self.folder / "b.sqlite")  # an ending makes it a file
        again = self.run_here("generate", *area, "--world", "b.sqlite")
        self.assertEqual((again.returncode, json.loads(again.stdout)["skipped"]), (0, 1), again.stderr)

    def test_databases_that_cannot_be_reached_are_told_without_their_password(self):
        url = "postgresql://me:secret@127.0.0.1:1/name"
        out = self.folder / "out.png"
        for command in (("generate", "--radius", "0"), ("map", "--radius", "0", "-o", out),
                        ("dump", "--area", "0,0,1,1", "-o", self.folder / "out.npy"), ("render", "--scene", "landscape", "-o", out),
                        ("flight-bench", "--json")):
            done = run(*command, "--world", url)
            self.assertRefused(done, command)
            self.assertIn("postgresql://127.0.0.1:1/name: cannot be reached", done.stderr)
            self.assertNotIn("secret", done.stderr)
        done = run("generate", "--radius", "0", "--world", "mysql://me:secret@host/name")
        self.assertRefused(done, "another kind of database")
        self.assertNotIn("secret", done.stderr)

    def test_save_game_is_the_old_name_of_world(self):
        area = ("--backend", "cpu", "--radius", "0", *FLAT)
        for flag in ("--save-game", "--world"):
            done = self.run_here("generate", *area, flag, "home")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(len(list(self.folder.glob("*/*.sqlite"))), 1)
        self.assertNotIn("--save-game", self.succeed("generate", "--help"))
        self.assertRefused(run("generate", *area, "--save-game", "a", "--world", "b"), "both")

    def test_render_leaves_a_save_as_it_is(self):
        out = self.folder / "out.png"
        view = ("render", "--at", "8,8,90", "-o", out, "--size", "32x24", "--view-distance", "1", "--preset", "low")
        done = run(*view, "--world", self.save)
        self.assertRefused(done, "there is none")
        self.succeed("generate", "--world", self.save, "--radius", "0", *FLAT)
        before = self.save.read_bytes()
        self.succeed(*view, "--world", self.save)  # most of what it draws is generated
        self.assertEqual(self.save.read_bytes(), before)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), sorted([out.name, self.save.name]))

    def test_check_good(self):
        self.generate("--world", self.save, "--radius", "1", "--seed", "5")
        self.assertTrue(self.succeed("check", self.save).endswith("\ngood\n"))
        report = json.loads(self.succeed("check", self.save, "--json"))
        self.assertEqual((report["damaged"], report["chunks"], report["seed"]), (False, 9, 5))
        self.assertEqual((report["format"], report["generator"]), (3, "continents"))

    def test_check_damaged(self):
        self.succeed("generate", "--world", self.save, "--radius", "1", *FLAT)
        self.sql("UPDATE chunks SET data = zeroblob(50) WHERE key = (SELECT min(key) FROM chunks)")
        done = run("check", self.save)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("damage: chunk -1,-1: the checksum is wrong\ndamaged\n", done.stdout)
        done = run("check", self.save, "--json")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(json.loads(done.stdout)["damaged_chunks"],
                         [{"x": -1, "y": -1, "level": 0, "problem": "the checksum is wrong"}])
        # Generating repairs it and keeps what was there.
        self.succeed("generate", "--world", self.save, "--radius", "1", *FLAT)
        report = json.loads(self.succeed("check", self.save, "--json"))
        self.assertEqual((report["damaged"], report["chunks"], report["quarantined"]), (False, 9, 1))
        self.assertEqual(self.sql("SELECT length(data) FROM quarantine"), [(50,)])

    def test_check_cut_off(self):
        self.succeed("generate", "--world", self.save, "--radius", "1", *FLAT)
        self.save.write_bytes(self.save.read_bytes()[:-1])
        done = run("check", self.save)
        self.assertEqual((done.returncode, done.stderr), (1, ""))
        self.assertIn("cut off", done.stdout)


class PlayedSaves(ProgramTest):
    """A save that another process has open to write."""

    def setUp(self):
        super().setUp()
        self.save = self.folder / "a.sqlite"
        self.succeed("generate", "--world", self.save, "--radius", "1", *FLAT)
        self.area = ("--area", "-2,-2,3,3")

    def look(self):
        """What each command writes: name, arguments."""
        return {"check": ("check", self.save),
                "dump": ("dump", *self.area, "--world", self.save, "-o", self.folder / "out.npy"),
                "map": ("map", *self.area, "--world", self.save, "-o", self.folder / "out.png"),
                "render": ("render", "--at", "8,8,90", "--look", "0,-60", "--size", "32x24", "--view-distance", "1",
                           "--preset", "low", "--world", self.save, "-o", self.folder / "out.png")}

    def hold_open(self):
        """Keeps the lock and a connection as the program does, with an edit that is in the log alone."""
        lock = open(f"{self.save}-lock", "w", encoding="ascii")
        self.addCleanup(lock.close)
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        lock.write(str(os.getpid()))
        lock.flush()
        database = sqlite3.connect(self.save)
        self.addCleanup(database.close)
        database.execute("PRAGMA journal_mode = WAL")
        database.execute("PRAGMA wal_autocheckpoint = 0")
        self.assertEqual(database.execute("PRAGMA wal_checkpoint(TRUNCATE)").fetchone()[0], 0)
        return database

    def files(self):
        """Not read by this process: that would end SQLite's locks."""
        names = [str(self.save), f"{self.save}-wal", f"{self.save}-lock"]
        return subprocess.run(["cksum", *names], capture_output=True, check=True).stdout

    def test_it_is_read_and_left_as_it_is(self):
        ids = {block["name"]: block["id"] for block in json.loads(self.succeed("blocks", "--json"))}
        key = 2**27 << 28 | 2**27
        database = self.hold_open()
        data = database.execute("SELECT data FROM chunks WHERE key = ?", (key,)).fetchone()[0]
        for kept in (None, "in the log"):
            if kept:
                with database:
                    database.execute("UPDATE chunks SET origin = 1, data = ? WHERE key = ?", (support.seal(data, key, 1), key))
            before = self.files()
            for name, words in self.look().items():
                done = run(*words)
                self.assertEqual(done.returncode, 0, (name, done.stderr))
                told = done.stdout + done.stderr
                self.assertEqual(told.count(f"open in another program (process {os.getpid()})"), 1, (name, told))
                if name == "check":
                    self.assertEqual(done.stderr, "")
                    self.assertIn(f"9 chunks, {1 if kept else 0} of them edited", done.stdout)
                    self.assertIn("without its log; nothing is changed", done.stdout)
                    self.assertTrue(done.stdout.endswith("\ngood\n"))
            self.assertEqual(self.files(), before)
            self.assertIs(json.loads(self.succeed("check", self.save, "--json"))["in_use"], True)
        self.assertEqual(Npy(self.folder / "out.npy").column(40, 40)[80], ids["grass"])
        for words in (("generate", "--radius", "1", "--world", self.save), ("flight-bench", "--world", self.save, "--json")):
            done = run(*words)
            self.assertRefused(done, "two would write")
            self.assertIn("open in another program", done.stderr)

    def test_one_that_is_being_made_or_migrated_is_refused(self):
        self.hold_open()
        (self.folder / "a.sqlite-journal").write_bytes(b"\xd9\xd5\x05\xf9" + bytes(600))
        for name, words in self.look().items():
            done = run(*words)
            self.assertRefused(done, name)
            self.assertIn("which is making or migrating it", done.stderr)

    def test_while_the_program_itself_flies_through_it(self):
        words = ("flight-bench", "--world", self.save, "--view-distance", "3", "--size", "32x18", "--preset", "low",
                 "--threads", "1", "--duration", "6", "--json")
        flight = subprocess.Popen([support.program(), *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  text=True, env=support.environment())
        self.addCleanup(flight.kill)
        chunks, in_use = [], 0
        look = self.look()
        while flight.poll() is None:
            done = run("check", self.save, "--json")
            self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
            report = json.loads(done.stdout)
            chunks.append(report["chunks"])
            in_use += report["in_use"]
            for name in ("dump", "map"):
                done = run(*look[name])
                self.assertEqual(done.returncode, 0, done.stderr)
        said = flight.communicate()[1]
        self.assertEqual(flight.returncode, 0, said)
        self.assertGreater(in_use, 0)
        self.assertEqual(chunks, sorted(chunks))
        self.assertGreater(json.loads(self.succeed("check", self.save, "--json"))["chunks"], 9)


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
