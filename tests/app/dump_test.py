#!/usr/bin/env python3
"""Arrays of blocks, light and quads: dump. Usage: dump_test.py PROGRAM"""
import contextlib
import json
import os
import pathlib
import resource
import signal
import struct
import subprocess
import time

import support
from support import Npy, ProgramTest

FLAT = ("--generator", "flat")
LAND = ("--generator", "continents")  # 256 layers


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
        blocks = self.dump("blocks", "3,-2,5,0", *LAND)
        self.assertEqual(blocks.shape, (32, 32, 256))
        found = set(blocks.volume())
        self.assertLessEqual(found, set(self.ids().values()))
        self.assertGreater(len(found), 3)

    def test_an_area_is_made_of_its_chunks(self):
        both = self.dump("blocks", "3,7,5,8", *LAND)
        second = self.dump("blocks", "4,7,5,8", *LAND)
        for x, y in ((0, 0), (15, 15), (9, 4)):
            self.assertEqual(both.column(16 + x, y), second.column(x, y))

    # Areas are written in squares of 32 chunks.
    def test_an_area_of_several_squares(self):
        small = {pos: self.dump("blocks", "{0},{1},{2},{3}".format(*pos, pos[0] + 1, pos[1] + 1), *LAND)
                 for pos in ((-20, 5), (11, 5), (12, 5), (13, 6))}
        large = self.dump("blocks", "-20,5,14,7", *LAND)
        self.assertEqual(large.shape, (34 * 16, 32, 256))
        for (x, y), chunk in small.items():
            for block_x, block_y in ((0, 0), (15, 15), (3, 9)):
                self.assertEqual(large.column((x + 20) * 16 + block_x, (y - 5) * 16 + block_y), chunk.column(block_x, block_y))
        lights = self.dump("light", "-4,-30,-3,4", *LAND), self.dump("light", "-4,1,-3,3", *LAND)
        for x, y in ((0, 0), (15, 31), (8, 16)):
            self.assertEqual(lights[0].column(x, 31 * 16 + y), lights[1].column(x, y), "across the end of a square")

    # Quads of several squares, one per chunk.
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
        """Runs with a limit on file sizes, which acts like a full disk."""
        def bound():
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit_bytes, limit_bytes))
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        words = [support.program(), *map(str, arguments)]
        return subprocess.run(words, capture_output=True, text=True, timeout=support.HANG_SECONDS, preexec_fn=bound,
                              restore_signals=False, env=support.environment(), check=False)

    def test_a_full_disk_leaves_nothing(self):
        path = self.folder / "a.npy"
        for what, area, hint in (("blocks", "0,0,8,8", "8388736 bytes do not fit"), ("quads", "0,0,2,2", "cannot be written")):
            done = self.limited(8192, "dump", "--what", what, "--area", area, "-o", path, *LAND)
            self.assertRefused(done, what)
            self.assertIn(f"{path}: {hint}", done.stderr)
            self.assertEqual(list(self.folder.iterdir()), [], what)

    def writes(self, pid):
        """Whether a process has a file of this test's folder open, even an unlinked one."""
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
                time.sleep(0.01)
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
        blocks, light = self.dump("blocks", "0,0,1,1", *LAND), self.dump("light", "0,0,1,1", *LAND)
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
        quads = self.dump("quads", "0,0,2,2", *LAND)
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


if __name__ == "__main__":
    support.main()
