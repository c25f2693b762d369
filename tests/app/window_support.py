"""Shared by tests of the window: a virtual display, screenshots, the running program and its keys.

Needs Xvfb (without it the tests are skipped, exit code 77), xdotool and xwd; Debian's packages are xvfb, xdotool and
x11-apps."""
import contextlib
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

import support
from support import HANG_SECONDS

sys.path.append(str(pathlib.Path(__file__).parents[2] / "tools"))
import virtual_display  # noqa: E402

SKIPPED = 77
FLAT = ("--generator", "flat")
SCREEN = (640, 400)
SIZE, LARGER = (320, 180), (480, 270)


class Display(virtual_display.Display):
    def __init__(self, size=SCREEN):
        super().__init__(size)

    def screenshot(self, window):
        data = subprocess.run(["xwd", "-id", window, "-silent", "-display", self.name], capture_output=True,
                              timeout=HANG_SECONDS, check=True).stdout
        return Screenshot(data)


class Screenshot:
    """An X window dump of version 7 (X11/XWDFile.h)."""

    def __init__(self, data):
        header = struct.unpack(">25I", data[:100])
        header_bytes, version, _, depth, self.width, self.height = header[:6]
        self.stride = header[12]
        self.step = self.stride // self.width  # bytes per pixel; for some visuals the header has the used bits
        if version != 7 or depth < 24:
            raise ValueError(f"unexpected window dump: version {version}, depth {depth}")
        self.pixels = data[header_bytes + 12 * header[19]:]  # after the color map

    def color(self, x, y):
        """Red, green, blue."""
        at = y * self.stride + x * self.step
        blue, green, red = self.pixels[at:at + 3]
        return red, green, blue

    def colors(self, x0=0, y0=0):
        """All colors to the right of x0 and below y0."""
        found = set()
        for y in range(y0, self.height):
            row = self.pixels[y * self.stride + x0 * self.step:y * self.stride + self.width * self.step]
            found.update(row[k:k + self.step] for k in range(0, len(row), self.step))
        return found


# Classify the color of the ground: grass, stone.
def is_green(red, green, blue):
    return green > 1.1 * max(red, blue)


def is_grey(red, green, blue):
    return max(red, green, blue) < 1.1 * min(red, green, blue)


class Game:
    """The running program and its window."""

    pause = 0.4  # seconds, two frames, as pause_after() measured last

    def __init__(self, display, folder, arguments, data=None):
        """Runs in `folder`, and keeps worlds and settings there or in `data`."""
        self.display = display
        self.log = tempfile.TemporaryFile(mode="w+")
        self.process = subprocess.Popen(
            [support.program(), "play", "--debug-gl", "--no-title", *arguments], cwd=folder,
            env=support.environment(display.name, data or folder), stdout=self.log, stderr=self.log)
        self.window = None

    def open(self):
        self.window = self.wait_for(
            lambda: self.display.xdotool("search", "--onlyvisible", "--name", "^Terrane$"))
        # There is no window manager that places the window and gives it the focus.
        self.display.xdotool("windowmove", self.window, 0, 0)
        self.display.xdotool("windowfocus", self.window)

    def wait_for(self, condition):
        """Returns the result of the condition once it is true."""
        deadline = time.monotonic() + HANG_SECONDS
        while time.monotonic() < deadline:
            result = condition()
            if result:
                return result
            if self.process.poll() is not None:
                raise RuntimeError(f"the program ended: {self.output()}")
            time.sleep(0.05)
        raise RuntimeError(f"nothing happens: {self.output()}")

    def wait_for_image(self, size, x0=0, y0=0):
        """Waits for a window of this size with an image of a world: at the right edge, which has no text, a world has many
        colors, an undrawn window one."""
        def is_drawn():
            image = self.display.screenshot(self.window)
            return (image.width, image.height) == size and len(image.colors(max(x0, image.width - 6), y0)) > 5
        self.wait_for(is_drawn)

    def wait_for_ground(self, is_it):
        """Waits for a color (red, green, blue) of the block below the player, next to the crosshair."""
        self.wait_for(lambda: is_it(*self.display.screenshot(self.window).color(SIZE[0] // 2 + 8, SIZE[1] // 2 + 8)))

    def press(self, key):
        self.display.xdotool("key", key)

    @contextlib.contextmanager
    def asleep(self):
        """Suspends the program, so that keys are pressed and released within one frame, however long it takes."""
        self.process.send_signal(signal.SIGSTOP)
        try:
            yield
        finally:
            self.process.send_signal(signal.SIGCONT)

    def type(self, text):
        with self.asleep():
            self.display.xdotool("type", text)

    def pause_after(self, key):
        """Presses a key that changes the image, and returns a pause that scales with the time of the change, about two
        frames: on a busy machine pauses must be longer."""
        before, start = self.display.screenshot(self.window).pixels, time.monotonic()
        self.press(key)
        self.wait_for(lambda: self.display.screenshot(self.window).pixels != before)
        self.pause = max(0.4, 2 * (time.monotonic() - start))
        time.sleep(self.pause)
        return self.pause

    def press_alone(self, key, pause=0.5):
        """Presses and releases a key within one frame, with time for some frames before the next key."""
        with self.asleep():
            self.press(key)
        time.sleep(pause)

    def tap(self, button, x, y, pause):
        """Clicks too briefly for a repeated action."""
        self.display.xdotool("mousemove", "--window", self.window, x, y)
        time.sleep(pause)
        self.display.xdotool("click", button)
        time.sleep(pause)

    def take_mouse(self):
        """Clicks, so that the mouse turns the player."""
        self.tap(1, SIZE[0] // 2, SIZE[1] // 2, self.pause)

    def close(self, open_things=0):
        """Quits. Returns the exit code, the number of frames and the last position of the camera."""
        self.quit(open_things)
        code = self.process.wait(HANG_SECONDS)
        found = re.search(r"closed after (\d+) frames at (\S+),(\S+),(\S+)$", self.output(), re.MULTILINE)
        if not found:
            raise RuntimeError(f"no word of the camera: {self.output()}")
        return code, int(found[1]), tuple(float(found[k]) for k in (2, 3, 4))

    def quit(self, open_things=0):
        """Quits by the menu, after one Escape for each open thing (the panel, a chest)."""
        for _ in range(open_things + 1):
            self.pause_after("Escape")
        self.press("q")

    def output(self):
        self.log.seek(0)
        return self.log.read()


def main():
    """The entry point of all tests with a window."""
    if not shutil.which("Xvfb"):
        print("1 test skipped: Xvfb is not installed (Debian: xvfb)")
        sys.exit(SKIPPED)
    support.main()
