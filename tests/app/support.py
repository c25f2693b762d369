"""Shared by the tests of the program: runs it, and reads its files with the standard library."""
import ast
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

HANG_SECONDS = 120  # a guard against hangs; the tests wait for results, never for time

_program = None


def main():
    """Runs the tests of the calling script; its first argument is the program under test."""
    if len(sys.argv) < 2:
        sys.exit(f"usage: {sys.argv[0]} PROGRAM [unittest arguments]")
    set_program(sys.argv.pop(1))
    unittest.main(module="__main__", verbosity=2)


def set_program(path):
    global _program
    _program = str(pathlib.Path(path).resolve())


def program():
    return _program


def tests_all():
    """Whether tests run at full depth: tests/support/depth.h."""
    return os.environ.get("TERRANE_DEPTH") == "all"


def few(cases, count):
    """All cases at full depth; at the gate so many, spread over them."""
    return cases if tests_all() else cases[::max(1, -(-len(cases) // count))]


def environment(display=None, settings=None):
    """The environment of this process, with only the given display server, and with settings and worlds in terrane/ of a
    folder, or none."""
    variables = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    if display:
        variables["DISPLAY"] = display
    # Nothing can be created there, not even by root.
    variables["XDG_CONFIG_HOME"] = variables["XDG_DATA_HOME"] = str(settings or "/dev/null")
    return variables


def run(*arguments, display=None):
    """Runs the program to its end. Without `display` it finds no display server."""
    return subprocess.run([_program, *map(str, arguments)], capture_output=True, text=True, timeout=HANG_SECONDS,
                          env=environment(display), check=False)


class RunningProgram:
    """A running program: its log, and its console."""

    def __init__(self, folder, *arguments):
        self.log = tempfile.TemporaryFile(mode="w+")
        self.process = subprocess.Popen([_program, *map(str, arguments)], stdin=subprocess.PIPE, stdout=self.log,
                                        stderr=self.log, text=True, env=environment(None, folder))

    def output(self):
        self.log.seek(0)
        return self.log.read()

    def wait_for(self, pattern):
        """Returns the match in the log; fails if the program ends without one."""
        deadline = time.monotonic() + HANG_SECONDS
        while time.monotonic() < deadline:
            if found := re.search(pattern, self.output()):
                return found
            if self.process.poll() is not None:
                break
            time.sleep(0.05)
        raise RuntimeError(f"no {pattern} in: {self.output()}")

    def say(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def clean_up(self):
        self.process.kill()
        self.process.wait(HANG_SECONDS)
        self.process.stdin.close()
        self.log.close()


class ProgramTest(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="terrane_test_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def succeed(self, *arguments):
        """Standard output of a run that must succeed."""
        done = run(*arguments)
        self.assertEqual(done.returncode, 0, f"{arguments}: {done.stderr}")
        self.assertNotIn("error", done.stderr, arguments)
        return done.stdout

    def assertRefused(self, done, case):
        self.assertEqual(done.returncode, 2, f"{case}: {done.stderr}")
        self.assertEqual(done.stdout, "", case)
        self.assertEqual(done.stderr.count("\n"), 1, f"{case}: not one line: {done.stderr}")
        self.assertRegex(done.stderr, r"\Aterrane: error: [^\x00-\x1f]+\n\Z", case)


_PRIMES = (11400714785074694791, 14029467366897019727, 1609587929392839161, 9650029242287828579, 2870177450012600261)


def _rotate(value, bits):
    return (value << bits | value >> 64 - bits) & 2**64 - 1


def xxh64(data, seed):
    """xxHash64 as specified, for changes to saves."""
    p, mask, at = _PRIMES, 2**64 - 1, 0

    def mix(lane, word):
        return _rotate((lane + word * p[1]) & mask, 31) * p[0] & mask

    if len(data) >= 32:
        lanes = [(seed + p[0] + p[1]) & mask, (seed + p[1]) & mask, seed, (seed - p[0]) & mask]
        for at in range(0, len(data) - 31, 32):
            lanes = [mix(lane, word) for lane, word in zip(lanes, struct.unpack_from("<4Q", data, at))]
        at += 32
        result = sum(_rotate(lane, bits) for lane, bits in zip(lanes, (1, 7, 12, 18))) & mask
        for lane in lanes:
            result = ((result ^ mix(0, lane)) * p[0] + p[3]) & mask
    else:
        result = seed + p[4] & mask
    result = (result + len(data)) & mask
    while at + 8 <= len(data):
        result = (_rotate(result ^ mix(0, struct.unpack_from("<Q", data, at)[0]), 27) * p[0] + p[3]) & mask
        at += 8
    if at + 4 <= len(data):
        result = (_rotate(result ^ struct.unpack_from("<I", data, at)[0] * p[0] & mask, 23) * p[1] + p[2]) & mask
        at += 4
    for byte in data[at:]:
        result = _rotate(result ^ byte * p[4] & mask, 11) * p[0] & mask
    for shift, prime in ((33, p[1]), (29, p[2]), (32, 1)):
        result = (result ^ result >> shift) * prime & mask
    return result


def seal(data, key, origin):
    """Data of a chunk with the checksum of docs/file-format.md."""
    return struct.pack("<Q", xxh64(data[8:], 2 * key + origin)) + data[8:]


def _unfilter(kind, row, above, step):
    """Undoes the filter of one row of a PNG (W3C PNG specification, section 9)."""
    for i in range(len(row)):
        left = row[i - step] if i >= step else 0
        up = above[i]
        corner = above[i - step] if i >= step else 0
        if kind == 1:
            row[i] = (row[i] + left) & 255
        elif kind == 2:
            row[i] = (row[i] + up) & 255
        elif kind == 3:
            row[i] = (row[i] + (left + up) // 2) & 255
        elif kind == 4:
            guess = left + up - corner
            nearest = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))
            row[i] = (row[i] + nearest[2]) & 255
    return row


class Image:
    """A PNG with 8 bits per channel; rows of (red, green, blue)."""

    def __init__(self, path):
        data = pathlib.Path(path).read_bytes()
        if data[:8] != b"\x89PNG\r\n\x1a\n":
            raise ValueError(f"{path}: no PNG")
        packed, at = b"", 8
        while at < len(data):
            length, kind = struct.unpack(">I4s", data[at:at + 8])
            body = data[at + 8:at + 8 + length]
            if kind == b"IHDR":
                self.width, self.height, depth, color, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            elif kind == b"IDAT":
                packed += body
            at += 12 + length
        if depth != 8 or color not in (2, 6) or interlaced:
            raise ValueError(f"{path}: neither RGB nor RGBA of 8 bits")
        self._read(zlib.decompress(packed), 3 if color == 2 else 4)

    def _read(self, raw, step):
        stride = self.width * step
        above = bytearray(stride)
        self.rows = []
        for y in range(self.height):
            start = y * (stride + 1)
            above = _unfilter(raw[start], bytearray(raw[start + 1:start + 1 + stride]), above, step)
            self.rows.append([tuple(above[x:x + 3]) for x in range(0, stride, step)])

    def colors(self):
        return {pixel for row in self.rows for pixel in row}


def write_png(path, width, height, color):
    """Writes an image of one color: (red, green, blue, alpha)."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = (b"\0" + bytes(color) * width) * height
    pathlib.Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", width, height, 8, 6, 0, 0, 0)) +
                                   chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class Npy:
    """A NumPy file: descr, shape, and its bytes."""

    def __init__(self, path):
        data = pathlib.Path(path).read_bytes()
        if data[:8] != b"\x93NUMPY\x01\x00":
            raise ValueError(f"{path}: not version 1.0 of .npy")
        length = struct.unpack("<H", data[8:10])[0]
        if (10 + length) % 64 != 0 or data[10 + length - 1:10 + length] != b"\n":
            raise ValueError(f"{path}: the header is not padded to 64 bytes")
        header = ast.literal_eval(data[10:10 + length].decode("latin1"))
        if set(header) != {"descr", "fortran_order", "shape"} or header["fortran_order"]:
            raise ValueError(f"{path}: unexpected header {header}")
        self.descr, self.shape = header["descr"], header["shape"]
        self.data = data[10 + length:]

    def volume(self):
        """The values of a uint16 volume [x, y, z] as one flat sequence."""
        count = self.shape[0] * self.shape[1] * self.shape[2]
        if self.descr != "<u2" or len(self.data) != 2 * count:
            raise ValueError(f"{self.descr} {self.shape}: not a whole uint16 volume")
        return memoryview(self.data).cast("H")

    def column(self, x, y):
        height = self.shape[2]
        start = (x * self.shape[1] + y) * height
        return list(self.volume()[start:start + height])
