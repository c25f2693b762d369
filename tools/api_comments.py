#!/usr/bin/env python3
"""Prints a header with its comments in Doxygen's form, both before a declaration and after it on its line.
Doxygen's INPUT_FILTER (docs/Doxyfile). Usage: api_comments.py HEADER"""
import re
import sys

BEFORE = re.compile(r"^(\s*)// ?(.*)$")
BEHIND = re.compile(r"^(\s*[^\s/].*[;,{}]) +// (.*)$")


def escaped(text):
    """Escapes text that is special in Doxygen or HTML."""
    return re.sub(r"([<>#@\\&])", r"\\\1", text)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        for number, line in enumerate(file.read().split("\n")):
            if before := BEFORE.match(line):
                if number == 0:
                    print("/// @file")
                print(f"{before[1]}/// {escaped(before[2])}")
            elif behind := BEHIND.match(line):
                print(f"{behind[1]} ///< {escaped(behind[2])}")
            else:
                print(line)


main()
