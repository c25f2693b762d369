#!/usr/bin/env python3
"""Installs a build into a folder and builds an example against it. Usage: install_test.py BUILD SOURCE CMAKE"""
import gzip
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
from xml.etree import ElementTree

HANG_SECONDS = 600

BUILD, SOURCE = (pathlib.Path(p).resolve() for p in sys.argv[1:3])
CMAKE = sys.argv[3]


def run(*command, **more):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=HANG_SECONDS, check=False,
                          **more)
    if done.returncode != 0:
        raise AssertionError(f"{command}: {done.stdout}{done.stderr}")
    return done.stdout


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="terrane_install_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.prefix = cls.folder / "a prefix"
        run(CMAKE, "--install", BUILD, "--prefix", cls.prefix)
        # As in another project: outside of the source tree.
        cls.examples = cls.folder / "programs"
        shutil.copytree(SOURCE / "examples", cls.examples)

    def find(self, name):
        found = list(self.prefix.rglob(name))
        self.assertEqual(len(found), 1, f"{name}: {found}")
        return found[0]

    def test_the_program_and_what_belongs_to_it(self):
        program = self.prefix / "bin" / "terrane"
        self.assertRegex(run(program, "--version"), r"\A\d+\.\d+\.\d+\n\Z")
        page = gzip.decompress(self.find("terrane.1.gz").read_bytes()).decode()
        self.assertEqual(page, run(program, "man"))
        for path, shell in (("bash-completion/completions/terrane", "bash"), ("zsh/vendor-completions/_terrane", "zsh"),
                            ("fish/vendor_completions.d/terrane.fish", "fish")):
            self.assertEqual((self.prefix / "share" / path).read_text(), run(program, "completion", shell))
        self.assertEqual(self.find("terrane.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        entry = dict(line.split("=", 1) for line in self.find("terrane.desktop").read_text().split("\n") if "=" in line)
        self.assertEqual((entry["Exec"], entry["Icon"]), ("terrane play", "terrane"))

    def test_the_menu_and_software_centers_accept_what_describes_the_program(self):
        run("desktop-file-validate", self.find("terrane.desktop"))
        run("appstreamcli", "validate", "--pedantic", "--no-net", self.find("org.terrane.terrane.metainfo.xml"))

    def test_the_version_is_the_same_everywhere(self):
        version = run(self.prefix / "bin" / "terrane", "--version").strip()
        newest = ElementTree.parse(self.find("org.terrane.terrane.metainfo.xml")).find("releases/release")
        self.assertEqual(newest.get("version"), version)
        headings = re.findall(r"^## (.*)$", (SOURCE / "CHANGELOG.md").read_text(), re.MULTILINE)
        self.assertIn(version, headings)
        self.assertIn(f"\nVersion: {version}\n", self.find("terrane.pc").read_text())

    def test_the_service_finds_the_program(self):
        self.assertIn("ExecStart=terrane serve ", self.find("terrane-server.service").read_text())
        self.find("terrane-server.socket")

    def test_headers_need_nothing_of_the_source_tree(self):
        headers = list((self.prefix / "include").rglob("*.h"))
        self.assertGreater(len(headers), 100)
        for file in self.prefix.rglob("*"):
            if file.suffix in (".h", ".cmake", ".pc"):
                self.assertNotIn(str(SOURCE), file.read_text(), file)

    def test_internal_headers_stay_behind(self):
        include = self.prefix / "include"
        self.assertGreater(len(list((SOURCE / "terrane").rglob("*_internal.h"))), 3)
        for file in include.rglob("*.h"):
            self.assertFalse(file.name.endswith(("_internal.h", "-inl.h")), file)
            text = file.read_text()
            self.assertNotIn("nside the module", text, file)
            for name in re.findall(r'#include "(terrane/[^"]+)"', text):
                self.assertTrue((include / name).is_file(), f"{file}: {name} is not installed")

    def test_the_library_needs_no_window_library(self):
        for name in ("terrane.pc", "terraneConfig.cmake", "terraneTargets.cmake"):
            self.assertNotIn("glfw", self.find(name).read_text(), name)

    def build_and_run(self, program):
        first, second = run(program, "3"), run(program, "4")
        self.assertEqual({len(line) for line in first.split("\n") if line}, {80})
        self.assertEqual(len(first.split("\n")), 81)
        self.assertNotEqual(first, second)
        return first

    def use_world_tools(self, build):
        if "world_tools" not in run(CMAKE, "--build", build, "--target", "help"):
            return  # a build without maps or PostgreSQL
        run(CMAKE, "--build", build, "--target", "world_tools")
        folder = self.folder / "tools"
        printed = run(build / "world_tools", folder, env=os.environ | {"LIBGL_ALWAYS_SOFTWARE": "1"})
        for line in (r"import: 1 chunk", r"export: \d+ faces, \d+ materials; 16×16 columns", r"map: (\d+) of \1 images written",
                     r"server: 1 player joined, and built", r"video: 3 frames"):
            self.assertRegex(printed, f"(?m)^{line}$")
        for name in ("area.glb", "heights.npy", "blocks.npy", "map/index.html", "frames/frame_00002.png"):
            self.assertGreater((folder / name).stat().st_size, 0, name)

    def test_an_example_by_find_package_and_by_pkg_config(self):
        build = self.folder / "build"
        run(CMAKE, "-G", "Ninja", "-S", self.examples, "-B", build, "-DCMAKE_BUILD_TYPE=Debug", f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run(CMAKE, "--build", build, "--target", "own_generator", "own_behavior")
        self.assertIn("8,8,40: iron becomes rust", run(build / "own_behavior"))
        text = self.build_and_run(build / "own_generator")
        self.use_world_tools(build)

        paths = {"PKG_CONFIG_PATH": str(self.find("terrane.pc").parent)}
        sources = [self.examples / name for name in ("own_generator.cpp", "tutorial_generators.cpp")]
        flags = shlex.split(run("pkg-config", "--cflags", "--libs", "terrane", env=os.environ | paths))
        run("c++", f"-I{build / 'include'}", *sources, "-o", self.folder / "other", *flags)
        self.assertEqual(run(self.folder / "other", "3"), text)

    def test_the_package_for_python(self):
        if not list(self.prefix.rglob("_terrane*.so")):
            self.skipTest("built without it")
        folder = self.find("_terrane*.so").parent.parent
        self.assertEqual(folder, self.prefix / "lib" / "python3" / "dist-packages")
        script = "import terrane; print(terrane.__file__, terrane.World(generator='flat').heights((0, 0, 1, 1)))"
        printed = run("/usr/bin/python3", "-B", "-c", script, env=os.environ | {"PYTHONPATH": str(folder)}, cwd=self.folder)
        self.assertEqual(printed, f"{folder}/terrane/__init__.py [[80]]\n")
        self.assertEqual({f.name for f in (folder / "terrane").iterdir()} - {self.find("_terrane*.so").name},
                         {"__init__.py", "__init__.pyi", "py.typed"})

    def test_another_version_is_refused(self):
        project = self.folder / "other_version"
        project.mkdir()
        (project / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.22)\nproject(x LANGUAGES CXX)\n"
                                                "find_package(terrane 99 REQUIRED)\n")
        with self.assertRaisesRegex(AssertionError, "99"):
            run(CMAKE, "-G", "Ninja", "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}")


if __name__ == "__main__":
    del sys.argv[1:4]
    unittest.main(verbosity=2)
