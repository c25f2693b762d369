"""A virtual screen, for tests of the window. Needs Xvfb and xdotool (Debian: xvfb, xdotool)."""
import os
import subprocess

HANG_SECONDS = 120


class Display:
    """A virtual X server on a number that it chooses itself."""

    def __init__(self, size):
        self.size = size  # pixels

    def __enter__(self):
        read_end, write_end = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write_end), "-screen", "0", f"{self.size[0]}x{self.size[1]}x24", "-nolisten", "tcp",
             "-noreset",  # else it restarts whenever its last window closes
             "-r"],  # no key repeat: on a busy machine a short press would repeat too
            pass_fds=(write_end,), stderr=subprocess.DEVNULL)
        os.close(write_end)
        with os.fdopen(read_end) as pipe:
            number = pipe.readline().strip()
        if not number:
            raise RuntimeError("Xvfb does not start")
        self.name = ":" + number
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait(HANG_SECONDS)

    def xdotool(self, *arguments):
        done = subprocess.run(["xdotool", *map(str, arguments)], env={**os.environ, "DISPLAY": self.name},
                              capture_output=True, text=True, timeout=HANG_SECONDS, check=False)
        return done.stdout.strip()
