#!/usr/bin/python3
"""Makes tables and plots from the measurements of `terrane bench`.

    terrane bench -o FOLDER [TABLE...]
    bench_report.py FOLDER [TABLE...] [-o DIR]

Reads FOLDER/results.jsonl and writes report.md, tables/NAME.csv and plots/NAME.svg into DIR (FOLDER unless told): the
named tables, or all tables with a measurement. A missing measurement leaves an empty cell. Needs pandas and matplotlib
(Debian: python3-pandas, python3-matplotlib). Exit code: 0, or 2 if something cannot be read or written.
"""

import sys

if __name__ == "__main__":
    try:
        from bench_report.command import main
    except ModuleNotFoundError as error:
        print(f"bench_report: {error}; needed are the Debian packages python3-pandas and python3-matplotlib",
              file=sys.stderr)
        sys.exit(2)
    sys.exit(main(sys.argv[1:], __doc__))
