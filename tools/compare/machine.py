"""The environment of a comparison: machine, versions of all programs, load."""
import contextlib
import ctypes
import os
import pathlib
import platform
import re
import shutil
import sqlite3
import subprocess

from luanti import luanti_version


def load_average():
    """Load average of the last minute: processes that run or wait to run."""
    return round(os.getloadavg()[0], 2)


def machine():
    return {"CPU": cpu_name(), "cores": os.cpu_count(), "memory, GB": memory_gigabytes(), "system": system_name()}


def versions(program):
    """"–" if a program is not installed."""
    return {"Terrane": output_of(program, "--version") or "–", "Luanti": luanti_version() or "–",
            "Mesa": package_version("libgl1-mesa-dri") or "–", "zstd": zstd_version() or "–",
            "SQLite": sqlite3.sqlite_version, "kernel": platform.release().partition("-")[0], "Python": platform.python_version()}


def cpu_name():
    with contextlib.suppress(OSError):
        found = re.search(r"^model name\s*:\s*(.+)$", pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.M)
        if found:
            return found[1].strip()
    return platform.processor() or platform.machine()


def memory_gigabytes():
    return round(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") / 1e9, 1)


def system_name():
    with contextlib.suppress(OSError):
        return platform.freedesktop_os_release().get("PRETTY_NAME", platform.system())
    return platform.system()


def zstd_version():
    with contextlib.suppress(OSError):
        number = ctypes.CDLL("libzstd.so.1").ZSTD_versionNumber()
        return f"{number // 10000}.{number // 100 % 100}.{number % 100}"
    return None


def package_version(name):
    """The version of a Debian package."""
    return output_of("dpkg-query", "--show", "--showformat=${Version}", name) if shutil.which("dpkg-query") else None


def output_of(*command):
    """None if the program fails."""
    with contextlib.suppress(OSError, subprocess.SubprocessError):
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=60, check=True)
        return done.stdout.strip() or None
    return None
