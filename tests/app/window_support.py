"""What tests of the window share: a virtual display, screenshots, the running program and its keys.

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
    def __init__(self, size=SCREEN, repeats_keys=False):
        super().__init__(size, repeats_keys)

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
        self.step = self.stride // self.width  # bytes a pixel; for some visuals the header counts the bits used
        if version != 7 or depth < 24:
            raise ValueError(f"unexpected window dump: version {version}, depth {depth}")
        self.pixels = data[header_bytes + 12 * header[19]:]  # behind the color map

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


# What kind of ground a color is of: grass, earth, stone.
def is_green(red, green, blue):
    return green > 1.1 * max(red, blue)


def is_brown(red, green, blue):
    return red > 1.1 * green > 1.1 * blue


def is_grey(red, green, blue):
    return max(red, green, blue) < 1.1 * min(red, green, blue)


class Game:
    """The running program and its window."""

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
        # Without a window manager nobody else gives the window its place and the keys.
        self.display.xdotool("windowmove", self.window, 0, 0)
        self.display.xdotool("windowfocus", self.window)

    def wait_for(self, condition):
        """What the condition gives once it is true."""
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
        """Waits for a window of this size with an image: a world has many colors, an undrawn window one, beside the texts
        over it, which reach no edge at the right."""
        def is_drawn():
            image = self.display.screenshot(self.window)
            return (image.width, image.height) == size and len(image.colors(max(x0, image.width - 6), y0)) > 5
        self.wait_for(is_drawn)

    def wait_for_ground(self, is_it):
        """Waits for a color (red, green, blue) of the block that one looks down on, beside the crosshair."""
        self.wait_for(lambda: is_it(*self.display.screenshot(self.window).color(SIZE[0] // 2 + 8, SIZE[1] // 2 + 8)))

    # In a window as large as the screen:
    def is_red(self, y):
        red, green, blue = self.display.screenshot(self.window).color(SCREEN[0] // 2 - 200, y)
        return red > 3 * max(green, blue)

    def is_warned(self):
        """That saving fails."""
        return self.is_red(18)

    def asks_to_lose(self):
        """Whether to quit although saving fails."""
        return self.is_red(194)

    def quit_unsaved(self):
        """The button that says so."""
        self.click(1, 322, 228)

    def press(self, key):
        self.display.xdotool("key", key)

    @contextlib.contextmanager
    def asleep(self):
        """The program sleeps meanwhile: its keys go down and up within one frame, however long frames take."""
        self.process.send_signal(signal.SIGSTOP)
        try:
            yield
        finally:
            self.process.send_signal(signal.SIGCONT)

    def type(self, text):
        with self.asleep():
            self.display.xdotool("type", text)

    def pause_after(self, key):
        """Presses a key that changes the image. What is waited for is two frames or so: on a busy machine they take
        long, and so must pauses."""
        before, start = self.display.screenshot(self.window).pixels, time.monotonic()
        self.press(key)
        self.wait_for(lambda: self.display.screenshot(self.window).pixels != before)
        pause = max(0.4, 2 * (time.monotonic() - start))
        time.sleep(pause)
        return pause

    def press_alone(self, key, pause=0.5):
        """Down and up within one frame, with time for some frames before the next key."""
        with self.asleep():
            self.press(key)
        time.sleep(pause)

    def click(self, button, x=SIZE[0] // 2, y=SIZE[1] // 2, pause=0.3):
        self.display.xdotool("mousemove", "--window", self.window, x, y)
        time.sleep(pause)  # some frames, in which the program sees the cursor there
        self.display.xdotool("mousedown", button)
        time.sleep(pause)
        self.display.xdotool("mouseup", button)
        time.sleep(pause)

    def tap(self, button, x, y, pause):
        """A click too short to act twice."""
        self.display.xdotool("mousemove", "--window", self.window, x, y)
        time.sleep(pause)
        self.display.xdotool("click", button)
        time.sleep(pause)

    def close(self, open_things=0):
        """The exit code, and where the camera was at the end."""
        self.quit(open_things)
        code = self.process.wait(HANG_SECONDS)
        found = re.search(r"closed after (\d+) frames at (\S+),(\S+),(\S+)$", self.output(), re.MULTILINE)
        if not found:
            raise RuntimeError(f"no word of the camera: {self.output()}")
        return code, int(found[1]), tuple(float(found[k]) for k in (2, 3, 4))

    def quit(self, open_things=0):
        """By the menu. What is open (the panel, a chest) is closed first, each by an Escape of its own."""
        for _ in range(open_things + 1):
            self.pause_after("Escape")
        self.press("q")

    def output(self):
        self.log.seek(0)
        return self.log.read()


def main():
    """Of each program that tests a window."""
    if not shutil.which("Xvfb"):
        print("1 test skipped: Xvfb is not installed (Debian: xvfb)")
        sys.exit(SKIPPED)
    support.main()
