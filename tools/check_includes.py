#!/usr/bin/env python3
"""Compares the includes of the sources with the layer table of docs/architecture.md.

    check_includes.py [ROOT]      prints each breach as "file:line: …" and exits 1, or prints counts
    check_includes.py --self-test checks this script on small trees with and without breaches

A breach is an #include "terrane/…" or "apps/…" that the includer's row does not allow, a folder without a row, a row
without a folder, a row that allows an unknown module, or a cycle between rows.
"""

import re
import sys
import tempfile
from pathlib import Path

TABLE = "docs/architecture.md"
SUFFIXES = {".h", ".cpp", ".glsl"}
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]((?:terrane|apps)/[^">]+)[">]')
ROW = re.compile(r"^\|\s*`([^`]+)`\s*\|[^|]*\|([^|]*)\|\s*$")


class Row:
    def __init__(self, line, allowed):
        self.line = line
        self.allowed = allowed


def read_table(root, breaches):
    """Rows by module name: "mesh" is terrane/mesh, "apps/terrane" is itself."""
    rows = {}
    for number, line in enumerate((root / TABLE).read_text(encoding="utf-8").splitlines(), 1):
        match = ROW.match(line)
        if not match:
            continue
        name, cell = match.groups()
        if name in rows:
            breaches.append(f"{TABLE}:{number}: module {name} has a second row")
        rows[name] = Row(number, [word for word in cell.replace("`", "").split() if word not in ("–", "-")])
    if not rows:
        breaches.append(f"{TABLE}:1: no row of the module table was found")
    return rows


def module_folders(root):
    """Folders by module name."""
    folders = {}
    for parent, prefix in (("terrane", ""), ("apps", "apps/")):
        if (root / parent).is_dir():
            folders.update((prefix + f.name, f) for f in sorted((root / parent).iterdir()) if f.is_dir())
    return folders


def module_of(path):
    """The module that a path names, relative to the root: "terrane/mesh/a.h" is in "mesh"."""
    parts = path.split("/")
    return parts[1] if parts[0] == "terrane" else "/".join(parts[:2])


def check_rows(root, rows, breaches):
    folders = module_folders(root)
    for name, row in rows.items():
        if name not in folders:
            breaches.append(f"{TABLE}:{row.line}: module {name} has no folder")
        for other in row.allowed:
            if other not in rows:
                breaches.append(f"{TABLE}:{row.line}: module {name} may include {other}, which has no row")
    for name, folder in folders.items():
        if name not in rows:
            breaches.append(f"{folder.relative_to(root).as_posix()}:1: module {name} has no row in {TABLE}")
    return folders


def check_cycles(rows, breaches):
    finished = set()

    def visit(name, trail):
        if name in trail:
            cycle = " → ".join(trail[trail.index(name):] + [name])
            breaches.append(f"{TABLE}:{rows[name].line}: the modules include each other: {cycle}")
        elif name in rows and name not in finished:
            for other in rows[name].allowed:
                visit(other, trail + [name])
            finished.add(name)

    for name in rows:
        visit(name, [])


def check_file(path, shown, allowed, breaches):
    """Returns the number of includes looked at. `allowed` holds the module itself too, first."""
    count = 0
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        count += 1
        included = module_of(match.group(1))
        if included not in allowed:
            breaches.append(f"{shown}:{number}: module {allowed[0]} may not include {included}")
    return count


def check_tree(root):
    """Returns the breaches and a line of counts."""
    breaches = []
    rows = read_table(root, breaches)
    folders = check_rows(root, rows, breaches)
    check_cycles(rows, breaches)
    file_count = include_count = 0
    for name, folder in folders.items():
        if name not in rows:
            continue
        for path in sorted(folder.rglob("*")):
            if path.suffix in SUFFIXES and path.is_file():
                file_count += 1
                shown = path.relative_to(root).as_posix()
                include_count += check_file(path, shown, [name] + rows[name].allowed, breaches)
    return breaches, f"{len(rows)} modules, {file_count} files, {include_count} includes: all allowed"


TEST_HEADER = "| module | holds | may include |\n|---|---|---|\n"
GOOD_TABLE = "| `base` | x | – |\n| `mesh` | y | base |\n| `apps/terrane` | z | base mesh |\n"
GOOD_FILES = {
    "terrane/base/a.h": "#pragma once\n",
    "terrane/mesh/m.cpp": '#include "terrane/mesh/m.h"\n#include "terrane/base/a.h"\n#include <vector>\n',
    "apps/terrane/main.cpp": '#include "terrane/mesh/m.h"\n',
}
# Name, table, files beside the good ones, expected breaches (None: any).
TEST_CASES = [
    ("a good tree", GOOD_TABLE, {}, []),
    ("C++ breach", GOOD_TABLE, {"terrane/base/b.h": '\n#include "terrane/mesh/m.h"\n'},
     ["terrane/base/b.h:2: module base may not include mesh"]),
    ("shader breach", GOOD_TABLE, {"terrane/mesh/s/m.frag.glsl": '  #  include "terrane/gpu/x.h"\n'},
     ["terrane/mesh/s/m.frag.glsl:1: module mesh may not include gpu"]),
    ("app included", GOOD_TABLE, {"terrane/base/b.cpp": '#include "apps/terrane/ui.h"\n'},
     ["terrane/base/b.cpp:1: module base may not include apps/terrane"]),
    ("comment", GOOD_TABLE, {"terrane/base/b.cpp": '// #include "terrane/mesh/m.h"\n'}, []),
    ("folder without row", GOOD_TABLE, {"terrane/extra/e.h": ""},
     ["terrane/extra:1: module extra has no row in docs/architecture.md"]),
    ("row without folder", GOOD_TABLE + "| `gone` | | – |\n", {},
     ["docs/architecture.md:6: module gone has no folder"]),
    ("unknown name", GOOD_TABLE.replace("| base |", "| base lost |"), {},
     ["docs/architecture.md:4: module mesh may include lost, which has no row"]),
    ("cycle", GOOD_TABLE.replace("| – |", "| mesh |"), {},
     ["docs/architecture.md:3: the modules include each other: base → mesh → base"]),
    ("no table", "", {}, None),
]


def self_test():
    failed = 0
    for name, table, extra, expected in TEST_CASES:
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for path, text in {TABLE: TEST_HEADER + table, **GOOD_FILES, **extra}.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text, encoding="utf-8")
            breaches, _ = check_tree(root)
        if breaches != expected and not (expected is None and breaches):
            failed += 1
            print(f"{name}: expected {expected}, got {breaches}")
    print(f"self-test: {len(TEST_CASES) - failed} of {len(TEST_CASES)} cases pass")
    return 1 if failed else 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    root = Path(arguments[0]) if arguments else Path(__file__).resolve().parent.parent
    breaches, counts = check_tree(root)
    print("\n".join(breaches) if breaches else counts)
    return 1 if breaches else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
