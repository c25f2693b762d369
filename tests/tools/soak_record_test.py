#!/usr/bin/env python3
"""The memory report of tools/soak.py, and its rule for blocks that bots keep. Usage: soak_record_test.py FOLDER (of the package soak)"""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(sys.argv.pop(1)).resolve().parent))

from soak.bots import is_kept  # noqa: E402
from soak.record import Record  # noqa: E402


class Memory(unittest.TestCase):
    def problems(self, megabytes, processes=None):
        with tempfile.TemporaryDirectory() as folder:
            record = Record(pathlib.Path(folder))
            processes = processes or [7] * len(megabytes)
            record.series["server 3"] = [(10.0 * k, value, pid) for k, (value, pid) in enumerate(zip(megabytes, processes))]
            record.samples.close()
            record.events.close()
            return record.memory_problems()

    def test_what_stays_is_no_problem(self):
        self.assertEqual(self.problems([30.0] * 10 + [80.0, 90.0] * 45), [])

    def test_growth_is_told(self):
        self.assertEqual(self.problems([80.0] * 60 + [120.0] * 40), ["server 3: memory grows from 80 to 120 MB"])

    def test_who_was_killed_begins_anew(self):
        self.assertEqual(self.problems([80.0] * 60 + [120.0] * 40, [7] * 50 + [8] * 50), [])


class Kept(unittest.TestCase):
    def test_the_last_change_is_kept(self):
        self.assertTrue(is_kept([("stone", "bot1.5"), ("air", "bot2.3")], "stone"))

    def test_what_is_missing_is_lost(self):
        self.assertFalse(is_kept([], "stone"))
        self.assertFalse(is_kept([("air", "bot1.5")], "stone"))
        self.assertFalse(is_kept([("stone", "Ann")], "stone"))

    def test_what_a_bot_replaced_without_telling_is_lost(self):
        self.assertFalse(is_kept([("air", "bot2.3"), ("stone", "bot1.5")], "stone"))

    def test_a_windows_player_may_replace_it_and_a_bot_that_again(self):
        door = [("air", "bot2.3"), ("oak_door", "Bob"), ("air", "Bob"), ("stone", "bot1.5")]
        self.assertTrue(is_kept(door[1:], "stone"))
        self.assertTrue(is_kept(door, "stone"))
        self.assertFalse(is_kept(door[:3], "stone"))


if __name__ == "__main__":
    unittest.main()
