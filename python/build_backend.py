#!/usr/bin/env python3
"""Builds the wheel of the package: for pip (PEP 517), and as a script for tools/wheel.sh.

    build_backend.py OUT [BUILD]   builds the target terrane_python in the folder BUILD (build-wheel) and writes
                                   OUT/terrane-VERSION-cpXY-cpXY-linux_ARCH.whl, whose path it prints

The wheel is for the Python that runs this, and needs the libraries of this system: it does not work on others.
"""
import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import zipfile

SOURCE = pathlib.Path(__file__).resolve().parents[1]
TIME = (1980, 1, 1, 0, 0, 0)  # of all files, so that equal contents give equal wheels
FILE_MODE = 0o100644 << 16


def version():
    return re.search(r"project\(terrane VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]


def tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def build(folder):
    """The folder of the built package."""
    if not (folder / "build.ninja").exists():  # written last: an earlier try may have lacked a library
        subprocess.run(["cmake", "-S", SOURCE, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON",
                        "-DTERRANE_TESTS=OFF", "-DTERRANE_BENCHMARKS=OFF", "-DTERRANE_WEB=OFF", "--log-level=WARNING",
                        f"-DTERRANE_PYTHON_PROGRAM={sys.executable}"], check=True, stdout=sys.stderr)
    subprocess.run(["cmake", "--build", folder, "--target", "terrane_python"], check=True, stdout=sys.stderr)
    return folder / "python" / "terrane"


def metadata():
    return "\n".join(["Metadata-Version: 2.1", "Name: terrane", f"Version: {version()}",
                      "Summary: Large voxel worlds as NumPy arrays", "Requires-Python: >=3.9", "Requires-Dist: numpy", "", ""])


def contents(package):
    """Bytes by path in the wheel, without RECORD."""
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    names = ["__init__.py", "__init__.pyi", "py.typed", f"_terrane{suffix}"]
    files = {f"terrane/{name}": (package / name).read_bytes() for name in names}
    info = f"terrane-{version()}.dist-info"
    files[f"{info}/METADATA"] = metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: terrane\nRoot-Is-Purelib: false\nTag: {tag()}\n".encode()
    files[f"{info}/LICENSE"] = (SOURCE / "LICENSE").read_bytes()
    return files, f"{info}/RECORD"


def write_wheel(package, folder):
    files, record = contents(package)
    lines = []
    for name, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        lines.append(f"{name},sha256={digest},{len(data)}\n")
    files[record] = ("".join(lines) + f"{record},,\n").encode()
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"terrane-{version()}-{tag()}.whl"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, TIME)
            entry.external_attr = FILE_MODE
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, data)
    return path


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    folder = pathlib.Path(os.environ.get("TERRANE_WHEEL_BUILD", SOURCE / "build-wheel"))
    return write_wheel(build(folder), pathlib.Path(wheel_directory)).name


def main():
    if not 2 <= len(sys.argv) <= 3:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else SOURCE / "build-wheel"
    print(write_wheel(build(folder), pathlib.Path(sys.argv[1])))


if __name__ == "__main__":
    main()
