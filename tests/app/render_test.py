#!/usr/bin/env python3
"""Images and flights from the command line: render, flight-bench. Usage: render_test.py PROGRAM"""
import json
import os
import re
from unittest import mock

import support
from support import Image, ProgramTest, run

FLAT = ("--generator", "flat")


class FlightBench(ProgramTest):
    def test_every_frame_has_a_line(self):
        table = self.folder / "flight.csv"
        done = run("flight-bench", *FLAT, "--size", "64x36", "--view-distance", "2", "--samples", "1", "--duration", "1",
                   "--look", "0,0", "--debug-gl", "-o", table)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [line.split(",") for line in table.read_text().splitlines()]
        self.assertEqual(rows[0][:5], ["time_s", "frame_ms", "follow_ms", "upload_ms", "draw_ms"])
        self.assertGreater(len(rows), 1)
        self.assertTrue(all(len(row) == len(rows[0]) for row in rows))
        for row in rows[1:]:
            whole, parts = float(row[1]), sum(map(float, row[2:5]))
            self.assertLessEqual(parts, whole + 0.002)  # they are rounded
        frames, x = re.search(r"(\d+) frames to (-?\d+),8,120", done.stderr).groups()
        self.assertEqual(int(frames), len(rows) - 1)
        self.assertGreater(int(x), 20)  # 60 blocks per second; a long frame moves at most a quarter of that

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
        for scene in support.few(("ocean", "desert", "cave", "landscape"), 2):
            image, text = self.render("scene.png", "--scene", scene, "--debug-gl")
            self.assertGreater(len(image.colors()), 20, scene)
            self.assertEqual(text, "")

    def test_land_goes_on_to_the_horizon(self):
        """Also without an option."""
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
        self.assertIn(f"view distance {reached} instead of 12: 24 MiB", told[0])
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
        for method in support.few(("none", "squares", "squares-ext", "lines", "greedy"), 3):
            _, text = self.render("m.png", *scene, "--merging", method)
            quads[method] = json.loads(text)["quads"]
        self.assertLess(quads["greedy"], 0.92 * quads["squares-ext"])
        self.assertLess(quads["squares-ext"], quads["none"])
        if support.tests_all():
            self.assertLess(quads["squares-ext"], quads["squares"])
            self.assertLess(max(quads["squares"], quads["lines"]), quads["none"])
        meshSections = [json.loads(self.render("r.png", *scene, "--mesh-section-height", height)[1])["regions"]
                   for height in ("8", "128")]
        self.assertGreater(meshSections[0], meshSections[1])

    def test_the_image_does_not_depend_on_the_back_end(self):
        for scene, samples in support.few((("ocean", "4"), ("landscape", "1")), 1):
            arguments = ("--scene", scene, "--size", "160x90", "--view-distance", "4", "--preset", "medium", "--samples",
                         samples, "--debug-gl")
            for backend in ("cpu", "gpu"):
                self.succeed("render", *arguments, "--backend", backend, "-o", self.folder / (backend + ".png"))
            self.assertEqual(Image(self.folder / "cpu.png").rows, Image(self.folder / "gpu.png").rows, scene)

    def test_the_image_does_not_depend_on_the_way_of_drawing(self):
        """Nor on the driver's ability to read counts from a buffer."""
        arguments = ("--scene", "landscape", "--view-distance", "4", "--horizon", "128", "--preset", "medium", "--debug-gl")
        def draw(name, *more):
            self.assertEqual(self.succeed("render", *arguments, "--size", "160x90", *more, "-o", self.folder / name), "")
            return Image(self.folder / name).rows
        lists = draw("lists.png")
        self.assertEqual(lists, draw("indirect.png", "--draw", "indirect"))
        self.assertEqual(lists, draw("loop.png", "--draw", "loop"))
        with mock.patch.dict(os.environ, MESA_EXTENSION_OVERRIDE="-GL_ARB_indirect_parameters", MESA_GL_VERSION_OVERRIDE="4.5"):
            self.assertFalse(json.loads(self.succeed("info", "--json"))["graphics"]["indirect_counts"])
            self.assertEqual(lists, draw("whole.png"))

    def test_views_show_something_else(self):
        images = [self.render("v.png", "--scene", "landscape", "--view", view)[0].rows
                    for view in support.few(("color", "normal", "depth", "merging", "light"), 3)]
        for k, image in enumerate(images):
            self.assertNotIn(image, images[:k])
        self.assertTrue(all(r == g == b for row in images[len(images) // 2] for r, g, b in row), "depth is grey")

    def test_presets_and_the_flags_that_change_them(self):
        scene = ("--scene", "landscape")
        low, _ = self.render("low.png", *scene, "--preset", "low")
        for preset in support.few(("thesis", "medium", "high", "ultra"), 1):
            self.assertTrue(self.render("a.png", *scene, "--preset", preset)[0].rows != low.rows, preset)
        self.assertEqual(self.render("a.png", *scene, "--preset", "low", "--shadows", "off")[0].rows, low.rows)
        for flag, word, look in support.few((("--shading", "off", "136,-6"), ("--distance-fog", "off", "136,-6"),
                                             ("--god-rays", "on", "40,45"), ("--ssao", "raw", "136,-6"),
                                             ("--clouds", "on", "40,45")), 2):
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
        # Looks down on the flat world: only tops of grass are visible.
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

    def test_paths_are_traced_and_resumed(self):
        place = ("--renderer", "path", *FLAT, "--at", "8,8,84", "--look", "30,-20", "--size", "40x30", "--view-distance", "1",
                 "--horizon", "0")
        straight, resumed, samples = (self.folder / name for name in ("a.png", "b.png", "b.samples"))
        self.succeed("render", *place, "--samples", "3", "-o", straight)
        self.succeed("render", *place, "--samples", "1", "--threads", "1", "--resume", samples, "-o", resumed)
        self.assertNotEqual(Image(straight).rows, Image(resumed).rows)
        text = self.succeed("render", *place, "--samples", "3", "--resume", samples, "--json", "-o", resumed)
        self.assertEqual(json.loads(text)["traced_samples"], 2)
        self.assertEqual(Image(straight).rows, Image(resumed).rows)
        self.succeed("render", *place, "--samples", "2", "--denoise", "--lens", "0.5", "--focus", "4", "-o", resumed)
        self.assertNotEqual(Image(straight).rows, Image(resumed).rows)
        other = run("render", *place, "--time", "0.3", "--resume", samples, "-o", resumed)
        self.assertEqual(other.returncode, 2)
        self.assertIn("samples are of another image", other.stderr)


if __name__ == "__main__":
    support.main()
