#!/usr/bin/env python3
"""tools/mutate.py without builds: the places, the draw, the copy, the runs of programs, results and report.
Usage: mutate_test.py SCRIPT"""
import contextlib
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from dataclasses import asdict

SCRIPT = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SCRIPT.parent))

from mutate.draw import Draw, quotas  # noqa: E402
from mutate.places import BINARY, Place, changed, changes_of, places_of_module  # noqa: E402
from mutate.programs import (PROGRAMS, Program, Unchanged, Unchangeds, programs_of,  # noqa: E402
                             test_that_failed, unchanged_of)
from mutate.report import report_of  # noqa: E402
from mutate.results import Result, Results  # noqa: E402
from mutate.tree import Tree  # noqa: E402
from mutate.trial import place_now  # noqa: E402


def changes(source):
    return [(old, new) for _, old, new in changes_of(source)]


class Places(unittest.TestCase):
    def assertUnchanged(self, *sources):
        for source in sources:
            self.assertEqual(changes(source), [], source)

    def test_operators_become_what_the_table_says(self):
        pairs = {"<": "<=", ">": ">=", "==": "!=", "+": "-", "*": "/", "&&": "||", "&": "|", "<<": ">>"}
        self.assertEqual(BINARY, {**pairs, **{right: left for left, right in pairs.items()}})
        for old, new in BINARY.items():
            self.assertEqual(changes(f"x = a {old} b;"), [(old, new)])
            self.assertEqual(changes(f"x = a {old}\n    b;"), [(old, new)])

    def test_operators_with_one_operand_and_words(self):
        self.assertEqual(changes("++a; b--;"), [("++", "--"), ("--", "++")])
        self.assertEqual(changes("if (!a) b = true;\nelse b = false;"),
                         [("!", ""), ("true", "false"), ("false", "true")])

    def test_one_becomes_two(self):
        self.assertEqual(changes("x = a + 1;"), [("+", "-"), ("1", "2")])
        self.assertEqual(changes("x = a + 1u;"), [("+", "-"), ("1u", "2u")])
        self.assertEqual(changes("x = a + 1.0f;"), [("+", "-"), ("1.0f", "2.0f")])
        for other in ("a + 10", "a + 1.5f", "a + 1e3", "a + 0x1"):
            self.assertEqual(changes(f"x = {other};"), [("+", "-")])
        self.assertUnchanged("x = 1;", "f(1);", "x = +1;")

    def test_comments_strings_and_preprocessor_lines_are_left_alone(self):
        self.assertUnchanged("// a < b", "/* a < b\n * c + d */", "// a \\\n b < c", 'f("a < b");', r'f("\" + a");',
                             'f(R"(a " < b)");', 'f(R"sql(a )" < b)sql");', "f(L'<');", r"f('\'');",
                             "#if A < B && !C", "  #define MAX(a, b) \\\n    a > b ? a : b", "#include <a/b>")

    def test_code_beside_them_is_found(self):
        self.assertEqual(changes('f("//"); x = a < b;  // c > d'), [("<", "<=")])
        self.assertEqual(changes("#define A 1\nx = a < b;"), [("<", "<=")])
        self.assertEqual(changes("x = 1'000'000 < a; c = '\"'; d = e < f;"), [("<", "<="), ("<", "<=")])
        self.assertEqual(changes("x = 1e-3 - 2;"), [("-", "+")])
        self.assertEqual(changes("f(/* a */ b < c);"), [("<", "<=")])

    def test_templates_references_and_pointers_are_left_alone(self):
        self.assertUnchanged("std::vector<int> a;", "template <class T>\nvoid f(T&& a, T& b, T* c);",
                             "std::vector<std::vector<int>> a;", "template <> struct A<int> {};", "[&](int& a) {};",
                             "x = *a; y = &b; z = -c;", "a->b; c <=> d;", "a += b; c <<= 2;",
                             "x = static_cast<int>(a);", "template <class T>\nrequires(A<T> && !B<T>) void f(T a);",
                             "concept A = B<T> || C<T>;")

    def test_declarations_of_operators_are_left_alone(self):
        self.assertUnchanged("bool operator==(const A&) const = default;", "A operator&&(A a, A b);",
                             "A& operator++();", "bool operator!() const;")

    def test_assertions_and_messages_are_left_alone(self):
        self.assertUnchanged('assert(a < b && "reason");', "static_assert(f(a) + 1 == b);",
                             "TERRANE_ASSERT(!(a > b), c + 1);", 'base::logWarning("{}", a + 1);',
                             'return base::fail(ErrorCode::Io, "{}", a - b);', "void f() noexcept(a && b);")
        self.assertEqual(changes('if (!a) return fail("{}", b + 1);\nc = d < e;'), [("!", ""), ("<", "<=")])
        self.assertEqual(changes("failAll(a + b);"), [("+", "-")])

    def test_texts_are_not_added_otherwise(self):
        self.assertUnchanged('x = a + "b";', 'x = "a" + b;')

    def test_a_change_of_a_line(self):
        source = "int f(int a) {\r\n    return a + 1 < 2;\r\n}\r\n"
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            path = root / "terrane" / "mesh" / "deep" / "a.cpp"
            path.parent.mkdir(parents=True)
            path.write_bytes(source.encode())
            (path.parent / "a.frag.glsl").write_text("a < b")
            places, lines = places_of_module(root, "mesh")
        self.assertEqual({(place.file, place.line) for place in places}, {("terrane/mesh/deep/a.cpp", 2)})
        self.assertEqual([(place.column, place.old) for place in places], [(13, "+"), (15, "1"), (17, "<")])
        self.assertEqual(lines, 3)
        text, before, after = changed(source, places[2])
        self.assertEqual(text, source.replace("<", "<="))
        self.assertEqual((before, after), ("return a + 1 < 2;", "return a + 1 <= 2;"))
        with self.assertRaises(ValueError):
            changed(source.replace("<", ">"), places[2])


class Drawing(unittest.TestCase):
    def test_quotas(self):
        self.assertEqual(quotas({"a": 50, "b": 30, "c": 20}, 10), {"a": 5, "b": 3, "c": 2})
        self.assertEqual(quotas({"a": 2, "b": 1}, 200), {"a": 133, "b": 67})
        self.assertEqual(quotas({"a": 1, "b": 1, "c": 1}, 1), {"a": 1, "b": 0, "c": 0})

    def test_the_seed_decides(self):
        places, lines = {"a": range(1000), "b": range(500)}, {"a": 10, "b": 5}
        first, same, other = (Draw(places, lines, 30, seed) for seed in (1, 1, 2))
        self.assertEqual((first.slots, first.places), (same.slots, same.places))
        self.assertNotEqual(first.places, other.places)
        self.assertEqual(first.slots.count("a"), 20)
        self.assertNotEqual(first.slots, sorted(first.slots))
        self.assertEqual(sorted(first.places["b"]), list(range(500)))


@unittest.skipUnless(shutil.which("git"), "git is not installed")
class Copies(unittest.TestCase):
    def test_the_copy_follows_the_checkout(self):
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder) / "checkout"
            output = source / "out"
            (output / "tree").mkdir(parents=True)
            subprocess.run(["git", "init", "-q", source], check=True)
            (source / ".gitignore").write_text("*.o\n")
            (source / "a.cpp").write_text("a")
            (source / "a.o").write_text("object")
            tree = Tree(source, output / "tree")
            digest = tree.update()
            self.assertEqual(sorted(path.name for path in tree.root.iterdir()), [".gitignore", "a.cpp"])
            time = (tree.root / "a.cpp").stat().st_mtime_ns
            self.assertEqual(tree.update(), digest)
            self.assertEqual((tree.root / "a.cpp").stat().st_mtime_ns, time)
            (tree.root / "a.cpp").write_text("changed")
            self.assertEqual(tree.update(), digest)
            self.assertEqual((tree.root / "a.cpp").read_text(), "a")
            (source / "a.cpp").unlink()
            self.assertNotEqual(tree.update(), digest)
            self.assertEqual([path.name for path in tree.root.iterdir()], [".gitignore"])


class Programs(unittest.TestCase):
    @contextlib.contextmanager
    def program(self, script):
        """A script in place of a test program, in a folder."""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a_tests"
            path.write_text("#!/bin/sh\n" + script)
            path.chmod(0o755)
            yield Program(path, 2), pathlib.Path(folder)

    def run_script(self, script):
        with self.program(script) as (program, _):
            return program.run(Unchanged(slow=["A.Slow"]))

    def test_passing(self):
        self.assertEqual(self.run_script("exit 0\n").kind, "passed")

    def test_a_script_uses_the_program(self):
        with self.program("exit 3\n") as (program, folder):
            script = folder / "cli_test.py"
            script.write_text("import subprocess, sys\nif subprocess.run([sys.argv[1]]).returncode:\n"
                              "    print('FAIL: test_version (cli_test.CliTest)')\n    sys.exit(1)\n")
            run = Program(program.path, 2, script=script).run(Unchanged(quick_seconds=1))
            self.assertEqual((run.kind, run.test), ("noticed", "test_version"))
            program.path.write_text("#!/bin/sh\n")
            self.assertEqual(Program(program.path, 2, script=script).run(Unchanged()).kind, "passed")

    def test_a_failing_shard(self):
        script = '[ "$GTEST_SHARD_INDEX" = 0 ] && exec sleep 100000\necho "[  FAILED  ] A.B (3 ms)"; exit 1\n'
        with self.program(script) as (program, folder):
            run = program.run_shards([], math.inf, folder, fails_fast=True)
        self.assertEqual((run.kind, run.test), ("noticed", "A.B"))

    def test_a_program_that_does_not_end(self):
        with self.program('echo "[ RUN      ] A.B"; sleep 100000 & wait\n') as (program, folder):
            def now():  # the time is over once the test runs
                output = folder / "0.txt"
                return 60.0 if output.exists() and output.read_text() else 0.0
            with unittest.mock.patch("mutate.programs.time.monotonic", now):
                run = program.run_shards([], 10, folder, fails_fast=True)
        self.assertEqual((run.kind, run.test), ("timed_out", "A.B"))

    def test_slow_tests_run_after_the_others(self):
        run = self.run_script('case "$1" in *=\\*-*) exit 0;; esac; echo "[ RUN      ] A.Slow"; kill -SEGV $$\n')
        self.assertEqual((run.kind, run.test), ("noticed", "A.Slow"))

    def test_the_test_that_failed(self):
        failed = "[ RUN      ] A.B/0\n[  FAILED  ] A.B/0, where GetParam() = 1 (0 ms)\n"
        self.assertEqual(test_that_failed(failed), "A.B/0")
        self.assertEqual(test_that_failed("[ RUN      ] A.B\n[       OK ] A.B (0 ms)\n[ RUN      ] A.C\n"), "A.C")
        self.assertEqual(test_that_failed(""), "")

    def test_how_the_unchanged_program_runs(self):
        def test(name, time, **more):
            return {"name": name, "status": "RUN", "time": time, **more}
        tests = [test("Quick", "0.2s"), test("Slow", "4s"), test("Bad", "1s", failures=[{}]),
                 {"name": "Other", "status": "NOTRUN", "time": "0s"}]
        report = {"testsuites": [{"name": "A", "testsuite": tests}]}
        other = {"testsuites": [{"name": "B", "testsuite": [test("Quick", "0.1s")]}]}
        unchanged = unchanged_of([report, other])
        self.assertEqual((unchanged.slow, unchanged.failing), (["A.Slow"], ["A.Bad"]))
        self.assertAlmostEqual(unchanged.quick_seconds, 0.3)
        self.assertEqual((unchanged.slow_seconds, unchanged.longest_seconds), (4, 4))

    def test_measurements_of_other_sources_do_not_count(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "unchanged.json"
            Unchangeds(path, "1").add("a_tests", Unchanged(slow=["A.Slow"]))
            self.assertEqual(Unchangeds(path, "1").by_program, {"a_tests": Unchanged(slow=["A.Slow"])})
            self.assertEqual(Unchangeds(path, "2").by_program, {})

    def test_the_own_program_is_the_first(self):
        for module, names in PROGRAMS.items():
            self.assertEqual(names[0], {"video": "record_tests"}.get(module, f"{module}_tests"))
        self.assertEqual(programs_of("net", {"net_tests", "gen_tests"}), ["net_tests"])
        self.assertEqual(programs_of("base", {"base_tests"}), ["base_tests"])
        self.assertEqual(programs_of("pack", {"pack_tests", "terrane"}), ["pack_tests", "packs_test.py"])


def place(module, line, old="<", new="<="):
    return Place(module, f"terrane/{module}/a.cpp", line, 4, old, new)


class Reports(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.path = self.folder / "results.jsonl"

    def write(self, *results, end=""):
        settings = {"count": 200, "seed": 1, "modules": ["gen", "mesh"], "sources": "0"}
        lines = [{"settings": settings}] + [asdict(result) for result in results]
        self.path.write_text("".join(json.dumps(line) + "\n" for line in lines) + end, encoding="utf-8")

    def report(self, *options):
        return subprocess.run([sys.executable, "-B", SCRIPT, "--report", self.folder, *options], capture_output=True,
                              text=True, check=False)

    def test_the_tables(self):
        missed = Result(place("gen", 7), "not_noticed", "if (a < b) {", "if (a <= b) {", programs=["gen_tests"])
        self.write(Result(place("gen", 1), "noticed", "a", "b", by="gen_tests A.B", build_seconds=5, test_seconds=1),
                   Result(place("gen", 2), "noticed", "a", "b"),
                   Result(place("gen", 3), "timed_out", "a++", "a--", by="gen_tests A.C"), missed,
                   Result(place("gen", 4), "not_compiled", "a", "b"),
                   Result(place("mesh", 1), "noticed", "a", "b", is_wide=True))
        done = self.report()
        self.assertEqual(done.returncode, 0, done.stderr)
        for line in ("| gen | 4 | 3 | 1 | 1 | 75.0 % | 1 |", "| mesh | 1 | 1 | 0 | 0 | 100.0 % | 0 |",
                     "| all | 5 | 4 | 1 | 1 | 80.0 % | 1 |", "- terrane/gen/a.cpp:7, column 5: `<` → `<=`",
                     "      if (a < b) {", "      if (a <= b) {",
                     "- terrane/gen/a.cpp:3, column 5: `<` → `<=` in gen_tests A.C",
                     "| mesh | mesh_tests, formats_tests, stream_tests, game_tests | 1 |"):
            self.assertIn(line + "\n", done.stdout)
        self.assertNotIn("a.cpp:1,", done.stdout)

    def test_lines_that_were_cut_short_are_skipped(self):
        self.write(Result(place("gen", 1), "noticed", "a", "b"), end='{"place": {"module": "ge')
        self.assertIn("| all | 1 | 1 | 0 | 0 | 100.0 % | 0 |\n", self.report().stdout)
        Results(self.path).read().add(Result(place("gen", 2), "not_noticed", "a", "b"))
        self.assertIn("| all | 2 | 1 | 0 | 1 | 50.0 % | 0 |\n", self.report().stdout)
        self.assertEqual(len(self.path.read_text().splitlines()), 4)

    def test_what_was_tried_again_counts_once(self):
        missed = Result(place("gen", 7), "not_noticed", "a < b", "a <= b")
        again = Result(place("gen", 7), "noticed", "a < b", "a <= b", place_now=place("gen", 9))
        self.write(missed, again)
        results = Results(self.path).read()
        self.assertEqual(results.latest(), [again])
        self.assertEqual(results.first_tries(), [missed])
        self.assertIn("| all | 1 | 1 | 0 | 0 | 100.0 % | 0 |\n", report_of(results) + "\n")

    def test_nothing_to_report(self):
        done = self.report()
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))
        self.assertIn("holds no results", done.stderr)

    def test_a_line_that_moved(self):
        result = Result(Place("gen", "terrane/gen/a.cpp", 2, 10, "<", "<="), "not_noticed", "x = a < b < c;",
                        "x = a < b <= c;")
        now = place_now(result, "int x;\n\n\n        x = a < b < c;\n")
        self.assertEqual((now.line, now.column), (4, 18))
        self.assertIsNone(place_now(result, "x = a < b;\n"))
        self.assertIsNone(place_now(result, 3 * "\n" + 2 * "x = a < b < c;\n"))
        self.assertEqual(place_now(result, 3 * "x = a < b < c;\n").line, 2)


if __name__ == "__main__":
    unittest.main(verbosity=1)
