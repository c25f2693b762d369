#!/usr/bin/env python3
"""Errors on the command line: one line that names the error, exit code 2, and nothing written.

Usage: bad_input_test.py PROGRAM"""
import os
import re
import subprocess

import support
from support import ProgramTest, run

RENDER = ("render", "--scene", "ocean", "-o", "{png}")
GENERATE = ("generate", "--radius", "0")
DUMP = ("dump", "--area", "0,0,1,1", "-o", "{npy}")
MAP = ("map", "--radius", "0", "-o", "{png}")

# Arguments, and text that the line must contain. {out}, {png} and {npy} are writable files, {folder} is their folder.
CASES = [
    # Commands
    (("--frobnicate",), "--frobnicate"),
    (("blocks", "extra"), "extra"),
    (("info", "--frobnicate"), "--frobnicate"),
    (("generate", "--radius", "0", "render"), "render"),
    # Misspelled names: all of them, in order, before other errors
    (("rendr",), "error: unknown command rendr; did you mean render? (see terrane --help)"),
    (("rendr", "--scene", "ocean", "--help"), "unknown command rendr; did you mean render?"),
    (("genrate", "--radius", "0"), "unknown command genrate; did you mean generate?"),
    (("frobnicate",), "error: unknown command frobnicate (see terrane --help)"),
    (("",), 'unknown command ""'),
    ((*GENERATE, "--sed", "5"), "error: unknown option --sed; did you mean --seed? (see terrane generate --help)"),
    ((*GENERATE, "--sed=5"), "unknown option --sed; did you mean --seed?"),
    ((*GENERATE, "-seed", "5"), "unknown option -seed; did you mean --seed?"),
    (("render", "--scen", "ocean"), "unknown option --scen; did you mean --scene? (see terrane render --help)"),
    (("render", "--scene", "ocean", "--otput", "a.png"), "unknown option --otput; did you mean --output?"),
    (("--sed", "5"), "unknown option --sed; did you mean --seed? (see terrane play --help)"),
    ((*GENERATE, "first", "--frob", "--seeed", "5", "--jsn", "last", "--frob"),
     "error: unknown argument first; unknown option --frob; unknown option --seeed; did you mean --seed? unknown option --jsn; "
     "did you mean --json? unknown argument last; unknown option --frob (see"),
    (("blocks", "extra"), "unknown argument extra"),
    (("info", "-x"), "unknown option -x (see"),
    ((*RENDER, "--preset", "hihg"), "got \"hihg\"; did you mean high?"),
    ((*RENDER, "--merging", "greddy"), "got \"greddy\"; did you mean greedy?"),
    ((*RENDER, "--god-rays", "onn"), "got \"onn\"; did you mean on?"),
    ((*RENDER, "--generator", "contients"), "did you mean continents?"),
    ((*GENERATE, "--generator", "flt"), '"flt"'),
    ((*GENERATE, "--generator", "flt"), "did you mean flat?"),
    (("render", "--scene", "oceann", "-o", "{png}"), "got \"oceann\"; did you mean ocean?"),
    (("bench", "-o", "{folder}/bench", "--only", "dsk"), "got \"dsk\"; did you mean disk?"),
    (("completion", "bsh"), "got \"bsh\"; did you mean bash?"),
    # Scenes and places
    (("render", "-o", "{png}"), "--scene or --at"),
    (("render", "--scene", "nowhere", "-o", "{png}"), '"nowhere"'),
    (("render", "--scene", "", "-o", "{png}"), "--scene"),
    (("render", "--at", "1,2", "-o", "{png}"), '"1,2"'),
    (("render", "--at", "1,2,3,4", "-o", "{png}"), '"1,2,3,4"'),
    (("render", "--at", "1,2,x", "-o", "{png}"), '"1,2,x"'),
    (("render", "--at", "1,,3", "-o", "{png}"), '"1,,3"'),
    (("render", "--at", "1,2,3,", "-o", "{png}"), '"1,2,3,"'),
    (("render", "--at", "", "-o", "{png}"), '""'),
    (("render", "--at", "nan,0,0", "-o", "{png}"), '"nan,0,0"'),
    (("render", "--at", "inf,0,0", "-o", "{png}"), '"inf,0,0"'),
    (("render", "--at", "3e9,0,80", "-o", "{png}"), "outside the world"),
    (("render", "--at", "0,-1e14,80", "-o", "{png}"), "outside the world"),
    ((*RENDER, "--at", "1,2,3"), "--at"),
    ((*RENDER, "--look", "1"), '"1"'),
    ((*RENDER, "--look", "a,b"), '"a,b"'),
    ((*RENDER, "--time", "2"), '"2"'),
    ((*RENDER, "--time", "noon"), '"noon"'),
    # Worlds
    ((*RENDER, "--generator", "nope"), '"nope"'),
    ((*GENERATE, "--generator", "nope"), '"nope"'),
    ((*GENERATE, "--simd", "MMX"), "MMX"),
    ((*DUMP, "--generator", "nope"), '"nope"'),
    ((*MAP, "--generator", "nope"), '"nope"'),
    ((*GENERATE, "--seed", ""), '""'),
    ((*GENERATE, "--seed", "+1"), '"+1"'),
    ((*GENERATE, "--seed=-9223372036854775809"), '"-9223372036854775809"'),
    ((*GENERATE, "--seed", "99999999999999999999999"), "99999999999999999999999"),
    ((*GENERATE, "--threads", "0"), '"0"'),
    ((*GENERATE, "--threads", "-1"), '"-1"'),
    ((*GENERATE, "--threads", "9999"), '"9999"'),
    # The history of a server
    (("history", "--world", "{folder}/none.sqlite", "--area", "1,2,3"), '--area: expected X0,Y0,X1,Y1 in blocks, got "1,2,3"'),
    *(((("history", "--world", "{folder}/none.sqlite", f"--area={area}")),
       f'--area: expected whole numbers within the world, got "{area}"') for area in
      ("2147483648,0,0,0", "0,-2147483649,0,0", "0,0,0.5,0")),
    # Measurements
    (("bench",), "--output"),
    (("bench", "-o", "{folder}/bench", "nothing"), '"nothing"'),
    (("bench", "-o", "{folder}/bench", "--only", "disk,nothing"), '"nothing"'),
    (("bench", "-o", "{folder}/bench", "--only", ""), "--only"),
    (("bench", "-o", "{folder}/bench", "--size", "big"), '"big"'),
    (("bench", "-o", "{folder}/bench", "--runs", "0"), '"0"'),
    (("bench", "-o", "{folder}/bench", "--frames", "none"), '"none"'),
    (("bench", "-o", "{folder}/bench", "--view-distance", "65"), '"65"'),
    (("flight-bench",), "--json"),
    (("flight-bench", "--scene", "nowhere", "--json"), '"nowhere"'),
    (("flight-bench", "--at", "3e9,0,80", "-o", "{out}"), "outside the world"),
    (("flight-bench", "--duration", "0", "-o", "{out}"), '"0"'),
    # Images
    ((*RENDER, "--resource-pack", "{folder}/none"), "none"),
    *(((*RENDER, "--gpu-memory", bad), f'"{bad}"') for bad in ("0", "15", "-24", "1048577", "much", "24MiB", "1e9", "nan")),
    ((*RENDER, "--gpu-memory", "24.5"), "24.5"),
    (("flight-bench", "-o", "{out}", "--gpu-memory", "8"), '"8"'),
    (("bench", "-o", "{folder}/bench", "--gpu-memory", "8"), '"8"'),
    (("play", "--gpu-memory", "8"), '"8"'),
    ((*RENDER, "--size", "0x0"), '"0x0"'),
    ((*RENDER, "--size", "abc"), '"abc"'),
    ((*RENDER, "--size", "99999x1"), '"99999x1"'),
    ((*RENDER, "--size", "64"), '"64"'),
    ((*RENDER, "--size", "64x"), '"64x"'),
    ((*RENDER, "--size", "64x36x2"), '"64x36x2"'),
    ((*RENDER, "--size", "-64x36"), '"-64x36"'),
    ((*RENDER, "--size", "64 x 36"), '"64 x 36"'),
    (("play", "--size", "0x0"), '"0x0"'),
    ((*RENDER, "--view", "nothing"), '"nothing"'),
    ((*RENDER, "--view", "0"), '"0"'),
    ((*RENDER, "--light", "loud"), '"loud"'),
    ((*RENDER, "--view-distance", "0"), '"0"'),
    ((*RENDER, "--view-distance", "65"), '"65"'),
    ((*RENDER, "--view-distance", "far"), '"far"'),
    ((*RENDER, "--view-distance", "1.5"), "1.5"),
    ((*RENDER, "--samples", "3"), "--samples: 3 is not one of 1, 2, 4, 8"),
    ((*RENDER, "--samples", "0", "--renderer", "path"), '"0"'),
    ((*RENDER, "--renderer", "cubes"), '"cubes"'),
    ((*RENDER, "--renderer", "rays", "--preset", "minimal"), "choose another shading or preset"),
    ((*RENDER, "--renderer", "rays", "--view", "merging"), "merging"),
    ((*RENDER, "--denoise"), "--denoise cannot be used with --renderer quads"),
    ((*RENDER, "--lens", "1"), "--lens cannot be used with --renderer quads"),
    ((*RENDER, "--renderer", "path", "--frames", "3"), "--frames cannot be used with --renderer path"),
    ((*RENDER, "--renderer", "path", "--view", "depth"), "--view cannot be used with --renderer path"),
    ((*RENDER, "--renderer", "path", "--resume", "{folder}/missing/a.samples"), "missing"),
    (("render", "--scene", "ocean", "-o", "{folder}/a.exr"), "only --renderer path writes EXR files"),
    ((*RENDER, "--preset", "best"), '"best"'),
    ((*RENDER, "--shadows", "512"), '"512"'),
    ((*RENDER, "--shading", "ON"), '"ON"'),
    ((*RENDER, "--ssao", ""), '""'),
    ((*RENDER, "--layers", "4"), '"4"'),
    ((*RENDER, "--single-layer", "0"), '"0"'),
    (("play", "--god-rays", "yes"), '"yes"'),
    ((*RENDER, "--frames", "-1"), '"-1"'),
    ((*RENDER, "--seconds", "soon"), '"soon"'),
    ((*RENDER, "--shader-root", "{folder}/missing"), "missing"),
    # Areas
    (("generate",), "--radius"),
    ((*GENERATE, "--backend", "abacus"), '"abacus"'),
    (("generate", "--radius", "-1"), '"-1"'),
    (("generate", "--radius", "5000"), '"5000"'),
    (("generate", "--radius", "x"), '"x"'),
    (("generate", "--radius"), "--radius"),
    (("generate", "--radius", "1", "--radius", "2"), "--radius"),
    (("generate", "--radius", "1", "--area", "0,0,1,1"), "--area"),
    (("generate", "--area", "0,0,0,0"), '"0,0,0,0"'),
    (("generate", "--area", "5,5,4,6"), '"5,5,4,6"'),
    (("generate", "--area", "0,0,1"), '"0,0,1"'),
    (("generate", "--area", "0,0,1.5,1"), "integers"),
    (("generate", "--area", "a,b,c,d"), '"a,b,c,d"'),
    (("generate", "--area", "134217728,0,134217729,1"), "134217727"),
    (("generate", "--area", "0,-134217729,1,1"), "-134217728"),
    (("generate", "--area", "0,0,1e14,1"), "134217727"),
    (("dump", "-o", "{npy}"), "--area"),
    (("dump", "--area", "0,0,100000000,100000000", "-o", "{npy}"), "10000000000000000 chunks are too many for a file"),
    (("dump", "--generator", "continents", "--area", "0,0,4000000,4000000", "-o", "{npy}"),
     "out.npy: 2097152000000000128 bytes do not fit"),
    ((*DUMP, "--what", "nothing"), '"nothing"'),
    ((*DUMP, "--backend", "abacus"), '"abacus"'),
    (("map", "-o", "{png}"), "--radius"),
    (("map", "--radius", "512", "--level", "0", "-o", "{png}"), "1050625 chunks"),
    (("map", "--radius", "8191", "--level", "3", "-o", "{png}"), "4194304 chunks"),
    (("map", "--radius", "1", "--level", "16", "-o", "{png}"), '"16"'),
    # Saves
    (("check",), "file"),
    (("check", "{out}"), "no such file"),
    (("check", "{folder}"), "not a file"),
    (("check", "/dev/null"), "not a file"),
    (("check", "{program}"), "not a SQLite file"),
    ((*GENERATE, "--world", "{folder}"), "{folder}"),
    ((*GENERATE, "--world", "{folder}/missing/a.sqlite"), "{folder}/missing"),
    ((*GENERATE, "--world", "{out}", "--generator", "nope"), '"nope"'),
    ((*GENERATE, "--world", "{program}"), "not a SQLite file"),
    ((*GENERATE, "--recreate"), "--world"),
    ((*DUMP, "--world", "{folder}/nothing.sqlite"), "no such file"),
    (("export", "npy", "-o", "{npy}", "--box", "0,0,0,1.5,1,1"), "--box: expected whole numbers within the world"),
    (("export", "npy", "-o", "{npy}", "--area", "0,0,1,1", "--bits", "16"), "--bits cannot be used with npy"),
    (("import", "vox", "{program}", "--world", "{out}", "--at", "1,2,3e9"), "--at: expected whole numbers within the world"),
    # Bots
    (("bots", "--connect", "localhost", "--keys", "{program}"), "{program}/bot0.key"),
    # Files
    (("render", "--scene", "ocean"), "--output"),
    (("dump", "--area", "0,0,1,1"), "--output"),
    (("map", "--radius", "0"), "-o FILE, --http PORT and --tiles FOLDER"),
    (("map", "--http", "x"), "--http: x is no port"),
    (("map", "--http", "70000"), "70000"),
    (("map", "--http", "1.2.3.4.5:80"), "--http: 1.2.3.4.5 is no address"),
    (("map", "--http", "0", "-o", "{png}"), "needs one of"),
    (("map", "--http", "0", "--level", "3"), "--level cannot be used with --http"),
    (("map", "-o", "{png}", "--radius", "0", "--map-disk", "5"), "--map-disk cannot be used with -o"),
    (("map", "--tiles", "{folder}/site", "--radius", "0", "--layers", "height"), "height and biome are drawn over"),
    (("map", "--http", "0", "--map-places", "{folder}/nothing"), "{folder}/nothing"),
    (("map", "--tiles", "{folder}/site"), "--radius"),
    (("map", "--tiles", "{folder}/site", "--radius", "0", "--layers", "dusk"), "there is no layer dusk"),
    (("map", "--tiles", "{folder}/site", "--radius", "0", "--max-zoom", "3"), "3"),
    (("map", "--tiles", "{folder}/site", "--radius", "100000000"), "at most 10000000 images"),
    (("serve", "--world", "{folder}/w.sqlite", "--port", "0", "--http", "::1:80"), "--http: ::1:80"),
    (("render", "--scene", "ocean", "-o"), "--output"),
    (("render", "--scene", "ocean", "-o", ""), '""'),
    (("render", "--scene", "ocean", "-o", "{folder}"), "{folder}"),
    (("render", "--scene", "ocean", "-o", "{folder}/"), "{folder}"),
    (("render", "--scene", "ocean", "-o", "{folder}/missing/a.png"), "{folder}/missing"),
    (("dump", "--area", "0,0,1,1", "-o", "{folder}"), "{folder}"),
    (("dump", "--area", "0,0,1,1", "-o", "{folder}/missing/a.npy"), "{folder}/missing"),
    (("map", "--radius", "0", "-o", "{folder}/missing/a.png"), "{folder}/missing"),
    (("map", "--radius", "0", "-o", "/dev/null"), '"/dev/null" is not a regular file'),
    (("render", "--scene", "cave", "-o", "/dev/full"), '"/dev/full" is not a regular file'),
    *(((*command, "-o", "{folder}/" + name), f'/{name}" does not end in {endings} (no other format is written)')
      for command, endings in ((("render", "--scene", "ocean"), ".png or .exr"), (("map", "--radius", "0"), ".png"))
      for name in ("x.jpg", "x.png.jpeg", "png", "x.")),
    *((("dump", "--area", "0,0,1,1", "-o", "{folder}/" + name), f'/{name}" does not end in .npy (no')
      for name in ("x.npz", "x.png", "x")),
    (("record", "--path", "{program}", "-o", "{folder}/x.gif"), '/x.gif" does not end in .mp4 or .mkv'),
    (("blocks", "--trace", "/dev/full"), '"/dev/full" is not a regular file'),
]


class BadInput(ProgramTest):
    def names(self):
        return {"out": self.folder / "out", "png": self.folder / "out.png", "npy": self.folder / "out.npy",
                "folder": self.folder}

    def test_every_case(self):
        for arguments, hint in CASES:
            names = {**self.names(), "program": support.program()}
            filled = [argument.format(**names) for argument in arguments]
            with self.subTest(" ".join(arguments)):
                done = run(*filled)
                written = sorted(path.name for path in self.folder.iterdir())
                for name in written:
                    (self.folder / name).unlink()
                self.assertRefused(done, filled)
                self.assertIn(hint.format(**names), done.stderr)
                self.assertEqual(written, [], "something was written")

    # Empty values are errors, except for options that then use their default.
    def test_an_empty_value_of_every_option(self):
        enough = {"render": ("--scene", "cave", "-o", "{png}"), "record": ("--path", "{out}", "--frames-dir", "{folder}/f"),
                  "flight-bench": ("--json",), "generate": ("--radius", "0"), "map": ("--radius", "0", "-o", "{png}"),
                  "dump": ("--area", "0,0,1,1", "-o", "{npy}"), "bench": ("-o", "{folder}/bench")}
        taken = {"--resource-pack", "--shader-root", "--simd", "--settings", "--collect-perf-data"}
        tried = 0
        for command in re.findall(r"^  ([a-z-]+)  ", run("--help").stdout, re.M):
            options = re.findall(r"^  (?:-\w,)?(--[a-z-]+) ([A-Z]\S*)", run(command, "--help").stdout, re.M)
            for option, kind in support.few(options, 6):
                if option in taken or kind in ("Excludes:", "REQUIRED"):
                    continue
                names = self.names()
                others = [text.format(**names) for text in enough.get(command, ())]
                if option in others:
                    del others[others.index(option):others.index(option) + 2]
                done = run(command, *others, option, "")
                with self.subTest(f"{command} {option}"):
                    self.assertRefused(done, (command, option))
                    # Other commands name what is missing; a path file is looked for before the rest.
                    if command in enough and command != "record":
                        self.assertIn(option[2:], done.stderr)
                tried += 1
        self.assertGreater(tried, 60 if support.tests_all() else 25)

    # root can write everywhere except in read-only file systems.
    def test_a_folder_that_nothing_can_be_written_in(self):
        closed = self.folder / "closed"
        closed.mkdir(0o500)
        folder = next((f for f in (closed, "/proc/sys", "/sys") if not os.access(f, os.W_OK)), None)
        if not folder:
            self.skipTest("this user can write everywhere")
        for arguments in (("render", "--scene", "ocean", "-o", f"{folder}/a.png"), ("blocks", "--trace", f"{folder}/a.json")):
            done = run(*arguments)
            self.assertRefused(done, arguments)
            self.assertIn(f"written in the folder {folder}", done.stderr)
        done = subprocess.run([support.program(), "map", "--radius", "0", "-o", "a.png"], cwd=folder, capture_output=True,
                              text=True, timeout=support.HANG_SECONDS, check=False)
        self.assertRefused(done, "the working directory")
        self.assertIn("written in the folder .", done.stderr)

    def test_output_that_cannot_be_written(self):
        for arguments in (("blocks",), ("info", "--json"), ("generate", "--radius", "0", "--json"), ("man",), ("--help",),
                          ("--version",), ("completion", "bash")):
            with open("/dev/full", "w", encoding="utf-8") as full:
                done = subprocess.run([support.program(), *arguments], stdout=full, stderr=subprocess.PIPE, text=True,
                                      timeout=support.HANG_SECONDS, env=support.environment(), check=False)
            self.assertEqual(done.returncode, 2, f"{arguments}: {done.stderr}")
            self.assertIn("terrane: error: standard output cannot be written\n", done.stderr, arguments)

    # As in `terrane blocks | head -1`: quiet, and the exit code that shells show for SIGPIPE.
    def test_output_whose_reader_ends(self):
        for arguments in (("blocks",), ("info", "--json"), ("generate", "--radius", "0", "--json"), ("man",), ("--help",),
                          ("--version",), ("completion", "bash")):
            reader, writer = os.pipe()
            os.close(reader)
            done = subprocess.run([support.program(), *arguments], stdout=writer, stderr=subprocess.PIPE, text=True,
                                  timeout=support.HANG_SECONDS, env=support.environment(), check=False)
            os.close(writer)
            self.assertEqual(done.returncode, 141, f"{arguments}: {done.stderr}")
            self.assertNotIn("error", done.stderr, arguments)

    def test_settings_of_a_server_that_lead_nowhere(self):
        world, settings = self.folder / "linked.sqlite", self.folder / "linked.server.toml"
        settings.symlink_to("nowhere")
        done = run("serve", "--world", world, "--generator", "flat", "--address", "127.0.0.1", "--port", "0")
        self.assertRefused(done, settings)
        self.assertIn("linked.server.toml: there is no such file", done.stderr)

    # A server goes on without readers of its output and its messages, answers its console, and saves.
    def test_a_server_whose_readers_end(self):
        world = self.folder / "served.sqlite"
        reader, writer = os.pipe()
        process = subprocess.Popen([support.program(), "serve", "--world", str(world), "--generator", "flat", "--address",
                                    "127.0.0.1", "--port", "0", "--threads", "1"], stdin=subprocess.PIPE, stdout=writer,
                                   stderr=writer, text=True, env=support.environment())
        os.close(writer)
        with os.fdopen(reader, encoding="utf-8") as lines:
            port = next(found.group(1) for line in lines if (found := re.search(r"on port (\d+)", line)))
            self.assertTrue(port)
        try:
            for _ in range(3):
                process.stdin.write("list\nsave\n")
                process.stdin.flush()
            bots = run("bots", "--connect", f"127.0.0.1:{port}", "--count", "1", "--seconds", "1")
            self.assertEqual(bots.returncode, 0, bots.stderr)
            self.assertIsNone(process.poll())
            process.stdin.write("stop\n")
            process.stdin.flush()
            self.assertGreaterEqual(process.wait(support.HANG_SECONDS), 0)
        finally:
            process.kill()
            process.wait()
        self.succeed("check", world)

    # A window needs a display.
    def test_play_without_a_display(self):
        for arguments in ((), ("play",), ("--view-distance", "2")):
            done = run(*arguments)
            self.assertRefused(done, arguments)
            self.assertIn("display", done.stderr)

    def test_play_with_a_display_that_is_not_there(self):
        self.assertRefused(run("play", display=":987654"), "a display that is not there")


if __name__ == "__main__":
    support.main()
