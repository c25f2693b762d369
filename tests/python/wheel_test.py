"""Tests the wheel of the tested package; tools/wheel.sh builds one from scratch."""
import base64
import hashlib
import pathlib
import subprocess
import sys
import zipfile

import terrane

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "python"))
import build_backend  # noqa: E402


def test_a_wheel_has_the_package_and_its_record(tmp_path):
    path = build_backend.write_wheel(pathlib.Path(terrane.__file__).parent, tmp_path)
    assert path.name == f"terrane-{terrane.__version__}-{build_backend.tag()}.whl"
    with zipfile.ZipFile(path) as wheel:
        info = f"terrane-{terrane.__version__}.dist-info"
        record = [line.split(",") for line in wheel.read(f"{info}/RECORD").decode().splitlines()]
        assert {name for name, _, _ in record} == set(wheel.namelist())
        for name, digest, size in record[:-1]:
            data = wheel.read(name)
            found = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            assert (digest, size) == (f"sha256={found}", str(len(data))), name
        wheel.extractall(tmp_path / "site")
    script = "import sys; sys.path.insert(0, sys.argv[1]); import terrane; print(terrane.__file__)"
    done = subprocess.run([sys.executable, "-B", "-c", script, tmp_path / "site"], capture_output=True, text=True, check=True)
    assert done.stdout == f"{tmp_path}/site/terrane/__init__.py\n"
