"""The program of a build without graphics: it can serve, and links no graphics library."""
import subprocess

import support

DRAWING_LIBRARIES = ("libGL", "libEGL", "libepoxy", "libglfw", "libimgui", "libX11", "libOpenGL", "libwayland")
COMMANDS = ("generate", "map", "dump", "check", "copy", "backup", "import", "export", "work", "serve", "history", "bots", "blocks", "packs", "info", "completion", "man")


class Server(support.ProgramTest):
    def test_it_is_linked_to_nothing_that_draws(self):
        libraries = subprocess.run(["ldd", support.program()], capture_output=True, text=True, check=True).stdout
        self.assertIn("libsqlite3", libraries)
        for name in DRAWING_LIBRARIES:
            self.assertNotIn(name, libraries)

    def test_the_digest_is_the_same_for_any_threads(self):
        digests = {self.succeed("generate", "--radius", "2", "--digest", "--threads", threads) for threads in (1, 2)}
        self.assertEqual(len(digests), 1)
        self.assertRegex(digests.pop().strip(), "^[0-9a-f]{16,}$")

    def test_a_generated_save_is_good(self):
        save = self.folder / "world.sqlite"
        self.succeed("generate", "--radius", "1", "--world", save)
        self.assertIn("9 chunks", self.succeed("check", save))

    def test_maps_and_dumps_are_written(self):
        self.succeed("map", "--radius", "1", "-o", self.folder / "map.png")
        self.assertTrue((self.folder / "map.png").read_bytes().startswith(b"\x89PNG"))
        for what in ("blocks", "light"):
            file = self.folder / f"{what}.npy"
            self.succeed("dump", "--area", "0,0,1,1", "--what", what, "-o", file)
            self.assertTrue(file.read_bytes().startswith(b"\x93NUMPY"))

    def test_the_gpu_is_refused_in_one_line(self):
        done = support.run("generate", "--radius", "1", "--backend", "gpu")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.strip(),
                         "terrane: error: --backend gpu: this program was built without graphics")

    def test_a_command_must_be_named(self):
        done = support.run()
        self.assertEqual(done.returncode, 2)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)

    def test_completions_and_manual_know_no_default_command(self):
        self.assertNotIn("Without a command", self.succeed("man"))
        self.assertIn(" command= more=", self.succeed("completion", "bash"))

    def test_help_lists_what_there_is(self):
        text = self.succeed("--help")
        for command in COMMANDS:
            self.assertIn(f"\n  {command} ", text)
        for command in ("play", "render", "record", "bench"):
            self.assertNotIn(f"  {command} ", text)


if __name__ == "__main__":
    support.main()
