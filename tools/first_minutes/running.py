"""A command of a page that goes on while others run: a server with its console, a window with keys and mouse."""
import os
import pathlib
import subprocess
import sys
import time

from .page import PageError, wait_for

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from virtual_display import Display  # noqa: E402

SCREEN = (1280, 720)  # as large as the window
PAUSE = 1.5  # seconds, some frames, from a key to the next


class Running:
    """Ends with close(), or end() if it must have ended well."""

    def __init__(self, page, command, display=None):
        folder, path = (page.shell.run(ask)[1].strip() for ask in ("pwd", "echo $PATH"))
        environment = {**page.shell.environment, "PATH": path, **({"DISPLAY": display.name} if display else {})}
        self.display, self.command, self.log = display, command, open(page.home / "log.txt", "a+", encoding="utf-8")
        self.begin = self.log.seek(0, os.SEEK_END)
        self.process = subprocess.Popen(["bash", "-c", f"exec {command}"], cwd=folder, env=environment, text=True,
                                        stdin=subprocess.PIPE, stdout=self.log, stderr=self.log)

    def output(self):
        self.log.seek(self.begin)
        return self.log.read()

    def wait_for(self, condition, what):
        def is_there():
            if self.process.poll() is not None:
                raise PageError(f"{self.command} ended with {self.process.returncode}: {self.output()[-2000:]}")
            return condition()
        try:
            return wait_for(is_there, f"{self.command}: {what}")
        except PageError as error:
            if self.process.poll() is not None:
                raise
            raise PageError(f"{error}; output: {self.output()[-500:]}") from error

    def wait_for_line(self, text):
        self.wait_for(lambda: text in self.output(), f"does not print {text}")

    def say(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def end(self):
        """Waits until it has ended by itself, without errors."""
        try:
            code = self.process.wait(120)
        except subprocess.TimeoutExpired:
            code = "no end"
        output = self.output()
        self.close()
        if code != 0 or "error" in output:
            raise PageError(f"{self.command} ended with {code}: {output[-2000:]}")

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self.process.stdin.close()
        self.log.close()

    # Of a window:
    def open(self, title="Terrane"):
        window = self.wait_for(lambda: self.display.xdotool("search", "--onlyvisible", "--name", title), "opens no window")
        self.display.xdotool("windowmove", window, 0, 0)
        self.display.xdotool("windowfocus", window)
        time.sleep(2 * PAUSE)
        return self

    def press(self, *keys):
        for key in keys:
            self.display.xdotool("key", key)
            time.sleep(PAUSE)

    def type(self, text):
        for character in text:
            self.display.xdotool("type", character)
            time.sleep(0.2)
        time.sleep(PAUSE)

    def hold(self, button, seconds=0.4):
        self.display.xdotool("mousedown", button)
        time.sleep(seconds)
        self.display.xdotool("mouseup", button)
        time.sleep(PAUSE)

    def look_down(self):
        """Captures the mouse with a click and turns the camera to the ground some steps ahead."""
        self.display.xdotool("mousemove", SCREEN[0] // 2, SCREEN[1] // 2)
        self.hold(1)
        for _ in range(6):
            self.display.xdotool("mousemove_relative", 0, 40)
            time.sleep(0.1)
        time.sleep(PAUSE)
