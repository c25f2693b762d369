#!/usr/bin/env python3
"""Completions and the manual page against --help. Usage: help_test.py PROGRAM"""
import functools
import json
import os
import re
import shutil
import subprocess

import support
from support import ProgramTest, run


def generators(test):
    return set(json.loads(test.succeed("info", "--json"))["generators"])


@functools.cache
def flags_by_command():
    """As --help lists them."""
    text = run("--help").stdout
    commands = re.findall(r"^  ([\w-]+)  +", text[text.index("Subcommands:"):], re.MULTILINE)
    return {c: re.findall(r"^  (-[-\w,]+)", run(c, "--help").stdout, re.MULTILINE) for c in commands}


class HelpTest(ProgramTest):
    variables = {}

    def make_worlds(self, *names):
        """Makes worlds after the script: they are searched at completion time."""
        folder = self.folder / "data" / "terrane"
        folder.mkdir(parents=True, exist_ok=True)
        for name in names:
            (folder / f"{name}.sqlite").write_text("")
        (folder / "bookmarks.txt").write_text("")
        self.variables = {"XDG_DATA_HOME": str(self.folder / "data"), "HOME": "/nowhere"}

    def setUp(self):
        super().setUp()
        self.flags = flags_by_command()
        self.commands = list(self.flags)
        self.assertGreaterEqual(len(self.commands), 10)
        self.assertIn("-o,--output", self.flags["render"])

    def names(self, command):
        return [name for flag in self.flags[command] for name in flag.split(",")]

    def shell(self, name, *arguments):
        if not shutil.which(name):
            self.skipTest(f"{name} is not installed")
        done = subprocess.run([name, *arguments], capture_output=True, text=True, timeout=support.HANG_SECONDS,
                              check=False, cwd=self.folder, env={**os.environ, **self.variables})
        self.assertEqual((done.returncode, done.stderr), (0, ""), arguments)
        return done.stdout.split("\n")

    def script(self, shell):
        file = self.folder / f"terrane.{shell}"
        file.write_text(self.succeed("completion", shell))
        return file


class Bash(HelpTest):
    def complete(self, *words):
        # The last word is the one being typed.
        listed = " ".join(f"'{w}'" for w in words)
        text = f"source {self.script('bash')}; COMP_WORDS=({listed}); COMP_CWORD={len(words) - 1}; _terrane; " \
               "printf '%s\\n' \"${COMPREPLY[@]}\""
        return [line for line in self.shell("bash", "-c", text) if line]

    def test_every_command_and_flag(self):
        self.assertEqual(set(self.commands) - set(self.complete("terrane", "")), set())
        for command in self.commands:
            self.assertEqual(set(self.names(command)) - set(self.complete("terrane", command, "-")), set(), command)

    def test_what_is_typed_chooses(self):
        self.assertEqual(self.complete("terrane", "rend"), ["render"])
        self.assertEqual(self.complete("terrane", "render", "--mer"), ["--merging"])
        self.assertEqual(self.complete("terrane", "render", "--merging", "s"), ["squares", "squares-ext"])
        self.assertEqual(self.complete("terrane", "--merging", "g"), ["greedy"], "play is the default")
        self.assertEqual(self.complete("terrane", "flight-bench", "--samples", ""), ["1", "2", "4", "8"])
        self.assertEqual(self.complete("terrane", "render", "--seed", ""), [])
        self.assertEqual(self.complete("terrane", "completion", "z"), ["zsh"])

    def test_files(self):
        (self.folder / "a picture.png").write_text("")
        (self.folder / "a folder").mkdir()
        self.assertEqual(sorted(self.complete("terrane", "render", "-o", "a ")), ["a folder", "a picture.png"])
        for command, flag in (("record", "--frames-dir"), ("render", "--shader-root"), ("bench", "--output"), ("bench", "-o")):
            self.assertEqual(self.complete("terrane", command, flag, "a"), ["a folder"], command)
        self.assertEqual(sorted(self.complete("terrane", "check", "a ")), ["a folder", "a picture.png"])
        self.assertEqual(sorted(self.complete("terrane", "play", "--world", "a ")), ["a folder", "a picture.png"])


    def test_generators(self):
        for command in ("render", "generate", "play"):
            self.assertEqual(self.complete("terrane", command, "--generator", "f"), ["flat"])
        self.assertEqual(set(self.complete("terrane", "map", "--generator", "")), generators(self))

    def test_worlds(self):
        for words in (("render", "--world"), ("play", "--world"), ("check",)):
            self.variables = {"XDG_DATA_HOME": str(self.folder / "nothing")}
            self.assertEqual(self.complete("terrane", *words, "h"), [])
            self.make_worlds("home", "hills 2", "castle", "a'b")
            (self.folder / "house.sqlite").write_text("")
            self.assertEqual(sorted(self.complete("terrane", *words, "h")), ["hills 2", "home", "house.sqlite"])
            self.assertEqual(self.complete("terrane", *words, "a"), ["a'b"])
            (self.folder / "house.sqlite").unlink()
            shutil.rmtree(self.folder / "data")
        self.make_worlds("home")
        (self.folder / ".local").mkdir()
        shutil.move(self.folder / "data", self.folder / ".local" / "share")
        self.variables = {"XDG_DATA_HOME": "no/absolute/path", "HOME": str(self.folder)}
        self.assertEqual(self.complete("terrane", "map", "--world", "h"), ["home"])


class Fish(HelpTest):
    def complete(self, line):
        return [x.split("\t")[0] for x in self.shell(
            "fish", "--no-config", "-c", f"source {self.script('fish')}; complete -C '{line}'") if x]

    def test_every_command_and_flag(self):
        self.assertEqual(set(self.commands) - set(self.complete("terrane ")), set())
        for command in self.commands:
            found = set(self.complete(f"terrane {command} --")) | set(self.complete(f"terrane {command} -"))
            self.assertEqual(set(self.names(command)) - found, set(), command)

    def test_what_is_typed_chooses(self):
        self.assertEqual(self.complete("terrane render --merging s"), ["squares", "squares-ext"])
        self.assertEqual(self.complete("terrane --merging g"), ["greedy"])
        self.assertEqual(self.complete("terrane completion z"), ["zsh"])
        self.assertEqual(self.complete("terrane render --generator f"), ["flat"])

    def test_worlds(self):
        self.make_worlds("home", "hills 2", "castle")
        for words in ("render --world", "--world", "check"):
            self.assertEqual(sorted(self.complete(f"terrane {words} h")), ["hills 2", "home"])
        self.make_worlds()
        self.variables["XDG_DATA_HOME"] = str(self.folder / "nothing")
        self.assertEqual({"home", "hills 2"} & set(self.complete("terrane render --world h")), set())


class Zsh(HelpTest):
    def test_every_command_and_flag(self):
        script = self.script("zsh")
        self.shell("zsh", "-n", str(script))
        text = script.read_text()
        for command in self.commands:
            self.assertIn(f"'{command}:", text)
            part = re.search(rf"^ +{command}\) _arguments(.*?) ;;$", text, re.MULTILINE | re.DOTALL)[1]
            for name in self.names(command):
                self.assertIn(f"'{name}[", part, command)
        self.assertIn(":CHOICE:(none lines squares squares-ext greedy)'", text)

    def test_worlds(self):
        self.make_worlds("home", "hills 2", "castle")
        text = self.script("zsh").read_text()
        for command in ("play", "render", "map"):
            part = re.search(rf"^ +{command}\) _arguments(.*?) ;;$", text, re.MULTILINE | re.DOTALL)[1]
            self.assertIn(":NAME|FILE|URL:_terrane_worlds'", part)
            self.assertRegex(part, r":CHOICE:\([a-z0-9 ]*\bflat\b[a-z0-9 ]*\)'")
        found = self.shell("zsh", "-f", "-c", "autoload -U compinit; compinit -u -D; "
                           f"source {self.script('zsh')}; _wanted() {{ shift 3; $@; }}; _files() {{ :; }}; "
                           "compadd() { print -l ${(P)2}; }; _terrane_worlds")
        self.assertEqual(sorted(found), ["", "castle", "hills 2", "home"])

    # The shell's own check of specifications, which reports wrong ones; without a terminal.
    def test_specifications_are_understood(self):
        said = self.shell("zsh", "-f", "-c", "autoload -U compinit; compinit -u -D; " f"source {self.script('zsh')}; "
                          "_describe() { :; }; _arguments() { print $words[1]; for s in $@; do "
                          "[[ $s == (--#[a-z-]##\\[*\\]*|\\*:*:*|[0-9]:*:*) ]] || { print -u2 bad: $s; }; done; }; "
                          f"setopt extendedglob; for c in {' '.join(self.commands)}; "
                          "do words=(terrane $c -); CURRENT=3; _terrane; done")
        self.assertEqual([line for line in said if line], self.commands)

    def test_arguments_have_places_of_their_own(self):
        text = self.script("zsh").read_text()
        for command, count in (("copy", 2), ("backup", 2), ("import", 2), ("check", 1)):
            part = re.search(rf"^ +{command}\) _arguments(.*?) ;;$", text, re.MULTILINE | re.DOTALL)[1]
            self.assertEqual(re.findall(r"^ +'(\d|\*):", part, re.MULTILINE), [str(k + 1) for k in range(count)], command)


class Man(HelpTest):
    def test_every_command_and_flag(self):
        text = self.succeed("man")
        self.assertIn('.TH TERRANE 1 "" "terrane ', text)
        plain = text.replace("\\-", "-")
        for command in self.commands:
            part = plain[plain.index(f".SS terrane {command}\n"):]
            part = part[:part.find("\n.S", 1)]
            for name in self.names(command):
                self.assertIn(f"\\fB{name}\\fR", part, command)

    def test_roff_has_no_mistakes(self):
        file = self.folder / "terrane.1"
        file.write_text(self.succeed("man"))
        page = "\n".join(self.shell("groff", "-man", "-ww", "-Kutf8", "-Tutf8", "-P-cbou", str(file)))
        page = re.sub(r"\s+", " ", page)  # lines are filled with spaces
        for word in ("--merging CHOICE", "EXIT STATUS", "a measurement of terrane bench", "(required)", "(default: 1280x720)"):
            self.assertIn(word, page)


class Errors(ProgramTest):
    def test_an_unknown_shell(self):
        for arguments in (("completion",), ("completion", "tcsh"), ("completion", "")):
            self.assertRefused(run(*arguments), arguments)


if __name__ == "__main__":
    support.main()
