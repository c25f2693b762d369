#!/usr/bin/env python3
"""The program with too little memory: it ends with a one-line error and damages no save.
Usage: memory_test.py PROGRAM

Each command runs under limits of its address space (RLIMIT_AS), from the least that loads the program to the least that
suffices: three limits each, at full depth (TERRANE_DEPTH=all) one every 128 KiB. Commands that draw are
not tested: Mesa's software renderer aborts the process without memory (LLVM: "Unable to allocate section memory!").
Rarely the C library does so too, for thread-local variables; that is ignored."""
import functools
import re
import resource
import signal
import subprocess

import support
from support import ProgramTest

KIB, MIB = 1 << 10, 1 << 20
HANG_SECONDS = 300  # a guard against hangs: commands take less than a second
CANNOT_BE_LOADED = 127  # by the dynamic linker, before any code of the program
COUNT, FULL_STEP = 3, 128 * KIB  # of limits; between limits at full depth
INFORMATION = re.compile(r"terrane: (?!error: )")  # log lines except errors
GLIBC_GAVE_UP = "Fatal glibc error: failed to register TLS destructor: out of memory"


def run_within(limit, arguments):
    def set_limit():
        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    environment = support.environment()
    # At a limit that has no room for another arena, glibc tries to make one at each allocation, which takes most of the time.
    if not support.tests_all():
        environment["MALLOC_ARENA_MAX"] = "1"
    return subprocess.run([support.program(), *map(str, arguments)], capture_output=True, text=True,
                          timeout=HANG_SECONDS, env=environment, check=False, preexec_fn=set_limit)


def first_limit(low, high, step, holds):
    """A limit that meets the condition, while the limit `step` below does not."""
    while high - low > step:
        middle = (low + high) // 2
        low, high = (low, middle) if holds(middle) else (middle, high)
    return high


@functools.cache
def limit_to_load():
    """The least limit at which the system can load the program."""
    return first_limit(4 * MIB, 256 * MIB, 256 * KIB,
                       lambda limit: run_within(limit, ["--version"]).returncode != CANNOT_BE_LOADED)


class Memory(ProgramTest):
    def setUp(self):
        super().setUp()
        self.save = self.folder / "save.sqlite"

    def limits(self, run):
        """The limits to test. The least sufficient one varies: threads allocate memory in a different order each time."""
        loads = limit_to_load()
        works = first_limit(loads, 512 * MIB, 4 * MIB, lambda limit: run(limit).returncode == 0)
        end = works + (works - loads) // 2 + 4 * MIB
        return range(loads, end, FULL_STEP if support.tests_all() else (end - loads) // COUNT)

    def assertEndsWell(self, done, case):
        if done.returncode == -signal.SIGABRT and GLIBC_GAVE_UP in done.stderr:
            return
        self.assertIn(done.returncode, (0, 2), f"{case}: {done.stderr}")
        errors = [line for line in done.stderr.splitlines() if not INFORMATION.match(line)]
        if done.returncode == 0:
            self.assertEqual(errors, [], case)
        else:
            self.assertEqual(len(errors), 1, f"{case}: not one line: {done.stderr}")
            self.assertRegex(errors[0], r"\Aterrane: error: .*(memory|no thread can be started)", case)

    def assertNoDamage(self, case):
        """A save left by a run can be checked and is complete, or there is none."""
        if not self.save.exists():
            return
        done = support.run("check", self.save)
        self.assertIn(done.returncode, (0, 2), f"{case}: {done.stdout} {done.stderr}")
        if done.returncode == 2:
            self.assertIn("empty, not a save", done.stderr, case)

    def empty_folder(self):
        for file in self.folder.iterdir():
            file.unlink()

    def sweep(self, *arguments, prepare=lambda: None):
        """`prepare` is called before each run."""
        def run(limit):
            prepare()
            return run_within(limit, arguments)

        seen = set()
        for limit in self.limits(run):
            case = f"{limit / MIB:.1f} MiB: {arguments}"
            done = run(limit)
            self.assertEndsWell(done, case)
            self.assertNoDamage(case)
            self.assertEqual(list(self.folder.glob("*.tmp*")), [], f"{case}: half a file is left")
            seen.add(done.returncode)
        self.assertIn(0, seen, "the largest is enough")

    def make_save(self):
        self.succeed("generate", "--radius", 3, "--world", self.save)

    def test_generate(self):
        self.sweep("generate", "--radius", 2, "--threads", 4, "--backend", "cpu")

    def test_generate_into_a_save(self):
        self.sweep("generate", "--radius", 3, "--threads", 2, "--backend", "cpu", "--world", self.save,
                   prepare=self.empty_folder)

    def test_generate_into_a_save_that_is_there(self):
        self.make_save()
        small = self.save.read_bytes()

        def put_back():
            self.empty_folder()
            self.save.write_bytes(small)
        self.sweep("generate", "--radius", 4, "--threads", 2, "--backend", "cpu", "--world", self.save, prepare=put_back)

    def test_map(self):
        self.sweep("map", "--radius", 3, "--threads", 2, "--output", self.folder / "map.png")

    def test_dump_blocks_of_a_save(self):
        self.make_save()
        self.sweep("dump", "--area", "-2,-2,2,2", "--threads", 2, "--world", self.save, "--output",
                   self.folder / "blocks.npy")

    def test_dump_light(self):
        self.sweep("dump", "--what", "light", "--backend", "cpu", "--area", "0,0,2,2", "--threads", 2, "--output",
                   self.folder / "light.npy")

    def test_dump_quads(self):
        self.sweep("dump", "--what", "quads", "--backend", "cpu", "--area", "0,0,2,2", "--threads", 2, "--output",
                   self.folder / "quads.npy")

    def test_check(self):
        self.make_save()
        self.sweep("check", self.save)


if __name__ == "__main__":
    support.main()
