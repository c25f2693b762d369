#!/usr/bin/env python3
"""Checks the pages README.md, CHANGELOG.md and docs/**/*.md. Usage: links_test.py ROOT [PROGRAM]

- Relative links and images name files that exist; "#heading" names a heading, by the anchors that GitHub makes.
- Each page of docs/ can be reached by links from docs/index.md, and is in the navigation of the site (mkdocs.yml).
- Commands in code ("terrane map --radius 8") use subcommands and options of PROGRAM. CHANGELOG.md, which names former
  ones, is skipped; so are all commands without PROGRAM, or if it is built without graphics.
"""

import concurrent.futures
import functools
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

HANG_SECONDS = 60
START = "docs/index.md"
SITE = "mkdocs.yml"
# Code that is not a command of the program: an option that a tutorial adds, bytes that a client signs.
EXCEPTIONS = {("docs/contributing.md", "terrane render has no option --sepia"),
              ("docs/protocol.md", "terrane has no subcommand login")}

FENCE = re.compile(r"^( {0,3})(`{3,}|~{3,})(.*)$")
CODE_SPAN = re.compile(r"(?<!`)(`+)(?!`)((?:(?!\n\s*\n).)+?)(?<!`)\1(?!`)", re.DOTALL)
LINK = re.compile(r"\]\(\s*<?([^\s()<>]*(?:\([^\s()]*\)[^\s()<>]*)*)>?(?:\s+\"[^\"]*\")?\s*\)")
REFERENCE = re.compile(r"^ {0,3}\[[^\]]+\]:\s*<?(\S+?)>?(?:\s|$)", re.MULTILINE)
ATTRIBUTE = re.compile(r"<(?:img|a)\b[^>]*?\b(?:src|href)=[\"']([^\"']+)[\"']", re.IGNORECASE)
HEADING = re.compile(r"^ {0,3}#{1,6}\s+(.*?)\s*#*\s*$", re.MULTILINE)
ANCHOR = re.compile(r"<[^>]*\b(?:id|name)=[\"']([^\"']+)[\"']", re.IGNORECASE)
NAVIGATION = re.compile(r"^ +- .*: (\S+\.md)$", re.MULTILINE)
COMMAND = re.compile(r"^(?:\$ )?(?:[A-Z_]+=\S* )*(?:xvfb-run (?:-\S+ )*|sudo )?(?:[\w.~$/-]*/)?terrane(?: |$)(.*)$")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z0-9-]*")


def blanked(text):
    """The text with all characters but line ends replaced by spaces, to keep line numbers."""
    return re.sub(r"[^\n]", " ", text)


class Page:
    """A Markdown file: its text without code, and its code."""

    def __init__(self, path):
        self.path = path
        self.code = []  # (line number, text): lines of code blocks, and code spans
        prose = self._without_blocks(path.read_text(encoding="utf-8").split("\n"))
        self.with_spans = prose
        self.prose = CODE_SPAN.sub(self._take_span, prose)

    def _without_blocks(self, lines):
        kept, fence, follows_blank, in_list = [], None, True, False
        for number, line in enumerate(lines, 1):
            match = FENCE.match(line)
            if fence:
                is_end = match and match[2].startswith(fence) and not match[3].strip()
                if not is_end:
                    self.code.append((number, line.strip()))
                fence = None if is_end else fence
                kept.append("")
            elif match:
                fence = match[2]
                kept.append("")
            elif line.startswith("    ") and line.strip() and follows_blank:
                self.code.append((number, line.strip()))
                # In a list an indented line may be a paragraph: check its links.
                kept.append(line if in_list else "")
                continue  # the next indented line belongs to the same block
            else:
                kept.append(line)
                if line.strip() and not line.startswith(" "):
                    in_list = bool(re.match(r"([-*+]|\d+\.)\s", line))
            follows_blank = not line.strip()
        return "\n".join(kept)

    def _take_span(self, match):
        number = match.string.count("\n", 0, match.start()) + 1
        self.code.append((number, " ".join(match[2].split())))
        return blanked(match[0])

    def links(self):
        """(line number, target) of all links and images."""
        for pattern in (LINK, REFERENCE, ATTRIBUTE):
            for match in pattern.finditer(self.prose):
                yield self.prose.count("\n", 0, match.start(1)) + 1, match[1]

    @functools.cached_property
    def anchors(self):
        names = set(ANCHOR.findall(self.prose))
        counts = {}
        for heading in HEADING.findall(self.with_spans):
            slug = slug_of(heading)
            count = counts.get(slug, 0)
            counts[slug] = count + 1
            names.add(f"{slug}-{count}" if count else slug)
        return names

    def commands(self):
        """(line number, text after "terrane") of all commands in code; "\\" at the end of a line continues it."""
        begun = None
        for number, text in self.code:
            if begun:
                number, text = begun[0], f"{begun[1]} {text}"
            begun = (number, text[:-1].rstrip()) if text.endswith("\\") else None
            if begun:
                continue
            for part in re.split(r"&&|\|\||[|;]\s", text):
                match = COMMAND.match(part.strip())
                if match:
                    yield number, match[1]


def slug_of(heading):
    """The anchor that GitHub makes of a heading."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    text = re.sub(r"[^\w\- ]", "", text.replace("`", "").lower())
    return text.replace(" ", "-")


class Program:
    """The subcommands and options that --help lists."""

    def __init__(self, path):
        self.path = path
        names = re.findall(r"^  ([a-z][\w-]*)  +", self._help().partition("Subcommands:")[2], re.MULTILINE)
        with concurrent.futures.ThreadPoolExecutor() as pool:
            texts = dict(zip(names, pool.map(self._help, names)))
        self.options = {name: set(OPTION.findall(text)) for name, text in texts.items()}
        self.all_options = set(OPTION.findall(self._help())).union(*self.options.values())

    @functools.cache
    def _help(self, *command):
        return subprocess.run([self.path, *command, "--help"], capture_output=True, text=True, timeout=HANG_SECONDS,
                              check=True).stdout

    def mistakes(self, line):
        """Errors in the text after "terrane". After two spaces or # there may be a description, which may name options of
        all commands."""
        command, *description = re.split(r"\s{2,}|\s#\s", line.strip(), maxsplit=1)
        first = command.split(" ")[0]
        name = first if re.match(r"[a-z]", first) else "play"
        if name not in self.options:
            return [f"terrane has no subcommand {name}"]
        found = [f"terrane {name} has no option {o}"
                 for o in OPTION.findall(command) if o not in self.options[name] | {"--help", "--version"}]
        return found + [f"no subcommand of terrane has an option {o}"
                        for o in OPTION.findall(" ".join(description)) if o not in self.all_options]


class Pages:
    def __init__(self, root):
        self.root = root
        tops = [root / name for name in ("README.md", "CHANGELOG.md") if (root / name).is_file()]
        self.pages = {path: Page(path) for path in tops + sorted((root / "docs").rglob("*.md"))}

    def name(self, path):
        return path.relative_to(self.root).as_posix()

    def targets(self, page):
        """(line number, target, file, anchor) of links to files of this project."""
        for number, target in page.links():
            if re.match(r"[a-z][a-z0-9+.-]*:|//", target):
                continue
            path, _, anchor = target.partition("#")
            yield number, target, (page.path.parent / path).resolve() if path else page.path, anchor

    def broken_links(self):
        for page in self.pages.values():
            for number, target, file, anchor in self.targets(page):
                where = f"{self.name(page.path)}:{number}"
                if not file.exists():
                    yield f"{where}: {target}: there is no such file"
                elif anchor and file in self.pages and anchor not in self.pages[file].anchors:
                    yield f"{where}: {target}: the page has no such heading"

    def unreachable(self):
        start = self.root / START
        if start not in self.pages:
            return [f"{START}: there is no such file"]
        reached, waiting = {start}, [start]
        while waiting:
            for _, _, file, _ in self.targets(self.pages[waiting.pop()]):
                if file in self.pages and file not in reached:
                    reached.add(file)
                    waiting.append(file)
        return [f"{self.name(p)}: no links lead here from {START}"
                for p in self.pages if p not in reached and p.parent != self.root]

    def not_in_navigation(self):
        docs = self.root / "docs"
        shown = {docs / name for name in NAVIGATION.findall((self.root / SITE).read_text(encoding="utf-8"))}
        return [f"{self.name(p)}: is not in the navigation of {SITE}"
                for p in self.pages if docs in p.parents and p not in shown]

    def unknown_commands(self, program):
        for page in self.pages.values():
            if page.path.name == "CHANGELOG.md":
                continue
            for number, line in page.commands():
                for mistake in program.mistakes(line):
                    if (self.name(page.path), mistake) in EXCEPTIONS:
                        continue
                    yield f"{self.name(page.path)}:{number}: {mistake}"


class Docs(unittest.TestCase):
    root = None
    program = None

    @classmethod
    def setUpClass(cls):
        cls.pages = Pages(cls.root)

    def expect_none(self, mistakes):
        mistakes = list(mistakes)
        if mistakes:
            self.fail("\n" + "\n".join(mistakes))

    def test_links_and_images_exist(self):
        self.assertGreater(len(self.pages.pages), 10)
        self.expect_none(self.pages.broken_links())

    def test_all_pages_are_reached(self):
        self.expect_none(self.pages.unreachable())

    def test_all_pages_are_in_the_navigation(self):
        self.expect_none(self.pages.not_in_navigation())

    def test_commands_are_known(self):
        if not self.program:
            self.skipTest("no program is given")
        program = Program(self.program)
        if "play" not in program.options:
            self.skipTest("the program is built without graphics")
        self.expect_none(self.pages.unknown_commands(program))


HELP = """echo "Subcommands:"
echo "  play  Play"
echo "  map   Draw"
echo "OPTIONS: --help --radius N"
"""


class Faults(unittest.TestCase):
    """Tests that the checks find errors."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="terrane_docs_")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve()
        self.write(START, "# Start\n[other](other.md#two-words)\n")
        self.write("docs/other.md", "# Other\n\n## Two words\n")

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def broken(self):
        return list(Pages(self.root).broken_links())

    def commands(self, text):
        self.write("docs/other.md", text)
        self.write("terrane", "#!/bin/sh\n" + HELP)
        (self.root / "terrane").chmod(0o755)
        return list(Pages(self.root).unknown_commands(Program(self.root / "terrane")))

    def test_good_pages(self):
        self.assertEqual((self.broken(), Pages(self.root).unreachable()), ([], []))

    def test_a_missing_file(self):
        self.write("README.md", "\nSee [a\npage](docs/gone.md), ![image](docs/gone.png).\n")
        self.assertEqual(self.broken(), ["README.md:3: docs/gone.md: there is no such file",
                                         "README.md:3: docs/gone.png: there is no such file"])

    def test_a_missing_heading(self):
        self.write("docs/other.md", "# Other\n## Two  Words!\n```\n# two words\n```\n## A\n## A\n[](#a-1) [](#a-2)\n")
        self.assertEqual(self.broken(), ["docs/index.md:2: other.md#two-words: the page has no such heading",
                                         "docs/other.md:8: #a-2: the page has no such heading"])

    def test_code_has_no_links(self):
        self.write("README.md", "`[a](gone)`\n\n    [b](gone)\n\n```\n[c](gone)\n```\n")
        self.assertEqual(self.broken(), [])

    def test_an_unreachable_page(self):
        self.write("docs/start/alone.md", "# Alone\n[start](../index.md)\n")
        self.assertEqual(Pages(self.root).unreachable(), ["docs/start/alone.md: no links lead here from docs/index.md"])

    def test_a_page_that_is_not_in_the_navigation(self):
        self.write("mkdocs.yml", "nav:\n  - Start: index.md\n")
        self.assertEqual(Pages(self.root).not_in_navigation(), ["docs/other.md: is not in the navigation of mkdocs.yml"])

    def test_unknown_commands_and_options(self):
        good = "`terrane --radius 3`, `terrane map --help`, `terraneTool --x`, `cmake --build x`\n"
        self.assertEqual(self.commands(good), [])
        bad = "\n`terrane draw`\n\n    build/terrane map --radius 3 \\\n      --rad 4\n\n```\nterrane map  # --gone\n```\n"
        self.assertEqual(self.commands(bad), ["docs/other.md:4: terrane map has no option --rad",
                                              "docs/other.md:8: no subcommand of terrane has an option --gone",
                                              "docs/other.md:2: terrane has no subcommand draw"])


if __name__ == "__main__":
    Docs.root = pathlib.Path(sys.argv[1]).resolve()
    Docs.program = pathlib.Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None
    unittest.main(argv=sys.argv[:1], verbosity=2)
