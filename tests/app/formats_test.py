#!/usr/bin/python3
"""Imports and exports files of other programs, and compares them with readers from npm.

Usage: formats_test.py PROGRAM NPM_FOLDER

npm fetches the packages of tests/formats/node into NPM_FOLDER. Without npm or a network the tests are
skipped with the reason (exit code 77). TERRANE_ALL_CHUNKS=1 compares all chunks of the region files of twelve versions, which
takes minutes; else a few chunks of six versions, which differ in the format or the names of blocks."""
import collections
import gzip
import itertools
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import zlib

import numpy
import xxhash

import support
from support import ProgramTest, run

NODE = pathlib.Path(__file__).parent.parent / "formats" / "node"
npm_folder = None

# Blocks that map to these names, whatever their properties.
SAME = {"air": "air", "cave_air": "air", "stone": "stone", "granite": "stone", "bedrock": "stone", "dirt": "dirt",
        "grass_block": "grass", "gravel": "gravel", "sand": "sand", "water": "water", "oak_log": "oak_log",
        "oak_leaves": "oak_leaves", "clay": "clay", "coal_ore": "coal_ore", "iron_ore": "iron_ore", "deepslate": "basalt"}

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


def nbt(value):
    """The type and the bytes of a value as NBT: int is a 32-bit number, an array one of 64 bits."""
    if isinstance(value, numpy.ndarray):
        return 12, struct.pack(">i", value.size) + value.astype(">u8").tobytes()
    if isinstance(value, int):
        return 3, struct.pack(">i", value)
    if isinstance(value, bytes):
        return 7, struct.pack(">i", len(value)) + value
    if isinstance(value, str):
        return 8, struct.pack(">H", len(value)) + value.encode()
    if isinstance(value, list):
        parts = [nbt(part) for part in value]
        return 9, struct.pack(">Bi", parts[0][0] if parts else 0, len(value)) + b"".join(part[1] for part in parts)
    data = b""
    for name, part in value.items():
        kind, written = nbt(part)
        data += struct.pack(">BH", kind, len(name)) + name.encode() + written
    return 10, data + b"\0"


def nbt_file(compound, name=""):
    return b"\x0a" + struct.pack(">H", len(name)) + name.encode() + nbt(compound)[1]


def uniform_chunk(x, z, names):
    """A chunk of 1.18 and newer with sections of one block each, by Y."""
    sections = [{"Y": y, "block_states": {"palette": [{"Name": name}]}} for y, name in names.items()]
    return nbt_file({"DataVersion": 3465, "xPos": x, "zPos": z, "Status": "minecraft:full", "sections": sections})


def stone_chunk(x, z):
    return uniform_chunk(x, z, {0: "minecraft:stone"})


def packed_states(numbers, count):
    """Numbers below `count` in 64-bit words, as since 1.16: none lies in two words."""
    bits = max(4, (count - 1).bit_length())
    per_word = 64 // bits
    padded = numpy.zeros(-(-numbers.size // per_word) * per_word, "u8")
    padded[:numbers.size] = numbers
    shifts = numpy.arange(per_word, dtype="u8") * numpy.uint64(bits)
    return (padded.reshape(-1, per_word) << shifts).sum(axis=1, dtype="u8")


def palette_entry(state):
    """Of "minecraft:name[key=value,…]"."""
    name, properties = state[:-1].split("[")
    properties = dict(pair.split("=") for pair in properties.split(",")) if properties else {}
    return {"Name": name, "Properties": properties}


def mixed_chunk(x, z, section_numbers, chances, random):
    """A chunk with all that another reader expects: sections of one state and of many. `chances`: of states."""
    sections = []
    for y in section_numbers:
        size = random.choice([1, 1, 2, 16, 17, 100])
        palette = random.choice(list(chances), size, replace=False, p=list(chances.values()))
        blocks = {"palette": [palette_entry(state) for state in palette]}
        if len(palette) > 1:
            blocks["data"] = packed_states(random.integers(len(palette), size=4096), len(palette))
        sections.append({"Y": y, "block_states": blocks, "biomes": {"palette": ["minecraft:plains"]}})
    return nbt_file({"DataVersion": 3465, "xPos": x, "yPos": section_numbers[0], "zPos": z, "Status": "minecraft:full",
                     "LastUpdate": 0, "InhabitedTime": 0, "block_entities": [], "sections": sections})


def lz4_stream(data):
    """Of lz4-java, with blocks that are not compressed."""
    stream = b""
    for part in (data[:100], data[100:], b""):
        checksum = xxhash.xxh32(part, seed=0x9747b28c).intdigest() & 0xfffffff if part else 0
        stream += b"LZ4Block\x16" + struct.pack("<3I", len(part), len(part), checksum) + part
    return stream


def region_file(chunks, compression=2):
    """The bytes of a region file of chunks by number, x + 32 z."""
    table, sectors = bytearray(8192), b""
    for number, data in chunks.items():
        packed = {2: zlib.compress, 3: bytes, 4: lz4_stream}[compression](data)
        packed = struct.pack(">IB", len(packed) + 1, compression) + packed
        packed += bytes(-len(packed) % 4096)
        struct.pack_into(">I", table, number * 4, (len(table) + len(sectors)) // 4096 << 8 | len(packed) // 4096)
        sectors += packed
    return bytes(table) + sectors


def states_of(block):
    """All states of a block of minecraft-data, as in schematics."""
    values = []
    for state in block.get("states", []):
        there = state.get("values") or (["true", "false"] if state["type"] == "bool" else range(state["num_values"]))
        values.append([f"{state['name']}={str(value).lower()}" for value in there])
    for properties in itertools.product(*values):
        yield f"minecraft:{block['name']}[{','.join(properties)}]"


def sponge_schematic(names):
    """A schematic of version 2 with a block of each name, and air."""
    names = ["minecraft:air", *names]
    length = -(-len(names) // 256)
    data = bytearray()
    for number in range(256 * length):
        number = number if number < len(names) else 0
        while number >= 128:
            data.append(number & 127 | 128)
            number >>= 7
        data.append(number)
    return gzip.compress(nbt_file({"Version": 2, "Width": 256, "Height": 1, "Length": length, "BlockData": bytes(data),
                                   "Palette": {name: k for k, name in enumerate(names)}}, "Schematic"), 1)


def block_lists():
    """The blocks of all versions in minecraft-data: pairs of the version and its blocks."""
    data = npm_folder / "node_modules" / "minecraft-data" / "minecraft-data" / "data" / "pc"
    files = sorted(data.glob("*/blocks.json"))
    return [(file.parent.name, json.loads(file.read_text())) for file in files]


class Names(ProgramTest):
    def unknown_of(self, schematic):
        source, report = self.folder / "all.schem", self.folder / "r.json"
        source.write_bytes(schematic)
        self.succeed("import", "schem", source, "-o", self.folder / "all.structure", "--report", report)
        return json.loads(report.read_text())["unknown"]

    def test_every_state_of_every_version_has_a_block(self):
        versions = collections.defaultdict(set)  # by state
        for version, blocks in block_lists():
            for block in blocks:
                if "defaultState" in block:  # since 1.13
                    for state in states_of(block):
                        versions[state].add(version)
        self.assertGreater(len(set.union(*versions.values())), 20)
        self.assertGreater(len(versions), 20000)
        states, unknown = sorted(versions), collections.defaultdict(set)
        for first in range(0, len(states), 60000):
            for state in self.unknown_of(sponge_schematic(states[first:first + 60000])):
                for version in versions[state.replace("[]", "")] or versions[state + "[]"]:
                    unknown[version].add(state.split("[")[0])
        self.assertEqual({version: sorted(names) for version, names in unknown.items()}, {})
        print(f"  {len(states)} states of {len(set.union(*versions.values()))} versions", file=sys.stderr)

    def test_every_number_of_every_old_version_has_a_name(self):
        numbers = set()
        for version, blocks in block_lists():
            if "defaultState" in blocks[0] or version == "0.30c":
                continue
            for block in blocks:
                numbers.update((block["id"], variation["metadata"]) for variation in block.get("variations", []))
                numbers.add((block["id"], 0))
        self.assertGreater(len(numbers), 250)
        ids, data = (bytes(number[k] for number in sorted(numbers)) for k in range(2))
        self.assertEqual(self.unknown_of(gzip.compress(nbt_file(
            {"Width": len(ids), "Height": 1, "Length": 1, "Blocks": ids, "Data": data, "Materials": "Alpha"},
            "Schematic"))), {})


class Layouts(ProgramTest):
    """Folders of worlds of all versions."""

    OLD = {"overworld": "region", "nether": "DIM-1/region", "end": "DIM1/region"}
    NEW = {name: f"dimensions/minecraft/{folder}/region"
           for name, folder in (("overworld", "overworld"), ("nether", "the_nether"), ("end", "the_end"))}

    def put(self, folder, chunks, *more):
        path = self.folder / "Home" / folder / "r.0.0.mca"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(region_file({x: stone_chunk(x, 0) for x in range(chunks)}, *more) if chunks >= 0 else b"")
        return path

    def import_home(self, *more, source=None):
        world, report = self.folder / "w.sqlite", self.folder / "r.json"
        for path in (world, report):
            path.unlink(missing_ok=True)
        done = run("import", "minecraft", source or self.folder / "Home", "--world", world, "--generator", "flat",
                   "--report", report, *more)
        return done, json.loads(report.read_text())["chunks"] if report.exists() else None

    def assertImports(self, chunks, *more, source=None):
        done, imported = self.import_home(*more, source=source)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(imported, chunks)
        return done.stderr

    def assertNothing(self, *more, source=None):
        done, imported = self.import_home(*more, source=source)
        self.assertRefused(done, more)
        self.assertIsNone(imported)
        self.assertFalse((self.folder / "w.sqlite").exists(), "no world is made")
        return done.stderr

    def test_each_dimension_of_each_layout(self):
        for layout in (self.OLD, self.NEW):
            for chunks, (dimension, folder) in enumerate(layout.items(), 1):
                self.put(folder, chunks)
            for chunks, dimension in enumerate(layout, 1):
                self.assertImports(chunks, "--dimension", dimension)
            for chunks, folder in enumerate(layout.values(), 1):
                self.assertImports(chunks, source=self.folder / "Home" / folder)
            shutil.rmtree(self.folder / "Home")

    def test_the_layout_that_has_chunks_is_taken(self):
        for dimension in self.OLD:
            for stale, real in ((self.OLD, self.NEW), (self.NEW, self.OLD)):
                for empty in (-1, 0):  # an empty file, or one with an empty table
                    self.put(stale[dimension], empty)
                    self.put(real[dimension], 3)
                    self.assertNotIn("not imported", self.assertImports(3, "--dimension", dimension))
                    shutil.rmtree(self.folder / "Home")

    def test_of_two_layouts_the_newer_one_is_taken(self):
        self.put(self.OLD["overworld"], 2)
        self.put(self.NEW["overworld"], 4)
        self.assertRegex(self.assertImports(4), r"Home/region: also has chunks, of an older version; not imported")
        self.assertIn("--dimension overworld", self.assertNothing("--dimension", "nether"))

    def test_chunks_come_to_both_ends_of_the_world(self):
        """Minecraft's chunk 0 is the last one before --at."""
        self.put("region", 2)
        volumes = []
        for at, x, y in (("0,0", -32, 0), (f"{2**31},{2**31 - 16}", 2**31 - 32, 2**31 - 16),
                         (f"{32 - 2**31},{-2**31}", -2**31, -2**31)):
            self.assertImports(2, f"--at={at}")
            self.succeed("export", "npy", "--world", self.folder / "w.sqlite", f"--box={x},{y},0,{x + 32},{y + 16},256",
                         "-o", self.folder / "v.npy")
            volumes.append(numpy.load(self.folder / "v.npy"))
            self.assertTrue((volumes[-1] == volumes[0]).all(), at)
            self.assertEqual(len(numpy.unique(volumes[0])), 2)
        done, imported = self.import_home(f"--at={16 - 2**31},0")
        self.assertEqual((done.returncode, imported), (1, 1), done.stderr)
        self.assertIn("1 chunks or files could not be read", done.stderr)
        for at in (f"{2**31 + 16},0", f"0,{-2**31 - 16}", f"{2**31 - 8},0", "0.5,0"):
            self.assertIn("--at: expected multiples of 16 within the world", self.assertNothing(f"--at={at}"))

    def test_importing_nothing_is_an_error(self):
        self.assertIn("no such file or folder", self.assertNothing())
        (self.folder / "Home").mkdir()
        self.assertRegex(self.assertNothing(), "no chunks of the overworld.* in dimensions/minecraft/overworld/region, region, "
                         "the folder itself\n")
        file = self.put("region", 0)
        self.assertIn("no chunks of the overworld", self.assertNothing())
        self.assertIn("this region file has no chunks", self.assertNothing(source=file))
        self.put("DIM1/region", 1)
        self.assertIn("--dimension end", self.assertNothing())
        self.put("region", 5)
        self.assertIn("no chunks in --area", self.assertNothing("--area", "5,0,9,9"))
        self.assertImports(2, "--area", "3,0,9,9")
        # Chunks without blocks, and broken ones.
        empty = nbt_file({"DataVersion": 3465, "xPos": 0, "zPos": 0, "sections": []})
        for data, reason in ((empty, "0 chunks or files cannot be read, 1 chunks have no blocks"),
                             (b"no NBT", "1 chunks or files cannot be read, 0 chunks have no blocks")):
            file.write_bytes(region_file({0: data}))
            done, imported = self.import_home()
            self.assertEqual((done.returncode, imported), (2, 0), done.stderr)
            self.assertRegex(done.stderr, f"error: .*Home: nothing is imported: {reason}\n$")

    def test_each_compression(self):
        for compression in (2, 3, 4):
            self.put("region", 4, compression)
            self.assertImports(4)


class OtherFiles(ProgramTest):
    """Files that no import reads, or another one."""

    def assertNamed(self, kind, what, *hints):
        done = run("import", kind, what, "--world", self.folder / "w.sqlite",
                   *(() if kind == "minecraft" else ("--at", "0,0,0")))
        self.assertRefused(done, what)
        for hint in (str(what), *hints):
            self.assertIn(hint, done.stderr)
        self.assertFalse((self.folder / "w.sqlite").exists())

    def test_they_are_named(self):
        litematic = gzip.compress(nbt_file({"Metadata": {}, "Regions": {}}))
        for name, data, hint in (("island.schem", b"MTSM\0\x04\0\x01", "a schematic of Luanti"),
                                 ("Home.mcworld", b"PK\x03\x04", "Bedrock Edition"),
                                 ("house.litematic", litematic, "Litematica"), ("a.glb", b"glTF\x02\0\0\0", "a mesh"),
                                 ("a.png", b"\x89PNG\r\n\x1a\n", "an image"), ("a.schem", b"", "an empty file")):
            path = self.folder / name
            path.write_bytes(data)
            for kind in ("schem", "vox", "minecraft"):
                self.assertNamed(kind, path, hint, "cannot be imported")
            self.assertRefused(run("import", "schem", path, "-o", self.folder / "a.structure"), name)
        schematic = fixtures("prismarine-schematic") / "schematics" / "smallhouse1.schem"
        self.assertNamed("vox", schematic, "`terrane import schem`")
        self.assertNamed("minecraft", schematic, "`terrane import schem`")
        self.assertNamed("schem", fixtures("vox-reader") / "deer.vox", "`terrane import vox`")

    def test_folders_are_named(self):
        for name, file, hint in (("bedrock", "db/CURRENT", "Bedrock Edition"), ("beta", "region/r.0.0.mcr", "Beta"),
                                 ("luanti", "world.mt", "Luanti"), ("alpha", "0/1/c.0.1.dat", "Alpha")):
            path = self.folder / name / file
            path.parent.mkdir(parents=True)
            path.write_bytes(b"x")
            for kind in ("minecraft", "schem"):
                self.assertNamed(kind, self.folder / name, hint)


class Minecraft(ProgramTest):
    def compare(self, version, region, is_whole):
        numbers = re.findall(r"-?\d+", region.name)
        with region.open("rb") as file:
            offsets = struct.unpack(">1024I", file.read(4096))
        chunks = [(int(numbers[0]) * 32 + k % 32, int(numbers[1]) * 32 + k // 32) for k in range(1024) if offsets[k]]
        largest = max((k for k in range(1024) if offsets[k]), key=lambda k: offsets[k] & 255)
        x, z = int(numbers[0]) * 32 + largest % 32, int(numbers[1]) * 32 + largest // 32
        area = (x, z, x + 2, z + 2)
        if is_whole:
            area = (min(c[0] for c in chunks), min(c[1] for c in chunks), max(c[0] for c in chunks) + 1,
                    max(c[1] for c in chunks) + 1)
        folder = self.folder / "copies" / region.parent.name / "region"
        shutil.copytree(region.parent, folder)  # the reader opens files for writing
        expected = node("count_blocks.js", folder, version, *area)
        world = self.folder / f"{region.parent.name}.sqlite"
        report = world.with_suffix(".json")
        done = run("import", "minecraft", region.parent.parent if region.parent.name == "region" else folder.parent,
                   "--world", world, "--generator", "flat", "--area", ",".join(map(str, area)), "--report", report)
        self.assertEqual(done.returncode, 0, done.stderr)
        counted = json.loads(report.read_text())
        self.assertEqual(counted["chunks"], expected["chunks"], version)
        self.assertEqual(counted["blocks"], expected["blocks"], version)
        self.assertEqual(counted["unknown"], {}, version)
        self.assertEqual(counted["damage_count"], 0, version)
        self.assertEqual((counted["below"], counted["above"]), (0, 0), version)
        self.compare_places(world, expected["sample"], version)
        return sum(expected["blocks"].values()), expected["chunks"]

    def compare_places(self, world, sample, version):
        """Minecraft's x, y, z are our -x, z, y."""
        low = (-sample["x"] * 16 - 16, sample["z"] * 16)
        volume = self.folder / "sample.npy"
        top = sample["minY"] + len(sample["blocks"]) // 256
        self.succeed("export", "npy", "--world", world, "-o", volume,
                     f"--box={low[0]},{low[1]},{sample['minY']},{low[0] + 16},{low[1] + 16},{top}")
        names = json.loads((self.folder / "sample.npy.names.json").read_text())
        ours = numpy.load(volume)
        theirs = numpy.array(sample["blocks"]).reshape(-1, 16, 16)[:, :, ::-1]
        compared = 0
        for layer, blocks in enumerate(theirs):
            for number, name in enumerate(sample["names"]):
                wanted = SAME.get(name.removeprefix("minecraft:"))
                if wanted is None:
                    continue
                there = ours[layer][blocks == number]
                self.assertTrue((there == names.index(wanted)).all(),
                                f"{version}: {name} at height {sample['minY'] + layer}")
                compared += there.size
        self.assertGreater(compared, 5000, version)

    def test_region_files_have_the_blocks_of_another_reader(self):
        regions = sorted(fixtures("prismarine-provider-anvil").glob("fixtures/*/*.mca"))
        self.assertEqual(len(regions), 12)
        is_whole = bool(os.environ.get("TERRANE_ALL_CHUNKS"))
        if not is_whole:
            regions = [region for region in regions if region.parent.name in VERSIONS]
            self.assertEqual(len(regions), len(VERSIONS))
        for region in regions:
            blocks, chunks = self.compare(region.parent.name, region, is_whole)
            print(f"  {region.parent.name}: {chunks} chunks, {blocks} blocks", file=sys.stderr)

    def test_tall_worlds_have_the_blocks_of_another_reader(self):
        """384 layers are those of 1.18 and newer, 4,064 the most that a data pack may have."""
        random = numpy.random.default_rng(5)
        states = {state: block["name"] in SAME for block in dict(block_lists())["1.20"] for state in states_of(block)}
        counts = collections.Counter(states.values())
        chances = {state: 0.5 / counts[is_same] for state, is_same in states.items()}  # half of SAME
        for first, end in ((-4, 20), (-127, 127)):
            region = self.folder / f"{16 * (end - first)}" / "r.0.0.mca"
            region.parent.mkdir()
            region.write_bytes(region_file({k: mixed_chunk(k % 32, k // 32, range(first, end), chances, random)
                                            for k in (0, 1, 32)}))
            blocks, chunks = self.compare("1.20.1", region, True)
            self.assertEqual((blocks, chunks), (3 * 4096 * (end - first), 3))

    def test_worlds_of_any_height_keep_every_block(self):
        kinds = ["stone", "dirt", "sand", "gravel", "granite", "clay", "deepslate"]
        for first, end in ((-4, 20), (-127, 127)):
            names = {y: f"minecraft:{kinds[y % len(kinds)]}" for y in range(first, end)}
            region, world = self.folder / "r.0.0.mca", self.folder / f"tall{end}.sqlite"
            region.write_bytes(region_file({x: uniform_chunk(x, 0, names) for x in range(3)}))
            report = self.folder / "r.json"
            self.succeed("import", "minecraft", region, "--world", world, "--generator", "flat", "--report", report)
            counted = json.loads(report.read_text())
            expected = collections.Counter()
            for name in names.values():
                expected[name] += 3 * 4096
            self.assertEqual(counted["blocks"], expected)
            self.assertEqual((counted["below"], counted["above"], counted["chunks"]), (0, 0, 3))
            volume = self.folder / "v.npy"
            self.succeed("export", "npy", "--world", world, "-o", volume, f"--box=-16,0,{16 * first},0,16,{16 * end}")
            ids = json.loads((self.folder / "v.npy.names.json").read_text())
            sections = numpy.load(volume).reshape(end - first, -1)
            for section, name in zip(sections, names.values()):
                wanted = SAME.get(name.removeprefix("minecraft:"), name.removeprefix("minecraft:"))
                self.assertTrue((section == ids.index(wanted)).all(), name)
            self.assertEqual(run("check", world).returncode, 0)

    def test_heights_that_are_asked_for_are_kept(self):
        names = {y: "minecraft:stone" for y in range(-4, 20)}
        region, world, report = self.folder / "r.0.0.mca", self.folder / "w.sqlite", self.folder / "r.json"
        region.write_bytes(region_file({0: uniform_chunk(0, 0, names)}))
        self.succeed("import", "minecraft", region, "--world", world, "--generator", "flat", "--report", report,
                     "--bottom=-32", "--top=256")
        counted = json.loads(report.read_text())
        self.assertEqual((counted["below"], counted["above"]), (32 * 256, 64 * 256))

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
        data[start + 4] = 4  # LZ4, which it is not
        done, report = self.import_region(bytes(data), "--area", "0,-32,32,-9", name="r.0.-1.mca")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(report["damage_count"], 1)
        self.assertIn("LZ4", report["damaged"][0])
        self.assertIn("LZ4", done.stderr)
        self.assertGreater(report["chunks"], 3)

    def test_bytes_of_any_kind_end_with_a_line(self):
        for data in (b"", b"\0" * 5000, b"\xff" * 9000, bytes(range(256)) * 64):
            done, report = self.import_region(data)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertRegex(done.stderr, r"terrane: error: [^\n]+\n\Z")
            if any(data[:4096]):
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
        for case in (("glb",), ("glb", "--area", "0,0,1,1", "--box", "0,0,0,1,1,1"), ("glb", "--box", "0,0,0,1,1,2000"),
                     ("glb", "--box", "0,0,5,1,1,5"), ("glb", "--box", "0,0,0,1"), ("schem", "--area", "0,0,1,1"),
                     ("glb", "--area", "0,0,1,1", "--bits", 16), ("nonsense", "--area", "0,0,1,1"),
                     ("glb", "--box", "0,0,250,4,4,256", "--generator", "flat")):
            self.assertRefused(run("export", *case, "-o", self.folder / "a.glb"), case)
            self.assertFalse((self.folder / "a.glb").exists(), case)


class Failures(ProgramTest):
    """Of an export, or of an import to a file, nothing is left."""

    def limited(self, limit_bytes, *arguments):
        """Runs with a limit on file sizes, which acts like a full disk."""
        def bound():
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit_bytes, limit_bytes))
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        return subprocess.run([support.program(), *map(str, arguments)], capture_output=True, text=True,
                              timeout=support.HANG_SECONDS, preexec_fn=bound, restore_signals=False,
                              env=support.environment(), check=False)

    def test_a_full_disk_leaves_nothing(self):
        for kind, ending in (("npy", ".npy"), ("npy-heights", ".npy"), ("png-heights", ".png"), ("vox", ".vox"),
                             ("schem", ".schem"), ("glb", ".glb")):
            # The names of npy fit, its blocks do not.
            limit = 200000 if kind == "npy" else 256
            done = self.limited(limit, "export", kind, "--generator", "hills3d", "--area", "0,0,2,2", "-o",
                                self.folder / f"a{ending}")
            self.assertRefused(done, kind)
            self.assertEqual(list(self.folder.iterdir()), [], kind)

    def test_an_older_export_stays(self):
        path = self.folder / "a.npy"
        self.succeed("export", "npy", "--generator", "flat", "--area", "0,0,1,1", "-o", path)
        files = {file.name: file.read_bytes() for file in self.folder.iterdir()}
        self.assertEqual(len(files), 2)
        self.assertRefused(self.limited(100000, "export", "npy", "--generator", "hills3d", "--area", "0,0,1,1", "-o", path),
                           "full")
        self.assertEqual({file.name: file.read_bytes() for file in self.folder.iterdir()}, files)

    def test_what_cannot_be_written_leaves_nothing(self):
        for name in ("a.npy", "a.npy.names.json"):
            (self.folder / name).mkdir()
            self.assertRefused(run("export", "npy", "--generator", "flat", "--area", "0,0,1,1", "-o", self.folder / "a.npy"),
                               name)
            self.assertEqual([path.name for path in self.folder.iterdir()], [name])
            (self.folder / name).rmdir()
        source = fixtures("prismarine-schematic") / "schematics" / "smallhouse1.schem"
        (self.folder / "r.json").mkdir()
        self.assertRefused(run("import", "schem", source, "-o", self.folder / "a.structure", "--report",
                               self.folder / "r.json"), "report")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["r.json"])

    def test_a_box_outside_the_heights_is_refused(self):
        source = fixtures("prismarine-schematic") / "schematics" / "smallhouse1.schem"
        for height in (1792, -1000):
            done = run("import", "schem", source, "--world", self.folder / "w.sqlite", f"--at=0,0,{height}")
            self.assertRefused(done, height)
            self.assertIn("nothing is imported", done.stderr)
            self.assertFalse((self.folder / "w.sqlite").exists())


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

    def test_layers_outside_the_heights_are_told(self):
        source, world = self.folder / "a.schem", self.folder / "w.sqlite"
        self.succeed("export", "schem", "--generator", "flat", "--box", "0,0,78,4,4,80", "-o", source)
        for z, message in ((-1, "16 blocks below and 0 above"), (255, "0 blocks below and 16 above")):
            done = run("import", "schem", source, "--world", world, "--generator", "flat", f"--at={2**31 - 4},0,{z}")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(f"{message} the world's heights are left out (see --at)", done.stderr)

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
