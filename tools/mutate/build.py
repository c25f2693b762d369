"""Builds the test programs: each source of the library alone, with -O1, with assertions."""

import os
import re
import shutil
import time
from dataclasses import dataclass

from . import BadInput
from .processes import run_group

BUILD_LIMIT_SECONDS = 1800  # of a change: endless constant expressions usually hit a limit of the compiler first
SETTINGS = {
    "CMAKE_BUILD_TYPE": "Mutation",  # not a known type: only these flags
    "CMAKE_CXX_FLAGS_MUTATION": "-O1",
    "CMAKE_GTEST_DISCOVER_TESTS_DISCOVERY_MODE": "PRE_TEST",  # a crashing test program does not fail the build
    "TERRANE_BENCHMARKS": "OFF",
    "TERRANE_PYTHON": "OFF",
    "TERRANE_UNITY_TESTS": "ON",
}


@dataclass
class Built:
    is_good: bool
    seconds: float
    error: str = ""  # the compiler's first error


class Build:
    def __init__(self, tree, folder, jobs):
        self.tree = tree
        self.folder = folder
        self.jobs = jobs
        # A separate cache: objects of changed sources are useless elsewhere.
        self.environment = {**os.environ, "CCACHE_DIR": str(folder.parent / "ccache"), "CCACHE_MAXSIZE": "5G"}
        self.objects = {}  # object files by header

    def configure(self):
        settings = dict(SETTINGS)
        if shutil.which("clang++"):
            settings["CMAKE_CXX_COMPILER"] = "clang++"
        if shutil.which("ld.lld"):
            settings["CMAKE_EXE_LINKER_FLAGS"] = "-fuse-ld=lld"
        command = ["cmake", "-G", "Ninja", "-S", str(self.tree), "-B", str(self.folder)]
        done = self.run(command + [f"-D{name}={value}" for name, value in settings.items()])
        if done.code != 0:
            raise BadInput(f"{self.folder}: cmake failed:\n{done.output}")

    def run(self, command, limit_seconds=None):
        return run_group(command, self.environment, limit_seconds)

    def targets(self):
        done = self.run(["ninja", "-C", str(self.folder), "-t", "targets", "all"])
        return {line.split(":")[0] for line in done.output.splitlines() if ":" in line}

    def build(self, target, limit_seconds=BUILD_LIMIT_SECONDS):
        start = time.monotonic()
        done = self.run(["ninja", "-C", str(self.folder), f"-j{self.jobs}", target], limit_seconds)
        seconds = time.monotonic() - start
        if done.code == 0:
            return Built(True, seconds)
        if done.code is None:
            return Built(False, seconds, f"error: not built in {limit_seconds} s")
        error = re.search(r"^.*error: .*$", done.output, re.MULTILINE)
        if not error:
            raise BadInput(f"{self.folder}: ninja {target} failed without an error of the compiler:\n"
                           f"{done.output[-2000:]}")
        return Built(False, seconds, error.group().replace(f"{self.tree}/", ""))

    def read_dependencies(self):
        """Counts object files by header: call it when all programs are built."""
        done = self.run(["ninja", "-C", str(self.folder), "-t", "deps"])
        self.objects = {}
        for line in done.output.splitlines():
            if line.startswith(f"    {self.tree}/"):
                name = line.strip().removeprefix(f"{self.tree}/")
                self.objects[name] = self.objects.get(name, 0) + 1

    def objects_of(self, file):
        """Number of object files that are compiled when the file changes."""
        return self.objects.get(file, 0)
