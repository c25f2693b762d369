#!/usr/bin/python3
"""Imports and exports files of other programs, and compares them with readers from npm.

Usage: formats_test.py PROGRAM NPM_FOLDER

npm fetches the packages of tests/formats/node into NPM_FOLDER. Without npm or a network the tests are
skipped with the reason (exit code 77). TERRANE_ALL_CHUNKS=1 compares all chunks of the region files of twelve versions, which
takes minutes; else a few chunks of six versions, which differ in the format or the names of blocks."""
import collections
import gzip
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys

import numpy

import support
from support import ProgramTest, run

NODE = pathlib.Path(__file__).parent.parent / "formats" / "node"
npm_folder = None

# Blocks that map to these names, whatever their properties.
SAME = {"air": "air", "cave_air": "air", "stone": "stone", "granite": "stone", "bedrock": "stone", "dirt": "dirt",
        "grass_block": "grass", "gravel": "gravel", "sand": "sand", "water": "water", "oak_log": "oak_log",
        "oak_leaves": "oak_leaves", "clay": "clay", "coal_ore": "stone", "iron_ore": "stone", "deepslate": "basalt"}

VERSIONS = ("1.8.9", "1.12.2", "1.13.2", "1.16", "1.18.2", "1.21.1")


def fetch_packages():
    """Returns the reason why the packages are missing, or None."""
    npm = shutil.which("npm")
    if not npm or not shutil.which("node"):
        return "npm and node are not installed"
    wanted = (NODE / "package-lock.json").read_text()
    mark = npm_folder / "installed.json"  # written last
    if not mark.exists() or mark.read_text() != wanted:
        npm_folder.mkdir(parents=True, exist_ok=True)
        for name in ("package.json", "package-lock.json"):
            shutil.copy(NODE / name, npm_folder)
        done = subprocess.run([npm, "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error"],
                              cwd=npm_folder, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            return f"npm ci failed: {done.stderr.strip()}"
        mark.write_text(wanted)
    for script in NODE.glob("*.js"):
        shutil.copy(script, npm_folder)
    return None


def node(script, *arguments):
    done = subprocess.run(["node", script, *map(str, arguments)], cwd=npm_folder, capture_output=True, text=True,
                          timeout=600, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{script}: {done.stderr}")
    return json.loads(done.stdout)


def fixtures(package):
    return npm_folder / "node_modules" / package / "test"


def glb_of(path):
    """The JSON of the file, and its binary part."""
    data = pathlib.Path(path).read_bytes()
    magic, version, size, length = struct.unpack_from("<4I", data)
    if (magic, version, size) != (0x46546C67, 2, len(data)):
        raise ValueError(f"{path}: not a whole .glb")
    return json.loads(data[20:20 + length]), data[28 + length:]


def triangles_of(path):
    """Corners of all triangles: positions, normals and texture coordinates."""
    head, binary = glb_of(path)
    corners = []
    for primitive in head["meshes"][0]["primitives"]:
        accessor = head["accessors"][primitive["attributes"]["POSITION"]]
        vertices = numpy.frombuffer(binary, "<f4", accessor["count"] * 8, accessor["byteOffset"]).reshape(-1, 8)
        accessor = head["accessors"][primitive["indices"]]
        first = head["bufferViews"][accessor["bufferView"]]["byteOffset"] + accessor["byteOffset"]
        corners.append(vertices[numpy.frombuffer(binary, "<u4", accessor["count"], first)])
    return numpy.concatenate(corners).reshape(-1, 3, 8)


class Minecraft(ProgramTest):
    def compare(self, version, region):
        numbers = re.findall(r"-?\d+", region.name)
        with region.open("rb") as file:
            offsets = struct.unpack(">1024I", file.read(4096))
        chunks = [(int(numbers[0]) * 32 + k % 32, int(numbers[1]) * 32 + k // 32) for k in range(1024) if offsets[k]]
        largest = max((k for k in range(1024) if offsets[k]), key=lambda k: offsets[k] & 255)
        x, z = int(numbers[0]) * 32 + largest % 32, int(numbers[1]) * 32 + largest // 32
        area = (x, z, x + 2, z + 2)
        if os.environ.get("TERRANE_ALL_CHUNKS"):
            area = (min(c[0] for c in chunks), min(c[1] for c in chunks), max(c[0] for c in chunks) + 1,
                    max(c[1] for c in chunks) + 1)
        folder = self.folder / version / "region"
        shutil.copytree(region.parent, folder)  # the reader opens files for writing
        expected = node("count_blocks.js", folder, version, *area)
        world, report = self.folder / f"{version}.sqlite", self.folder / f"{version}.json"
        done = run("import", "minecraft", region.parent.parent if region.parent.name == "region" else folder.parent,
                   "--world", world, "--generator", "flat", "--area", ",".join(map(str, area)), "--report", report)
        self.assertEqual(done.returncode, 0, done.stderr)
        counted = json.loads(report.read_text())
        self.assertEqual(counted["chunks"], expected["chunks"], version)
        self.assertEqual(counted["blocks"], expected["blocks"], version)
        self.assertEqual(counted["unknown"], {}, version)
        self.assertEqual(counted["damage_count"], 0, version)
        self.compare_places(world, expected["sample"], version)
        return sum(expected["blocks"].values()), expected["chunks"]

    def compare_places(self, world, sample, version):
        """Minecraft's x, y, z are our -x, z, y."""
        low = (-sample["x"] * 16 - 16, sample["z"] * 16)
        volume = self.folder / "sample.npy"
        self.succeed("export", "npy", "--world", world, "-o", volume, "--box",
                     f"{low[0]},{low[1]},0,{low[0] + 16},{low[1] + 16},256")
        names = json.loads((self.folder / "sample.npy.names.json").read_text())
        ours = numpy.load(volume)
        theirs = numpy.array(sample["blocks"]).reshape(-1, 16, 16)[:, :, ::-1]
        compared = 0
        for layer, blocks in enumerate(theirs):
            z = sample["minY"] + layer
            if not 0 <= z < 256:
                continue
            for number, name in enumerate(sample["names"]):
                wanted = SAME.get(name.removeprefix("minecraft:"))
                if wanted is None:
                    continue
                there = ours[z][blocks == number]
                self.assertTrue((there == names.index(wanted)).all(), f"{version}: {name} at height {z}")
                compared += there.size
        self.assertGreater(compared, 5000, version)

    def test_region_files_have_the_blocks_of_another_reader(self):
        regions = sorted(fixtures("prismarine-provider-anvil").glob("fixtures/*/*.mca"))
        self.assertEqual(len(regions), 12)
        if not os.environ.get("TERRANE_ALL_CHUNKS"):
            regions = [region for region in regions if region.parent.name in VERSIONS]
            self.assertEqual(len(regions), len(VERSIONS))
        for region in regions:
            blocks, chunks = self.compare(region.parent.name, region)
            print(f"  {region.parent.name}: {chunks} chunks, {blocks} blocks", file=sys.stderr)

    def test_a_second_run_skips_what_is_there(self):
        source = fixtures("prismarine-provider-anvil") / "fixtures" / "1.16" / "r.0.-1.mca"
        world, report = self.folder / "w.sqlite", self.folder / "r.json"
        arguments = ("import", "minecraft", source, "--world", world, "--generator", "flat", "--report", report)
        self.succeed(*arguments, "--area", "3,-11,6,-8")
        first = json.loads(report.read_text())
        self.succeed(*arguments, "--area", "3,-11,8,-8")
        second = json.loads(report.read_text())
        self.assertEqual(second["skipped"], first["chunks"])
        self.assertGreater(second["chunks"], 0)
        self.assertEqual(run("check", world).returncode, 0)
        self.succeed(*arguments, "--area", "3,-11,8,-8")
        self.assertEqual(json.loads(report.read_text())["chunks"], 0)

    def test_chunks_can_be_moved(self):
        source = fixtures("prismarine-provider-anvil") / "fixtures" / "1.18.2"
        here, there = self.folder / "here.sqlite", self.folder / "there.sqlite"
        area = ("--area", "1,1,4,4", "--generator", "flat")
        self.succeed("import", "minecraft", source, "--world", here, *area, "--shift", 64)
        self.succeed("import", "minecraft", source, "--world", there, *area, "--shift", 80, "--at", "-160,320")
        boxes = ("-64,16,0,-16,64,200", "-224,336,16,-176,384,216")
        volumes = []
        for world, box in zip((here, there), boxes):
            file = self.folder / "v.npy"
            self.succeed("export", "npy", "--world", world, f"--box={box}", "-o", file)
            volumes.append(numpy.load(file))
        self.assertTrue((volumes[0] == volumes[1]).all())
        self.assertGreater((volumes[0] != 0).mean(), 0.3)


class Damaged(ProgramTest):
    def import_region(self, data, *more, name="r.0.0.mca"):
        region = self.folder / name
        region.write_bytes(data)
        report = self.folder / "r.json"
        done = run("import", "minecraft", region, "--world", self.folder / "w.sqlite", "--generator", "flat", "--report",
                   report, *more)
        return done, json.loads(report.read_text()) if report.exists() else None

    def test_damage_is_left_out_and_told(self):
        data = bytearray((fixtures("prismarine-provider-anvil") / "fixtures" / "1.16" / "r.0.-1.mca").read_bytes())
        first = next(k for k in range(1024) if data[4 * k:4 * k + 4] != bytes(4))
        start = int.from_bytes(data[4 * first:4 * first + 3], "big") * 4096
        data[start + 4] = 4  # LZ4
        done, report = self.import_region(bytes(data), "--area", "0,-32,32,-9", name="r.0.-1.mca")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(report["damage_count"], 1)
        self.assertIn("LZ4", report["damaged"][0])
        self.assertIn("LZ4", done.stderr)
        self.assertGreater(report["chunks"], 3)

    def test_bytes_of_any_kind_end_with_a_line(self):
        for data in (b"", b"\0" * 5000, b"\xff" * 9000, bytes(range(256)) * 64):
            done, report = self.import_region(data)
            self.assertIn(done.returncode, (0, 1), done.stderr)
            self.assertEqual(report["chunks"], 0)
            (self.folder / "r.json").unlink()

    def test_what_is_wrong_is_told_before_a_world_is_made(self):
        nothing = self.folder / "nothing"
        world = self.folder / "w.sqlite"
        wrong = self.folder / "wrong.toml"
        wrong.write_text("[blocks]\nnope = ['stone']\n")
        bad = self.folder / "bad.vox"
        bad.write_bytes(b"VOX ")
        schem = self.folder / "bad.schem"
        schem.write_bytes(gzip.compress(b"\x0a\0\0\0"))
        for case in (("minecraft", nothing), ("minecraft", self.folder), ("minecraft", bad), ("nonsense", nothing),
                     ("minecraft", self.folder, "--at", "3,4"), ("minecraft", self.folder, "--at", "x"),
                     ("vox", bad, "--at", "0,0,0"), ("schem", schem, "--at", "0,0,0"), ("schem", nothing),
                     ("vox", bad, "--shift", 3), ("schem", schem, "--dimension", "end", "--at", "0,0,0"),
                     ("vox", bad, "--at", "0,0,0", "--mapping", wrong)):
            self.assertRefused(run("import", *case, "--world", world), case)
            self.assertFalse(world.exists(), case)
        self.assertRefused(run("import", "vox", bad, "-o", self.folder / "a.structure"), "bad")
        for case in (("glb",), ("glb", "--area", "0,0,1,1", "--box", "0,0,0,1,1,1"), ("glb", "--box", "0,0,0,1,1,300"),
                     ("glb", "--box", "0,0,5,1,1,5"), ("glb", "--box", "0,0,0,1"), ("schem", "--area", "0,0,1,1"),
                     ("glb", "--area", "0,0,1,1", "--bits", 16), ("nonsense", "--area", "0,0,1,1"),
                     ("glb", "--box", "0,0,250,4,4,256", "--generator", "flat")):
            self.assertRefused(run("export", *case, "-o", self.folder / "a.glb"), case)
            self.assertFalse((self.folder / "a.glb").exists(), case)


class Volumes(ProgramTest):
    def test_a_schematic_goes_in_and_comes_out(self):
        source = fixtures("prismarine-schematic") / "schematics" / "smallhouse1.schem"
        world, report = self.folder / "w.sqlite", self.folder / "r.json"
        self.succeed("import", "schem", source, "--world", world, "--generator", "flat", "--at=-7,5,90", "--report", report)
        before = node("read_file.js", "schem", source, "1.16.5")
        names = collections.Counter("minecraft:" + block.split("{")[0] for block in before["blocks"])
        counted = json.loads(report.read_text())
        self.assertEqual(counted["blocks"], dict(names))
        self.assertEqual(counted["unknown"], {})
        width, height, length = before["size"]
        copies = [self.folder / f"{k}.schem" for k in range(2)]
        box = f"--box=-7,5,90,{width - 7},{length + 5},{height + 90}"
        self.succeed("export", "schem", "--world", world, box, "-o", copies[0])
        after = node("read_file.js", "schem", copies[0], "1.20.1")
        self.assertEqual(after["size"], before["size"])
        # Blocks with an exact counterpart return at their position with their properties.
        compared = 0
        for old, new in zip(before["blocks"], after["blocks"]):
            name = old.split("{")[0]
            if name in ("stone_bricks", "air", "stone_brick_stairs", "oak_planks", "spruce_planks", "glass_pane"):
                self.assertEqual(new.split("{")[0], name)
                compared += 1
            if name.endswith("_stairs") and new.split("{")[0] == name:
                facing = [json.loads(block[len(name):])["facing"] for block in (old, new)]
                self.assertEqual(*facing)
        self.assertGreater(compared, 5000)
        # A second round gives the same bytes.
        again = self.folder / "again.sqlite"
        self.succeed("import", "schem", copies[0], "--world", again, "--generator", "flat", "--at", "100,100,20")
        self.succeed("export", "schem", "--world", again, "--box",
                     f"100,100,20,{width + 100},{length + 100},{height + 20}", "-o", copies[1])
        self.assertEqual(gzip.decompress(copies[0].read_bytes()), gzip.decompress(copies[1].read_bytes()))
        self.succeed("import", "schem", source, "-o", self.folder / "house.structure")
        self.assertTrue((self.folder / "house.structure").read_bytes().startswith(b"TerrStru"))

    def test_a_schematic_with_numbers_is_read(self):
        source = fixtures("prismarine-schematic") / "schematics" / "viking-house1.schematic"
        report = self.folder / "r.json"
        self.succeed("import", "schem", source, "-o", self.folder / "viking.structure", "--report", report)
        self.assertEqual(json.loads(report.read_text())["unknown"], {})

    def test_a_model_goes_in_and_comes_out(self):
        for name in ("deer", "extended"):
            source = fixtures("vox-reader") / f"{name}.vox"
            world, report = self.folder / f"{name}.sqlite", self.folder / "r.json"
            self.succeed("import", "vox", source, "--world", world, "--generator", "flat", "--at", "0,0,100", "--report", report)
            seen = node("read_file.js", "vox", source)
            counted = json.loads(report.read_text())
            voxels = sum(map(len, seen["voxels"]))
            if name == "deer":
                self.assertEqual(sum(counted["blocks"].values()), voxels)
                size = seen["sizes"][0]
                out = self.folder / "out.vox"
                self.succeed("export", "vox", "--world", world, "--box",
                             f"0,0,100,{size['x']},{size['y']},{size['z'] + 100}", "-o", out)
                again = node("read_file.js", "vox", out)
                places = [{(v["x"], v["y"], v["z"]) for v in file["voxels"][0]} for file in (seen, again)]
                self.assertEqual(*places)
            self.assertGreater(sum(counted["blocks"].values()), 100)

    def test_heights_are_those_of_the_blocks(self):
        for name, kind in (("h.png", "png-heights"), ("h.npy", "npy-heights"), ("b.npy", "npy")):
            self.succeed("export", kind, "--generator", "hills3d", "--area", "0,0,2,3", "-o", self.folder / name)
        heights, blocks = numpy.load(self.folder / "h.npy"), numpy.load(self.folder / "b.npy")
        names = json.loads((self.folder / "b.npy.names.json").read_text())
        self.assertEqual(blocks.shape, (256, 48, 32))
        self.assertEqual(heights.shape, (48, 32))
        passable = [names.index(n) for n in names if "grass_" in n or n in ("air", "poppy", "blue_orchid", "oxeye_daisy",
                                                                          "tall_grass", "fern")]
        solid = ~numpy.isin(blocks, passable)
        self.assertTrue((heights == 255 - solid[::-1].argmax(axis=0)).all())
        self.assertEqual([row[5] for row in png_rows(self.folder / "h.png")], list(heights[:, -6]))
        self.succeed("export", "png-heights", "--generator", "hills3d", "--area", "0,0,2,3", "--bits", 16, "-o",
                     self.folder / "h.png")
        self.assertEqual([row[5] for row in png_rows(self.folder / "h.png")], [257 * int(h) for h in heights[:, -6]])


def png_rows(path):
    """The rows of a gray PNG with filter type "Sub"."""
    import zlib
    data, at, packed = pathlib.Path(path).read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0] != zlib.crc32(kind + body):
            raise ValueError("a checksum is wrong")
        if kind == b"IHDR":
            width, height, bits = struct.unpack(">IIB", body[:9])
        if kind == b"IDAT":
            packed += body
        at += 12 + length
    step = bits // 8
    raw = numpy.frombuffer(zlib.decompress(packed), "u1").reshape(height, 1 + width * step)
    if not (raw[:, 0] == 1).all():
        raise ValueError("another filter")
    values = numpy.cumsum(raw[:, 1:].reshape(height, width, step), axis=1, dtype="u1")
    return (values[..., 0] if step == 1 else values[..., 0] * 256 + values[..., 1].astype("u4")).tolist()


class Glb(ProgramTest):
    def validated(self, path):
        report = node("read_file.js", "glb", path)
        self.assertEqual(report["issues"]["numErrors"], 0, report["issues"]["messages"][:3])
        self.assertEqual(report["issues"]["numWarnings"], 0, report["issues"]["messages"][:3])
        return report["info"]

    def test_the_validator_finds_no_error(self):
        path = self.folder / "a.glb"
        for options in (("--generator", "continents", "--area", "0,0,3,3"), ("--generator", "hills3d", "--box=-9,3,40,30,40,140")):
            self.succeed("export", "glb", *options, "-o", path)
            info = self.validated(path)
            self.assertGreater(info["totalTriangleCount"], 500)
            self.assertGreater(info["materialCount"], 2)

    def test_a_box_of_cubes_is_closed_and_faces_outward(self):
        path, blocks = self.folder / "a.glb", self.folder / "b.npy"
        box = ("--generator", "hills3d", "--box", "3,-15,30,40,12,90")  # no water
        self.succeed("export", "glb", *box, "-o", path)
        self.succeed("export", "npy", *box, "-o", blocks)
        names = json.loads((self.folder / "b.npy.names.json").read_text())
        volume = numpy.load(blocks)
        cubes = {names.index(n) for n in ("stone", "dirt", "grass", "sand")}
        plants = {names.index(n) for n in ("grass_tuft", "poppy", "oxeye_daisy")}
        self.assertLessEqual(set(numpy.unique(volume).tolist()), cubes | plants | {0})
        corners = triangles_of(path)
        places = corners[:, :, :3].astype("f8")
        normals = corners[:, :, 3:6]
        # Plants are single oblique planes.
        straight = (numpy.abs(normals[:, 0]).max(axis=1) > 0.99)
        across = numpy.cross(places[:, 1] - places[:, 0], places[:, 2] - places[:, 0])
        self.assertTrue((numpy.einsum("ij,ij->i", across, normals[:, 0]) > 0).all())
        signed = numpy.einsum("ij,ij->i", places[:, 0], numpy.cross(places[:, 1], places[:, 2]))[straight].sum() / 6
        self.assertAlmostEqual(signed, float(numpy.isin(volume, list(cubes)).sum()), places=3)
        # x stays, y is -z of the file, z is its y.
        low, high = places.min(axis=(0, 1)), places.max(axis=(0, 1))
        filled = numpy.argwhere(volume != 0)
        self.assertEqual((low[0], high[0]), (filled[:, 2].min(), filled[:, 2].max() + 1))
        self.assertEqual((-high[2], -low[2]), (filled[:, 1].min(), filled[:, 1].max() + 1))
        self.assertEqual(low[1], filled[:, 0].min())


if __name__ == "__main__":
    npm_folder = pathlib.Path(sys.argv.pop(2)).resolve()
    problem = fetch_packages()
    if problem:
        print(f"formats_test: skipped: {problem}", file=sys.stderr)
        sys.exit(77)
    support.main()
