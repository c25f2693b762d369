#!/usr/bin/env python3
"""Which lines and branches of the modules the tests run, as a Markdown table: at the gate's depth, at full depth, or both.

    coverage.py [gate] [all] [--build build-coverage]

Builds with Clang's coverage, which takes a while, and runs all tests at each depth. A process that is killed counts for nothing.
Needs clang, lld, llvm and the packages of the tests. Exit code: 0, or 2 if something cannot be built or read; tests that fail
are only told."""
import argparse
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
FLAGS = "-fprofile-instr-generate -fcoverage-mapping -fcoverage-compilation-dir=."
SETTINGS = {
    "CMAKE_BUILD_TYPE": "Coverage",  # not a known type: only these flags
    "CMAKE_CXX_COMPILER": "clang++",
    "CMAKE_CXX_FLAGS_COVERAGE": f"-O1 {FLAGS}",
    "CMAKE_EXE_LINKER_FLAGS": "-fuse-ld=lld",
    "CMAKE_UNITY_BUILD": "ON",
    "TERRANE_BENCHMARKS": "OFF",
}
DEPTHS = ("gate", "all")
COUNTED = ("lines", "branches")


class BadBuild(Exception):
    """One line that says what failed."""


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], check=False, **options)
    if done.returncode != 0:
        raise BadBuild(f"{command[0]} {command[1]} ended with {done.returncode}")
    return done


def build(folder):
    run("cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "--log-level=WARNING", *[f"-D{k}={v}" for k, v in SETTINGS.items()])
    run("cmake", "--build", folder)


def run_tests(folder, depth):
    """Returns the merged profile."""
    raw = folder / f"profiles_{depth}"
    raw.mkdir(exist_ok=True)
    for old in raw.iterdir():
        old.unlink()
    environment = {**os.environ, "TERRANE_DEPTH": depth, "LLVM_PROFILE_FILE": f"{raw}/%4m.profraw"}  # %4m: four files for each program
    tests = subprocess.run(["ctest", "--test-dir", folder, "--parallel", "3", "--timeout", "7200"], env=environment, check=False)
    if tests.returncode != 0:
        print(f"coverage: tests failed at depth {depth}", file=sys.stderr)
    merged = folder / f"{depth}.profdata"
    run("llvm-profdata", "merge", "--failure-mode=all", "-o", merged, *raw.glob("*.profraw"))
    return merged


def programs_of(folder):
    return sorted(folder.glob("*_tests")) + [folder / "terrane"]


def module_of(path):
    """Of a file below terrane or apps; None for tests and what the build generates."""
    parts = pathlib.PurePath(os.path.relpath(path, ROOT) if os.path.isabs(path) else path).parts
    if parts[0] == "apps":
        return "app"
    return parts[1] if parts[0] == "terrane" else None


def counts_of(folder, profile):
    """[covered, all] of lines and branches, by module."""
    programs = programs_of(folder)
    objects = [word for program in programs[1:] for word in ("-object", program)]
    done = run("llvm-cov", "export", "-summary-only", f"-instr-profile={profile}", programs[0], *objects, stdout=subprocess.PIPE, text=True)
    counts = {}
    for file in json.loads(done.stdout)["data"][0]["files"]:
        module = module_of(file["filename"])
        if module is None:
            continue
        for what in COUNTED:
            count = counts.setdefault(module, {what: [0, 0] for what in COUNTED})[what]
            count[0] += file["summary"][what]["covered"]
            count[1] += file["summary"][what]["count"]
    return counts


def percent(count):
    return f"{100 * count[0] / count[1]:.1f}" if count[1] else "–"


def table_of(counts_by_depth):
    """counts_by_depth: what counts_of returns, by depth."""
    modules = sorted({module for counts in counts_by_depth.values() for module in counts})
    columns = [(depth, what) for what in COUNTED for depth in counts_by_depth]
    rows = [["module"] + [f"{what} % ({depth})" for depth, what in columns], ["---"] * (len(columns) + 1)]
    rows += [[module] + [percent(counts_by_depth[depth].get(module, {what: [0, 0]})[what]) for depth, what in columns]
             for module in modules]
    totals = [[sum(counts[what][k] for counts in counts_by_depth[depth].values()) for k in (0, 1)] for depth, what in columns]
    rows.append(["all"] + [percent(total) for total in totals])
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("depths", nargs="*", metavar="DEPTH", help="gate or all (both)")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build-coverage", metavar="FOLDER")
    options = parser.parse_args(arguments)
    if not set(options.depths) <= set(DEPTHS):
        parser.error("expected depths: gate, all")
    folder = options.build.resolve()
    try:
        build(folder)
        print(table_of({depth: counts_of(folder, run_tests(folder, depth)) for depth in options.depths or DEPTHS}))
    except (BadBuild, OSError) as error:
        print(f"coverage: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
