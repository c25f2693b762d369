"""Runs a program and measures it: CPU time, peak memory and wall time of one process."""
import contextlib
import os
import pathlib
import shutil
import subprocess
import tempfile
import time
from dataclasses import dataclass

POLL_SECONDS = 0.02
PSS_SECONDS = 1.0   # the kernel walks all pages of the process for each reading
STOP_SECONDS = 30


class CompareError(Exception):
    """One line that names the failed program or file, and the reason."""


@dataclass(frozen=True)
class Finished:
    output: str
    errors: str
    seconds: float      # wall time
    cpu_seconds: float  # user and system, all threads
    peak_rss: int       # bytes, at the last reading before the end
    peak_pss: int       # bytes, the largest of one reading per second


class Child:
    """A running process. `wait` and `stop` return its resource usage; leaving the `with` block always ends it."""

    def __init__(self, command, environment=None, folder=None, timeout=600):
        self.command = [str(word) for word in command]
        self.files = [tempfile.TemporaryFile(mode="w+", encoding="utf-8", errors="replace") for _ in range(2)]
        self.start, self.timeout = time.monotonic(), timeout
        self.peak_rss = self.peak_pss = 0
        self.next_pss, self.finished, self.exit_code = 0.0, None, None
        try:
            self.process = subprocess.Popen(
                self.command, stdin=subprocess.DEVNULL, stdout=self.files[0], stderr=self.files[1], cwd=folder,
                env={**os.environ, **(environment or {})}, start_new_session=True)
        except OSError as error:
            raise CompareError(f"{self.command[0]}: cannot be started: {error.strerror}") from error

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.finished is None:
            self.stop()
        for file in self.files:
            file.close()

    def is_running(self):
        """Also reads the memory of the process, so call it often."""
        if self.finished:
            return False
        pid, status, usage = os.wait4(self.process.pid, os.WNOHANG)
        if pid == 0:
            self._read_memory()
            return True
        self.exit_code = self.process.returncode = os.waitstatus_to_exitcode(status)
        self.finished = Finished(self.text(0), self.text(1), time.monotonic() - self.start,
                                 usage.ru_utime + usage.ru_stime, self.peak_rss, self.peak_pss)
        return False

    def text(self, number=0):
        """Standard output (0) or standard error (1) so far."""
        # A seek would move the position at which the child writes, as both share it.
        descriptor = self.files[number].fileno()
        return os.pread(descriptor, os.fstat(descriptor).st_size, 0).decode("utf-8", "replace")

    def wait(self):
        """Raises CompareError if the process fails or takes longer than the timeout."""
        while self.is_running():
            if time.monotonic() - self.start > self.timeout:
                self.stop()
                raise CompareError(f"{self.command[0]}: stopped after {self.timeout:.0f} s")
            time.sleep(POLL_SECONDS)
        if self.exit_code != 0:
            last = (self.finished.errors.strip() or self.finished.output.strip() or "no message").splitlines()[-1]
            raise CompareError(f"{pathlib.Path(self.command[0]).name}: exit code {self.exit_code}: {last[:200]}")
        return self.finished

    def stop(self):
        """Ends the process; returns its resource usage."""
        deadline = time.monotonic() + STOP_SECONDS
        self._signal(subprocess.signal.SIGTERM)
        while self.is_running():
            if time.monotonic() > deadline:
                self._signal(subprocess.signal.SIGKILL)
            time.sleep(POLL_SECONDS)
        return self.finished

    def _signal(self, number):
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.process.pid, number)

    def _read_memory(self):
        """Reads the resident peak from /proc: ru_maxrss also counts the parent before exec."""
        now = time.monotonic()
        self.peak_rss = max(self.peak_rss, self._kilobytes("status", "VmHWM") * 1024)
        if now >= self.next_pss:
            self.next_pss = now + PSS_SECONDS
            self.peak_pss = max(self.peak_pss, self._kilobytes("smaps_rollup", "Pss") * 1024)

    def _kilobytes(self, file, name):
        """0 if the process has just ended."""
        with contextlib.suppress(OSError, ValueError, IndexError):
            text = pathlib.Path(f"/proc/{self.process.pid}/{file}").read_text(encoding="utf-8")
            return int(text.split(f"\n{name}:", 1)[1].split()[0])
        return 0


def run(command, **options):
    """Runs a program to its end. Raises CompareError if it fails."""
    with Child(command, **options) as child:
        return child.wait()


def find_program(names, hint):
    """The first of `names` (commands or paths) that exists."""
    for name in names:
        if path := shutil.which(name):
            return path
    raise CompareError(f"{names[0]} is not installed: {hint}")
