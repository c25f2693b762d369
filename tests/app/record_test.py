#!/usr/bin/env python3
"""terrane record, end to end: videos according to ffprobe, frames, edits, errors. Usage: record_test.py PROGRAM"""
import json
import os
import pathlib
import re
import signal
import subprocess
import time

import support
from support import Image, ProgramTest, run

SMALL = ("--size", "160x90", "--view-distance", "2", "--preset", "low")
# Flat grass at z = 80, on which every camera here looks down.
HEAD = 'generator = "flat"\n'
KEY = "[[shot.key]]\nat = [8.5, 8.5, 90]\nlook = [0, -89]\n"


def shot(seconds, more="", key=KEY):
    return f"[[shot]]\nseconds = {seconds}\n{key}{more}"


class RecordTest(ProgramTest):
    def path(self, text):
        file = self.folder / "path.toml"
        file.write_text(text)
        return file

    def frames(self, text, *arguments):
        folder = self.folder / "frames"
        self.succeed("record", "--path", self.path(text), "--frames-dir", folder, *SMALL, *arguments)
        files = sorted(folder.iterdir())
        self.assertEqual([f.name for f in files], [f"frame_{k:05}.png" for k in range(len(files))])
        images = [Image(f) for f in files]
        for file in files:
            file.unlink()
        return images


class Video(RecordTest):
    def probe(self, file):
        done = subprocess.run(
            ["ffprobe", "-v", "error", "-count_frames", "-show_streams", "-show_format", "-of", "json", str(file)],
            capture_output=True, text=True, check=True, timeout=support.HANG_SECONDS)
        result = json.loads(done.stdout)
        self.assertEqual(len(result["streams"]), 1)
        return result["streams"][0], result["format"]

    def test_two_seconds(self):
        flight = "[[shot.key]]\ntime = 2\nat = [24.5, 8.5, 88]\nlook = [20, -40]\n"
        for name, container in (("a.mp4", "mp4"), ("b.mkv", "matroska")):
            video = self.folder / name
            text = self.succeed("record", "--path", self.path(HEAD + shot(2, flight)), "-o", video, *SMALL,
                                "--fps", "10", "--debug-gl")
            self.assertEqual(text, "")
            stream, form = self.probe(video)
            self.assertEqual((stream["codec_name"], stream["width"], stream["height"]), ("h264", 160, 90))
            self.assertEqual((stream["pix_fmt"], stream["color_space"]), ("yuv420p", "bt709"))
            self.assertEqual(int(stream["nb_read_frames"]), 20)
            self.assertEqual(stream["r_frame_rate"], "10/1")
            self.assertAlmostEqual(float(form["duration"]), 2, places=2)
            self.assertIn(container, form["format_name"])
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["a.mp4", "b.mkv", "path.toml"])

    def test_a_part_replaces_the_file_that_was_there(self):
        video = self.folder / "a.mp4"
        video.write_text("something old")
        self.succeed("record", "--path", self.path(HEAD + shot(2)), "-o", video, *SMALL, "--fps", "8", "--from", "0.5",
                     "--until", "1.25")
        self.assertEqual(int(self.probe(video)[0]["nb_read_frames"]), 6)

    # Colors survive encoding, neither swapped nor upside down.
    def test_colors(self):
        lamp = shot(1, "[[shot.edit]]\nfrom = [0, 0, 80]\nto = [16, 8, 80]\nblock = \"lamp_red\"\n")
        image = self.frames(HEAD + lamp, "--fps", "1", "--light", "classic")[0]
        video, back = self.folder / "a.mp4", self.folder / "back.png"
        self.succeed("record", "--path", self.path(HEAD + lamp), "-o", video, *SMALL, "--fps", "1", "--light", "classic")
        subprocess.run(["ffmpeg", "-v", "error", "-i", str(video), "-frames:v", "1", str(back)], check=True,
                       timeout=support.HANG_SECONDS)
        decoded = Image(back)
        for x, y in ((8, 8), (150, 8), (8, 80), (150, 80), (80, 45)):
            around = [(u, v) for u in range(x - 5, x + 6) for v in range(y - 5, y + 6)]
            for channel in range(3):
                means = [sum(p.rows[v][u][channel] for u, v in around) / len(around) for p in (image, decoded)]
                self.assertAlmostEqual(*means, delta=12, msg=f"{x},{y} channel {channel}")

    def test_without_ffmpeg(self):
        for arguments in (("-o", self.folder / "a.mp4"),):
            done = subprocess.run(
                [support.program(), "record", "--path", self.path(HEAD + shot(1)), *map(str, arguments), *SMALL],
                capture_output=True, text=True, timeout=support.HANG_SECONDS, check=False,
                env=support.environment() | {"PATH": str(self.folder)})
            self.assertRefused(done, arguments)
            self.assertIn("apt-get install ffmpeg", done.stderr)
        self.assertEqual([p.name for p in self.folder.iterdir()], ["path.toml"])

    def test_an_ffmpeg_that_fails(self):
        tool = self.folder / "ffmpeg"
        tool.write_text("#!/bin/sh\necho first >&2\necho 'no such encoder' >&2\nexit 1\n")
        tool.chmod(0o755)
        done = subprocess.run(
            [support.program(), "record", "--path", self.path(HEAD + shot(1)), "-o", self.folder / "a.mp4", *SMALL],
            capture_output=True, text=True, timeout=support.HANG_SECONDS, check=False,
            env=support.environment() | {"PATH": f"{self.folder}:{os.environ['PATH']}"})
        self.assertRefused(done, "ffmpeg fails")
        self.assertIn("no such encoder", done.stderr)
        self.assertFalse((self.folder / "a.mp4").exists())

    def test_an_interrupt_leaves_nothing(self):
        video = self.folder / "a.mp4"
        video.write_text("the one before")
        for number in (signal.SIGINT, signal.SIGTERM):
            process = subprocess.Popen(
                [support.program(), "record", "--path", self.path(HEAD + shot(3000)), "-o", video, *SMALL],
                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=support.environment())
            end = time.monotonic() + support.HANG_SECONDS
            while not list(self.folder.glob("a.mp4.part*")) and process.poll() is None and time.monotonic() < end:
                time.sleep(0.02)
            process.send_signal(number)
            _, errors = process.communicate(timeout=support.HANG_SECONDS)
            self.assertEqual(process.returncode, 2, errors)
            self.assertIn("stopped", errors)
            self.assertEqual(video.read_text(), "the one before")
            self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["a.mp4", "path.toml"])


    def test_an_interrupt_while_ffmpeg_finishes_waits_for_it(self):
        tool, finishing, may_end = (self.folder / name for name in ("ffmpeg", "finishing", "may_end"))
        os.mkfifo(may_end)
        pipe = os.open(may_end, os.O_RDWR)
        self.addCleanup(os.close, pipe)
        tool.write_text(f"#!/bin/sh\ncat > /dev/null\ntouch '{finishing}'\nread answer < '{may_end}'\n"
                        "for last; do :; done\necho video > \"${last#file:}\"\n")
        tool.chmod(0o755)
        process = subprocess.Popen(
            [support.program(), "record", "--path", self.path(HEAD + shot(1)), "-o", self.folder / "a.mp4", *SMALL],
            stderr=subprocess.PIPE, text=True,
            env=support.environment() | {"PATH": f"{self.folder}:{os.environ['PATH']}"})
        end = time.monotonic() + support.HANG_SECONDS
        while not finishing.exists() and process.poll() is None and time.monotonic() < end:
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        while self.has_signals(process.pid) and time.monotonic() < end:
            time.sleep(0.02)
        os.write(pipe, b"yes\n")
        _, errors = process.communicate(timeout=support.HANG_SECONDS)
        self.assertEqual(process.returncode, 0, errors)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()),
                         ["a.mp4", "ffmpeg", "finishing", "may_end", "path.toml"])

    def has_signals(self, pid):
        """Whether a process was sent a signal that it has not taken yet."""
        status = pathlib.Path(f"/proc/{pid}/status").read_text("ascii")
        return re.search(r"^ShdPnd:\s*0+$", status, re.MULTILINE) is None


class Frames(RecordTest):
    def test_the_same_every_time(self):
        text = shot(1, "[[shot.key]]\ntime = 1\nat = [-1040, -100, 118]\nlook = [150, -20]\nday = 0.6\n",
                    "[[shot.key]]\nat = [-1048, -108, 122]\nlook = [136, -6]\nday = 0.4\n")
        count = 4 if support.tests_all() else 2
        video = ("--fps", count, "--shadows", "near")
        one = self.frames(text, *video, "--threads", "1")
        two = self.frames(text, *video, "--threads", "2")
        part = self.frames(text, *video, "--from", "0.5")
        self.assertEqual(len(one), count)
        self.assertEqual([p.rows for p in one], [p.rows for p in two])
        self.assertEqual([p.rows for p in one[count // 2:]], [p.rows for p in part])
        for a, b in zip(one, one[1:]):
            self.assertNotEqual(a.rows, b.rows)

    def test_back_ends_draw_the_same(self):
        text = HEAD + shot(1, "[[shot.edit]]\ntime = 0.5\nat = [8, 8, 81]\nblock = \"lamp_red\"\n")
        cpu, gpu = (self.frames(text, "--fps", "4", "--backend", name) for name in ("cpu", "gpu"))
        self.assertEqual([image.rows for image in cpu], [image.rows for image in gpu])
        self.assertNotEqual(cpu[1].rows, cpu[3].rows, "the lamp is there")

    def test_edits_titles_and_views_come_in_time(self):
        cues = ('[[shot.edit]]\ntime = 2\nfrom = [0, 0, 84]\nto = [16, 16, 84]\nblock = "snow"\n'
                '[[shot.set]]\ntime = 4\nview = "normal"\n'
                '[[shot.title]]\ntime = 5\nseconds = 2\ntext = "WWWW"\nplace = "middle"\n')
        frames = [p.rows for p in self.frames(HEAD + shot(8, cues), "--fps", "1", "--animation", "off")]
        self.assertEqual(len(frames), 8)
        first = {0: 0, 1: 0, 2: 2, 3: 2, 4: 4, 5: 4, 6: 6, 7: 4}
        for k, like in first.items():
            self.assertEqual(frames[k] == frames[like], True, f"frame {k} is not as {like}")
        for a, b in ((0, 2), (2, 4), (4, 6)):
            self.assertNotEqual(frames[a], frames[b])
        self.assertGreater(min(frames[2][45][80]), 150, "snow is white")

    # Edits are still there after a journey on which they were unloaded; also if only a part of the video is recorded.
    def test_edits_outlive_a_journey(self):
        build = '[[shot.edit]]\nfrom = [0, 0, 84]\nto = [16, 16, 84]\nblock = "snow"\n'
        away = shot(12, key=KEY.replace("[8.5, 8.5, 90]", "[5000, 8.5, 90]"))
        text = HEAD + shot(1, build) + away + shot(1)
        frames = [p.rows for p in self.frames(text, "--fps", "1", "--animation", "off")]
        self.assertEqual(len(frames), 14)
        self.assertNotEqual(frames[0], frames[1])
        self.assertEqual(frames[13] == frames[0], True, "what was built is gone")
        last = self.frames(text, "--fps", "1", "--animation", "off", "--from", "13")
        self.assertEqual(last[0].rows == frames[0], True, "what was built before the part is not there")

    def test_a_camera_inside_a_block_is_told_once(self):
        down = '[[shot.key]]\ntime = 4\nat = [8.5, 8.5, 70]\n'
        done = run("record", "--path", self.path(HEAD + shot(4, down)),
                   "--frames-dir", self.folder / "f", "--fps", "2", *SMALL)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("the camera is inside grass"), 1, done.stderr)
        self.assertEqual(done.stderr.count("the camera is inside"), 1, done.stderr)

    def test_a_block_is_taken_away(self):
        dig = '[[shot.edit]]\ntime = 1\nfrom = [-20, -20, 80]\nto = [40, 40, 80]\nblock = "air"\n'
        before, after = [p.rows[45][80] for p in self.frames(HEAD + shot(2, dig), "--fps", "1")]
        self.assertGreater(before[1], before[0], "grass is green")
        self.assertLess(after[1], after[0], "dirt is not")


class Errors(RecordTest):
    def refuse(self, hint, text, *arguments):
        done = run("record", "--path", self.path(text), *arguments)
        self.assertRefused(done, arguments)
        self.assertIn(hint, done.stderr)
        self.assertEqual([p.name for p in self.folder.iterdir()], ["path.toml"])

    def test_errors_of_the_file_name_line_and_key(self):
        out = ("-o", self.folder / "a.mp4")
        self.refuse("path.toml:4: look: missing", "\n\n[[shot]]\n[[shot.key]]\nat = [0, 0, 0]\n", *out)
        self.refuse('path.toml:9: block: expected', HEAD + shot(1, '[[shot.edit]]\nat = [0, 0, 0]\nblock = "tin"\n'),
                    *out)
        self.refuse("path.toml:1: ", "seed = = 1", *out)
        self.refuse('unknown generator "nope"', 'generator = "nope"\n' + shot(1), *out)

    def test_wrong_arguments(self):
        good = HEAD + shot(2)
        video = self.folder / "a.mp4"
        self.refuse("--output or --frames-dir", good)
        self.refuse("--frames-dir", good, "-o", video, "--frames-dir", self.folder / "f")
        self.refuse("161x90", good, "-o", video, "--size", "161x90")
        self.refuse(".mp4 or .mkv", good, "-o", self.folder / "a.gif")
        self.refuse("a.mp4/", good, "-o", f"{video}/")
        self.refuse("missing", good, "-o", self.folder / "missing" / "a.mp4")
        self.refuse("missing", good, "--frames-dir", self.folder / "missing" / "frames")
        self.refuse("not empty", good, "--frames-dir", self.folder)
        self.refuse("--fps", good, "-o", video, "--fps", "0")
        self.refuse("no frame", good, "-o", video, "--from", "2")
        self.refuse("no frame", good, "-o", video, "--from", "1", "--until", "1")
        done = run("record", "-o", video)
        self.assertRefused(done, "no path")
        done = run("record", "--path", self.folder / "none.toml", "-o", video)
        self.assertRefused(done, "no such path")
        self.assertIn("none.toml", done.stderr)


if __name__ == "__main__":
    support.main()
