"""The command line."""

import argparse
import signal
import sys
from dataclasses import replace
from pathlib import Path

from . import BadInput
from .build import Build
from .draw import Draw
from .places import modules_of, places_of_module, read_source
from .programs import Unchangeds
from .report import report_of
from .results import Results
from .tree import Tree, digest_of
from .trial import Trial, place_now

ROOT = Path(__file__).resolve().parent.parent.parent
MOST_NOT_COMPILED = 20  # in a row: the build is broken


def main(arguments, description):
    parser = argparse.ArgumentParser(prog="mutate.py", description=description,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=200, help="of places (200)")
    parser.add_argument("--seed", type=int, default=1, help="of the draw (1)")
    parser.add_argument("--modules", metavar="NAMES", help="with commas; app is the program (all modules)")
    parser.add_argument("-j", "--jobs", type=int, default=2, help="compilers, and processes of a test program (2)")
    parser.add_argument("--patience", type=float, default=3, metavar="N", help="tests hang if they take N times as long as "
                        "without a change (3); more on a machine that does other work")
    parser.add_argument("--again", action="store_true", help="try again what was not noticed")
    parser.add_argument("-o", "--output", type=Path, metavar="FOLDER", help="for the copy, its build and the results")
    parser.add_argument("--report", type=Path, metavar="FOLDER", help="only print the tables of these results")
    options = parser.parse_args(arguments)
    if (options.output is None) == (options.report is None):
        parser.error("expected either -o FOLDER or --report FOLDER")
    if min(options.count, options.jobs, options.patience) < 1:
        parser.error("--count, --jobs and --patience: expected a number from 1")
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # ends running programs
    try:
        if options.report:
            print(report_of(with_settings(Results(options.report / "results.jsonl").read())))
        elif options.again:
            try_again(options)
        else:
            try_places(options)
    except BadInput as error:
        return fail(error)
    except OSError as error:
        return fail(f"{error.filename}: {error.strerror}")
    except KeyboardInterrupt:
        return fail("stopped; the same command continues")
    return 0


def fail(message):
    print(f"mutate: {message}", file=sys.stderr)
    return 2


def tell(message):
    print(f"mutate: {message}", flush=True)


def with_settings(results):
    if results.settings is None:
        raise BadInput(f"{results.path}: holds no results")
    return results


def prepare(options, modules):
    """Copies, builds and measures; skips steps without changes since the last run."""
    output = options.output.resolve()
    output.mkdir(parents=True, exist_ok=True)
    tree = Tree(ROOT, output / "tree")
    tree.root.mkdir(exist_ok=True)
    unchangeds = Unchangeds(output / "unchanged.json", tree.update())
    build = Build(tree.root, output / "build", options.jobs)
    build.configure()
    trial = Trial(tree.root, build, unchangeds, options)
    trial.prepare(modules, tell)
    return trial


def try_places(options):
    results = Results(options.output / "results.jsonl").read()
    modules = options.modules.split(",") if options.modules else modules_of(ROOT)
    for module in modules:
        if module not in modules_of(ROOT):
            raise BadInput(f"--modules: there is no module {module}")
    settings = {"count": options.count, "seed": options.seed, "modules": modules, "sources": digest_of(ROOT, modules)}
    if results.settings not in (None, settings):
        raise BadInput(f"{results.path}: is of other settings or other sources; use an empty folder, or --again")
    found = {module: places_of_module(ROOT, module) for module in modules}
    draw = Draw({module: places for module, (places, _) in found.items()},
                {module: lines for module, (_, lines) in found.items()}, options.count, options.seed)
    trial = prepare(options, modules)
    if results.settings is None:
        results.begin(settings)
    try_slots(draw, trial, results)
    print(report_of(results))


def try_slots(draw, trial, results):
    """Fills the slots in order; earlier results fill the first ones of their module."""
    tried = {result.place for result in results.first_tries()}
    filled = {module: 0 for module in draw.places}
    for result in results.first_tries():
        filled[result.place.module] += result.outcome != "not_compiled"
    not_compiled = 0
    for number, module in enumerate(draw.slots, 1):
        if filled[module]:
            filled[module] -= 1
            continue
        for place in (place for place in draw.places[module] if place not in tried):
            tried.add(place)
            result = trial.run(place)
            results.add(result)
            tell(f"{number} of {len(draw.slots)}: {line_of(result)}")
            not_compiled = not_compiled + 1 if result.outcome == "not_compiled" else 0
            if not_compiled > MOST_NOT_COMPILED:
                raise BadInput(f"{not_compiled} changes in a row do not compile: {result.by}")
            if not not_compiled:
                break
        else:
            tell(f"module {module} has no more places")


def try_again(options):
    results = with_settings(Results(options.output / "results.jsonl").read())
    missed = [result for result in results.latest() if result.outcome == "not_noticed"]
    trial = prepare(options, sorted({result.place.module for result in missed}))
    for number, result in enumerate(missed, 1):
        path = trial.tree / result.place.file
        place = place_now(result, read_source(path)) if path.exists() else None
        if place is None:
            tell(f"{number} of {len(missed)}: {result.place.file}:{result.place.line}: the line is no longer there")
            continue
        again = replace(trial.run(place), place=result.place, place_now=place)
        results.add(again)
        tell(f"{number} of {len(missed)}: {line_of(again)}")
    print(report_of(results))


def line_of(result):
    place, seconds = result.place_now or result.place, result.build_seconds + result.test_seconds
    return (f"{place.file}:{place.line}: {place.old} → {place.new}: {result.outcome.replace('_', ' ')}"
            f"{f' by {result.by}' if result.by else ''} ({seconds:.0f} s)")
