"""Runs processes in groups, and ends them with all their children."""

import os
import signal
import subprocess
import tempfile
from dataclasses import dataclass


@dataclass
class Done:
    code: "int | None"  # None: ended at the time limit
    output: str


def end_group(process):
    """Ends the process and its group, and waits for it."""
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    process.wait()


def ask_to_end(process):
    """Ninja's compilers are groups of their own, which only Ninja ends."""
    if process.poll() is None:
        process.terminate()
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            pass


def run_group(command, environment, limit_seconds):
    """Runs the command in its own group, with standard error in its output."""
    with tempfile.TemporaryFile() as output:
        process = subprocess.Popen(command, env=environment, stdin=subprocess.DEVNULL, stdout=output,
                                   stderr=subprocess.STDOUT, start_new_session=True)
        try:
            code = process.wait(limit_seconds)
        except subprocess.TimeoutExpired:
            code = None
        finally:
            ask_to_end(process)
            end_group(process)
        output.seek(0)
        return Done(code, output.read().decode(errors="replace"))
