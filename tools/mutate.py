#!/usr/bin/env python3
"""Mutation runs: changes one operator or constant at a time and counts the changes that the tests detect.

    mutate.py [--count 200] [--seed 1] [--modules gen,light] -o FOLDER
    mutate.py -o FOLDER --again     tries the undetected changes again, on the current sources
    mutate.py --report FOLDER       prints the tables

The places are drawn at random, in proportion to the modules' lines of code. FOLDER receives a copy of the sources
(tree), a build of it (build) and results.jsonl; the checkout stays as it is. The same command continues a run that
was stopped. A change that does not compile is replaced by another place of its module. Needs CMake, Ninja and the
packages that Terrane's tests need; uses clang++, lld and ccache if they are installed. Exit code: 0, or 2 if
something cannot be read, written, built or tested.
"""

import sys

from mutate.command import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:], __doc__))
