"""Content packs on the command line: created, checked, listed, remembered by worlds, sent by servers."""
import json
import shutil
import subprocess

import support


class Packs(support.ProgramTest):
    def setUp(self):
        super().setUp()
        self.data = self.folder / "data"
        self.packs = self.data / "terrane" / "packs"
        self.environment = support.environment(None, self.data) | {"XDG_CACHE_HOME": str(self.folder / "cache")}

    def terrane(self, *arguments, code=0):
        done = subprocess.run([support.program(), *map(str, arguments)], capture_output=True, text=True,
                              timeout=support.HANG_SECONDS, env=self.environment, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout if code == 0 else done.stderr

    def digest(self, *arguments):
        return self.terrane("generate", "--radius", "1", "--digest", *arguments).split()[-1]

    def test_a_new_pack_works_at_once(self):
        said = self.terrane("packs", "init", "isles")
        self.assertIn(str(self.packs / "isles"), said)
        self.assertIn("--content isles --generator isles:hills", said)
        self.assertIn("isles: good: 3 blocks, 1 generator, 5 files", self.terrane("packs", "check", "isles"))
        listed = json.loads(self.terrane("packs", "--json"))
        self.assertEqual([pack["name"] for pack in listed], ["terrane", "isles"])
        self.assertEqual(listed[1]["generators"], ["isles:hills"])
        blocks = json.loads(self.terrane("blocks", "--content", "isles", "--json"))
        glow = next(block for block in blocks if block["name"] == "isles:glow_rock")
        self.assertEqual(glow["emission"], [3, 11, 13])
        self.assertEqual(glow["shown_name"], "Glow rock")
        self.assertNotEqual(self.digest("--content", "isles", "--generator", "isles:hills"),
                            self.digest("--generator", "flat"))
        self.assertIn("exists already", self.terrane("packs", "init", "isles", code=2))

    def test_a_folder_and_a_zip_file_make_the_same_world(self):
        self.terrane("packs", "init", self.folder / "isles")
        shutil.make_archive(str(self.folder / "zipped"), "zip", self.folder / "isles")
        digests = {self.digest("--content", self.folder / name, "--generator", "isles:hills")
                   for name in ("isles", "zipped.zip")}
        self.assertEqual(len(digests), 1)

    def test_a_world_remembers_its_packs(self):
        self.terrane("packs", "init", "isles")
        world = self.folder / "w.sqlite"
        self.terrane("generate", "--radius", "1", "--world", world, "--content", "isles", "--generator", "isles:hills")
        # The pack is not named again, and existing chunks are not generated again.
        self.terrane("generate", "--radius", "1", "--world", world)
        shutil.move(self.packs / "isles", self.folder / "elsewhere")
        told = self.terrane("generate", "--radius", "1", "--world", world, code=2)
        self.assertIn("made with the content pack \"isles\"", told)
        self.assertIn("made by the generator isles:hills, which this program does not have", told)
        self.terrane("generate", "--radius", "1", "--world", world, "--content", self.folder / "elsewhere")

    def test_blocks_of_a_pack_that_is_gone_stay_in_the_world(self):
        self.terrane("packs", "init", "isles")
        world = self.folder / "w.sqlite"
        self.terrane("generate", "--radius", "1", "--world", world, "--content", "isles", "--generator", "flat")
        shutil.move(self.packs / "isles", self.folder / "elsewhere")
        self.terrane("generate", "--radius", "2", "--world", world)
        shutil.move(self.folder / "elsewhere", self.packs / "isles")
        self.assertNotIn("unknown block", self.terrane("check", world))

    def test_another_script_is_another_version(self):
        self.terrane("packs", "init", "isles")
        world = self.folder / "w.sqlite"
        script = self.packs / "isles" / "generators" / "hills.lua"
        text = script.read_text()
        self.terrane("generate", "--radius", "1", "--world", world, "--content", "isles", "--generator", "isles:hills")
        script.write_text("-- a comment\n" + text)
        self.terrane("generate", "--radius", "1", "--world", world)
        script.write_text(text.replace("84", "90"))
        self.assertIn("--regenerate keep-edits", self.terrane("generate", "--radius", "1", "--world", world, code=2))

    def test_mistakes_have_a_file_and_a_line(self):
        self.terrane("packs", "init", "isles")
        blocks = self.packs / "isles" / "blocks.toml"
        good = blocks.read_text()
        blocks.write_text(good.replace("[3, 11, 13]", "[3, 11, 30]"))
        self.assertRegex(self.terrane("packs", "check", "isles", code=2), r"isles/blocks.toml:\d+: emission: expected 0 to 15")
        blocks.write_text(good)
        script = self.packs / "isles" / "generators" / "hills.lua"
        script.write_text("local x = nil + 1\n")
        self.assertIn("isles/generators/hills.lua:1:", self.terrane("packs", "check", "isles", code=2))
        for arguments in (("packs", "check"), ("packs", "check", "none"), ("packs", "init"), ("packs", "init", "A b"),
                          ("blocks", "--content", ""), ("blocks", "--content", "./none")):
            done = subprocess.run([support.program(), *arguments], capture_output=True, text=True,
                                  timeout=support.HANG_SECONDS, env=self.environment, check=False)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)

    def test_a_mistake_in_a_script_is_one_line(self):
        self.terrane("packs", "init", "isles")
        about = self.packs / "isles" / "pack.toml"
        about.write_text(about.read_text().replace("# rules = 1", "rules = 1"))
        (self.packs / "isles" / "scripts" / "main.lua").write_text('events.on("brak", print)\n')
        told = self.terrane("packs", "check", "isles", code=2)
        self.assertEqual(told.strip(), 'terrane: error: isles/scripts/main.lua:1: on: there is no event "brak"; did you mean break?')

    def test_slips_are_warned_of(self):
        self.terrane("packs", "init", "isles")
        (self.packs / "isles" / "languages" / "en.toml").write_text('[blocks]\nglow_rok = "Glow"\n')
        shutil.copy(self.packs / "isles" / "textures" / "glow_rock.png", self.packs / "isles" / "textures" / "unused.png")
        done = subprocess.run([support.program(), "packs", "check", "isles"], capture_output=True, text=True,
                              timeout=support.HANG_SECONDS, env=self.environment, check=True)
        self.assertIn("unused.png: no block uses this texture", done.stderr)
        self.assertIn("languages/en.toml: blocks.glow_rok: the pack has no such block", done.stderr)

    def test_a_server_sends_its_packs(self):
        self.terrane("packs", "init", "isles")
        server = support.RunningProgram(self.data, "serve", "--world", self.folder / "w.sqlite", "--content", "isles",
                                        "--generator", "isles:hills", "--address", "127.0.0.1", "--port", "0")
        self.addCleanup(server.clean_up)
        port = server.wait_for(r"on port (\d+)")[1]
        # Bots use another data folder, without packs.
        bare = self.environment | {"XDG_DATA_HOME": str(self.folder / "empty")}
        done = subprocess.run([support.program(), "bots", "--connect", f"127.0.0.1:{port}", "--count", "2", "--seconds", "1",
                               "--behaviour", "build"], capture_output=True, text=True, timeout=support.HANG_SECONDS,
                              env=bare, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        report = json.loads(done.stdout)
        self.assertEqual(report["joined"], 2)
        server.say("stop")
        server.process.wait(support.HANG_SECONDS)


if __name__ == "__main__":
    support.main()
