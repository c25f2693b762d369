"""The command line."""

import argparse
import pathlib
import sys

from .cells import settings_of
from .report import all_tables, write_report
from .results import BadInput, read_results


def main(arguments, description):
    parser = argparse.ArgumentParser(prog="bench_report.py", description=description,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, metavar="FOLDER", help="folder written by terrane bench")
    parser.add_argument("only", nargs="*", metavar="TABLE",
                        help="write only these tables; cells without a measurement stay empty")
    parser.add_argument("-o", "--output", type=pathlib.Path, metavar="DIR", help="folder for the report (FOLDER)")
    options = parser.parse_args(arguments)
    try:
        results = read_results(options.folder / "results.jsonl")
        settings = settings_of(results)
        tables = chosen_tables(all_tables(settings), options.only, results)
        write_report(options.output or options.folder, results, tables, settings.is_quick)
    except BadInput as error:
        return fail(error)
    except OSError as error:
        return fail(f"{error.filename}: cannot be written: {error.strerror}")
    return 0


def chosen_tables(tables, names, results):
    for name in names:
        if name not in [table.name for table in tables]:
            known = ", ".join(table.name for table in tables)
            raise BadInput(f"no table {name}; there are {known}")
    if names:
        return [table for table in tables if table.name in names]
    return [table for table in tables if any(map(results.was_tried, table.cells()))]


def fail(message):
    print(f"bench_report: {message}", file=sys.stderr)
    return 2
