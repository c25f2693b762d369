#!/usr/bin/env python3
"""A world saved by 0.1.0 is read, converted to the current format and kept (docs/upgrade.md).
Usage: upgrade_test.py PROGRAM

tests/saves/overworld_0.1.sqlite is from the window of 0.1.0: --generator overworld --seed 7 --view-distance 2, with some
blocks placed and a chest filled."""
import hashlib
import json
import pathlib
import shutil

import support
from support import Npy, ProgramTest

SAVE = pathlib.Path(__file__).resolve().parents[1] / "saves" / "overworld_0.1.sqlite"
# Chunks around the edits, and the digest of their block names as written by `terrane dump` of 0.1.0.
AREA, NAMES = "-1,-8,2,-5", "0edf03d2181ba7e7e5ad05951308bf7e0601552ff9077ad50a1cd8bbd9e6c69f"


class Upgrade(ProgramTest):
    def setUp(self):
        super().setUp()
        self.save = self.folder / "w.sqlite"
        shutil.copy(SAVE, self.save)
        self.copy = self.folder / "w.before-migration-1.sqlite"
        self.names = {t["id"]: t["name"] for t in json.loads(self.succeed("blocks", "--json"))}

    def blocks(self, save):
        out = self.folder / "out.npy"
        self.succeed("dump", f"--area={AREA}", "--world", save, "-o", out)
        return hashlib.sha256(" ".join(self.names[v] for v in Npy(out).volume()).encode()).hexdigest()

    def test_reading_changes_nothing(self):
        self.assertEqual(self.blocks(self.save), NAMES)
        checked = self.succeed("check", self.save)
        self.assertIn("format 1, generator overworld version 2, seed 7\n56 chunks, 2 of them edited", checked)
        self.assertTrue(checked.endswith("good\n"), checked)
        self.assertEqual(self.save.read_bytes(), SAVE.read_bytes())

    def test_writing_brings_it_to_the_present_format_and_keeps_a_copy(self):
        done = support.run("generate", "--world", self.save, "--area", "4,4,5,5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"{self.save}: migrated to format 3; the old file is {self.copy}", done.stderr)
        self.assertEqual(self.blocks(self.save), NAMES)
        self.assertEqual(self.blocks(self.copy), NAMES)
        self.assertIn("format 1, ", self.succeed("check", self.copy))
        checked = self.succeed("check", self.save)
        self.assertIn("format 3, generator overworld version 2, seed 7\n57 chunks, 2 of them edited", checked)
        self.assertTrue(checked.endswith("good\n"), checked)

    def test_land_beside_the_save_goes_on_without_a_step(self):
        """Generated chunks stored by 0.1.0 equal those generated now."""
        out = self.folder / "generated.npy"
        area = "-2,-8,0,-5"  # stored, not edited
        self.succeed("dump", f"--area={area}", "--generator", "overworld", "--seed", 7, "-o", out)
        generated = bytes(Npy(out).data)
        self.succeed("dump", f"--area={area}", "--world", self.save, "-o", out)
        self.assertEqual(bytes(Npy(out).data), generated)


if __name__ == "__main__":
    support.main()
