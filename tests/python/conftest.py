"""Shared by the tests of the package. TERRANE_PROGRAM names the program; PYTHONPATH finds the package."""
import os
import subprocess

import pytest
import terrane

HANG_SECONDS = 120


@pytest.fixture(scope="session")
def flat():
    return terrane.World(seed=3, generator="flat", threads=2)


@pytest.fixture(scope="session")
def land():
    return terrane.World(seed=1, generator="overworld", threads=2)


@pytest.fixture
def program():
    """Runs the program and returns what it prints."""
    path = os.environ.get("TERRANE_PROGRAM")
    if not path:
        pytest.skip("TERRANE_PROGRAM is not set")

    def run(*arguments):
        done = subprocess.run([path, *map(str, arguments)], capture_output=True, text=True, timeout=HANG_SECONDS, check=False)
        assert done.returncode == 0, done.stderr
        return done.stdout.strip()

    return run


def fails(code, call, *arguments, **options):
    """The error message of a failing call, which must be one line."""
    with pytest.raises(terrane.Error) as caught:
        call(*arguments, **options)
    assert caught.value.code == code, str(caught.value)
    assert "\n" not in str(caught.value) and str(caught.value)
    return str(caught.value)
