"""The test programs: maps modules to them, and runs them."""

import contextlib
import json
import os
import re
import resource
import subprocess
import sys
import tempfile
import time
from dataclasses import asdict, dataclass, field
from pathlib import Path

from . import BadInput
from .processes import end_group

# The module's own program first, then those of modules that include it, the quick ones first. They run in this order until one
# detects the change. Modules that are not listed are checked by their own program only. NAME.py is a script of tests/app, which
# uses the program itself.
PROGRAMS = {
    "app": ("app_tests", "record_tests", "window_tests", "save_commands_test.py", "cli_test.py", "help_test.py",
            "dump_test.py", "packs_test.py"),
    "base": ("base_tests", "world_tests", "store_tests", "formats_tests", "net_tests"),
    "content": ("content_tests", "app_tests", "pack_tests"),
    "gen": ("gen_tests", "lua_tests", "map_tests", "volume_tests", "stream_tests", "game_tests", "pack_tests"),
    "game": ("game_tests", "net_tests"),
    "gpu": ("gpu_tests", "gen_gpu_tests", "mesh_gpu_tests", "render_tests"),
    "io": ("io_tests", "web_tests", "dump_test.py", "save_commands_test.py"),
    "light": ("light_tests", "volume_tests", "stream_tests", "game_tests"),
    "map": ("map_tests", "web_tests"),
    "mesh": ("mesh_tests", "formats_tests", "stream_tests", "game_tests"),
    "net": ("net_tests", "net_postgres_tests"),
    "net_postgres": ("net_postgres_tests",),
    "pack": ("pack_tests", "packs_test.py"),
    "render": ("render_tests", "golden_tests", "view_tests"),
    "shared": ("shared_tests", "world_tests", "gen_tests", "mesh_tests", "render_tests"),
    "sound": ("sound_tests", "window_tests"),
    "store": ("store_tests", "faults_tests", "map_tests", "volume_tests", "stream_tests", "game_tests", "pack_tests",
              "store_postgres_tests"),
    "store_postgres": ("store_postgres_tests", "net_postgres_tests"),
    "stream": ("stream_tests", "game_tests", "faults_tests", "net_tests", "view_tests"),
    "video": ("record_tests", "record_test.py"),
    "view": ("view_tests", "golden_tests"),
    "world": ("world_tests", "mesh_tests", "light_tests", "game_tests", "store_tests", "stream_tests"),
}
ONE_PROCESS = ("store_postgres_tests", "net_postgres_tests")  # each process starts a database server
# The program of another module is not built for a header that more object files than this include.
MOST_OBJECTS = 40

QUICK_SECONDS = 0.3  # tests that take longer run after the others
UNCHANGED_LIMIT_SECONDS = 3600
MEMORY_BYTES = 8 << 30  # of address space: a change may request any size
FILE_BYTES = 24 << 30  # a test makes a sparse file of 20 GiB
OUTPUT_BYTES = 1 << 20  # read from each end of a program's output: an endless loop may write any size


def programs_of(module, targets):
    """The programs of a module that exist in the build."""
    programs = PROGRAMS.get(module, (f"{module}_tests",))
    if programs[0] not in targets:
        raise BadInput(f"module {module}: the build has no program {programs[0]}")
    return [program for program in programs if target_of(program) in targets]


def target_of(program):
    """What is built for it."""
    return "terrane" if program.endswith(".py") else program


@dataclass
class Unchanged:
    """The test results of a program without a change."""
    slow: list = field(default_factory=list)  # names of tests
    failing: list = field(default_factory=list)  # skipped: they would detect every change
    quick_seconds: float = 0.0  # of all quick tests, one after the other
    slow_seconds: float = 0.0
    longest_seconds: float = 0.0


@dataclass
class Run:
    kind: str  # "passed", "noticed" or "timed_out"
    seconds: float
    test: str = ""  # that failed or did not end


class Program:
    def __init__(self, path, jobs, patience=3, script=None):
        self.path = path
        self.command = [str(path)] if script is None else [sys.executable, "-B", str(script), str(path)]
        self.is_script = script is not None
        self.jobs = 1 if self.is_script or path.name in ONE_PROCESS else jobs
        self.patience = patience  # factor on the time without a change, after which tests count as hanging

    def measure(self):
        with scratch_folder() as folder:
            if self.is_script:
                run = self.run_shards([], UNCHANGED_LIMIT_SECONDS, folder, fails_fast=False)
                if run.kind != "passed":
                    raise BadInput(f"{self.command[2]}: fails unchanged")
                return Unchanged(quick_seconds=run.seconds, longest_seconds=run.seconds)
            run = self.run_shards(["--gtest_output=json:{folder}/{shard}.json"], UNCHANGED_LIMIT_SECONDS, folder,
                                  fails_fast=False)
            reports = list(folder.glob("*.json"))
            if len(reports) < self.jobs:
                raise BadInput(f"{self.path}: crashes or hangs unchanged, in {run.test or 'no test'}")
            return unchanged_of([json.loads(path.read_text(encoding="utf-8")) for path in reports])

    def run(self, unchanged):
        """The quick tests, then the others, until one fails; a script as a whole."""
        not_quick = ":".join(unchanged.slow + unchanged.failing)
        runs = [([] if self.is_script else [f"--gtest_filter=*-{not_quick}"], unchanged.quick_seconds, QUICK_SECONDS)]
        if unchanged.slow:
            options = [f"--gtest_filter={':'.join(unchanged.slow)}"]
            runs.append((options, unchanged.slow_seconds, unchanged.longest_seconds))
        seconds = 0.0
        for options, unchanged_seconds, longest in runs:
            limit = 10 + self.patience * max(unchanged_seconds / self.jobs, longest)
            with scratch_folder() as folder:
                run = self.run_shards(options, limit, folder, fails_fast=True)
            seconds += run.seconds
            if run.kind != "passed":
                break
        return Run(run.kind, seconds, run.test)

    def run_shards(self, options, limit_seconds, folder, fails_fast):
        start = time.monotonic()
        shards = [self.start(options, folder, shard, fails_fast) for shard in range(self.jobs)]
        kind = None
        try:
            while kind is None:
                codes = [shard.poll() for shard in shards]
                if any(codes) and (fails_fast or None not in codes):
                    kind = "noticed"
                elif None not in codes:
                    kind = "passed"
                elif time.monotonic() - start > limit_seconds:
                    kind = "timed_out"
                else:
                    time.sleep(0.02)
        finally:
            for shard in shards:
                end_group(shard)
        failed = [k for k, code in enumerate(codes) if code or (code is None and kind == "timed_out")]
        test = test_that_failed(read_output(folder / f"{failed[0]}.txt")) if failed else ""
        return Run(kind, time.monotonic() - start, test)

    def start(self, options, folder, shard, fails_fast):
        home = folder / f"shard_{shard}"
        home.mkdir()
        environment = {**os.environ, "TMPDIR": str(home), "GTEST_TOTAL_SHARDS": str(self.jobs),
                       "GTEST_SHARD_INDEX": str(shard), "GTEST_FAIL_FAST": str(int(fails_fast)), "GTEST_COLOR": "no",
                       "GTEST_BRIEF": "0"}
        command = self.command + [option.format(folder=folder, shard=shard) for option in options]
        with open(folder / f"{shard}.txt", "wb") as output:
            return subprocess.Popen(command, cwd=home, env=environment, stdin=subprocess.DEVNULL, stdout=output,
                                    stderr=subprocess.STDOUT, start_new_session=True, preexec_fn=set_limits)


@contextlib.contextmanager
def scratch_folder():
    with tempfile.TemporaryDirectory(prefix="terrane_mutate_", ignore_cleanup_errors=True) as folder:
        os.chmod(folder, 0o711)  # database servers run as another user
        yield Path(folder)


def set_limits():
    limits = {resource.RLIMIT_AS: MEMORY_BYTES, resource.RLIMIT_FSIZE: FILE_BYTES, resource.RLIMIT_CORE: 0}
    for kind, size in limits.items():
        most = resource.getrlimit(kind)[1]
        resource.setrlimit(kind, (size if most == resource.RLIM_INFINITY else min(size, most), most))


def read_output(path):
    with open(path, "rb") as file:
        text = file.read(OUTPUT_BYTES)
        size = path.stat().st_size
        if size > OUTPUT_BYTES:
            file.seek(max(OUTPUT_BYTES, size - OUTPUT_BYTES))
            text += b"\n" + file.read(OUTPUT_BYTES)
    return text.decode(errors="replace")


def test_that_failed(output):
    """The first failed test, else the running one."""
    failed = re.search(r"^\[  FAILED  \] ([^\s,]+)|^(?:FAIL|ERROR): (\S+)", output, re.MULTILINE)
    if failed:
        return failed.group(1) or failed.group(2)
    running = re.findall(r"^\[ RUN      \] (\S+)", output, re.MULTILINE)
    return running[-1] if running else ""


def unchanged_of(reports):
    """From what GoogleTest writes with --gtest_output=json."""
    unchanged = Unchanged()
    for suite in (suite for report in reports for suite in report["testsuites"]):
        for test in suite["testsuite"]:
            if test["status"] != "RUN":
                continue
            name, seconds = f"{suite['name']}.{test['name']}", float(test["time"].rstrip("s"))
            unchanged.longest_seconds = max(unchanged.longest_seconds, seconds)
            if "failures" in test:
                unchanged.failing.append(name)
            elif seconds > QUICK_SECONDS:
                unchanged.slow.append(name)
                unchanged.slow_seconds += seconds
            else:
                unchanged.quick_seconds += seconds
    unchanged.slow.sort()
    unchanged.failing.sort()
    return unchanged


class Unchangeds:
    """Measurements of these sources, kept in a file for resumed runs."""

    def __init__(self, path, digest):
        self.path = path
        self.digest = digest
        self.by_program = {}
        known = json.loads(path.read_text()) if path.exists() else {}
        if known.get("sources") == digest:
            self.by_program = {name: Unchanged(**entry) for name, entry in known["programs"].items()}

    def add(self, name, unchanged):
        self.by_program[name] = unchanged
        programs = {key: asdict(entry) for key, entry in self.by_program.items()}
        whole = self.path.with_suffix(".new")  # a run may be stopped at any moment
        whole.write_text(json.dumps({"sources": self.digest, "programs": programs}, indent=1) + "\n")
        whole.replace(self.path)
