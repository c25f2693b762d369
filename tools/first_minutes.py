#!/usr/bin/env python3
"""Does what the pages of docs/start say, step by step, and measures the time of each step.

    tools/first_minutes.py [PAGE…] [--home FOLDER] [-o REPORT.md]

PAGE: player, library, game, server, pack, python (all, in this order). Every command and every promised output must be
quoted in its page. Windows open on a virtual display, and keys are pressed by xdotool. The home folder receives worlds
and packs; it must be new (a folder of its own below /tmp).

    tools/fresh_debian.sh bookworm /tmp/fresh bash -c \
        'apt-get update && apt-get install -y python3 && tools/first_minutes.py --install'

--install: first install what the pages or this script need besides ./run: Debian's packages python3-numpy, python3-dev,
pybind11-dev, libglfw3-dev, sqlite3, zip, xvfb, xdotool. Exit code 1 if a step does not do what its page says."""
import argparse
import pathlib
import subprocess
import sys
import tempfile

from first_minutes import windows, without_windows
from first_minutes.page import Page, PageError

PACKAGES = ("pybind11-dev", "python3-dev", "python3-numpy", "libglfw3-dev", "sqlite3", "zip", "xvfb", "xdotool")
PAGES = {"player": windows.player, "library": without_windows.library, "game": windows.game, "server": windows.server,
         "pack": windows.pack, "rules": windows.rules, "python": without_windows.python}
SOURCE = pathlib.Path(__file__).resolve().parent.parent


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="*", metavar="PAGE")
    parser.add_argument("--home", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path)
    parser.add_argument("--install", action="store_true")
    options = parser.parse_args()
    if unknown := set(options.pages) - set(PAGES):
        parser.error(f"no page {', '.join(sorted(unknown))}; there are {', '.join(PAGES)}")
    return options


def report(pages):
    lines = ["| page | step | seconds |", "|---|---|---|"]
    for page in pages:
        lines += [f"| {page.name} | {step} | {seconds:.0f} |" for step, seconds in page.times.items()]
        minutes = sum(page.times.values()) / 60
        lines.append(f"| **{page.name}** | **all** | **{minutes:.1f} minutes** |")
    return "\n".join(lines) + "\n"


def main():
    options = parse()
    if options.install:
        subprocess.run(["apt-get", "install", "-q", "-y", "--no-install-recommends", *PACKAGES], check=True)
    home = options.home or pathlib.Path(tempfile.mkdtemp(prefix="first_minutes_"))
    home.mkdir(parents=True, exist_ok=True)
    done, is_good = [], True
    for name in options.pages or PAGES:
        page = Page(name, SOURCE, home)
        done.append(page)
        try:
            PAGES[name](page)
        except PageError as error:
            is_good = False
            print(f"{name}: {error}", file=sys.stderr)
        finally:
            page.close()
    print(report(done), end="")
    if options.output:
        options.output.write_text(report(done), encoding="utf-8")
    return 0 if is_good else 1


if __name__ == "__main__":
    sys.exit(main())
