"""Memory does not grow; tools/python_leak.py makes 10,000 calls."""
import pathlib
import sys

import terrane

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tools"))
import python_leak  # noqa: E402


def test_calls_leave_no_memory_behind():
    before, after = python_leak.growth(rounds=40, warm_rounds=20)
    assert after - before < 4 << 20, f"{before} to {after} bytes"


def test_wrong_calls_leave_no_memory_behind():
    world = terrane.World(generator="flat", threads=1)

    def play(rounds):
        for number in range(rounds):
            text = str(number) * 200
            for call in (lambda: world.blocks((0, 0, 1, text)), lambda: world.chunks([(0.7, 5.9)]), lambda: world.blocks(wrong=text),
                         lambda: world.set_blocks(0, 0, 0, [[[number / 2]]]), lambda: terrane.World(text, text), lambda: world.states()):
                try:
                    call()
                except (terrane.Error, TypeError):
                    pass

    play(500)
    before = python_leak.resident_bytes()
    play(2000)
    assert python_leak.resident_bytes() - before < 4 << 20


def test_large_arrays_are_freed():
    world = terrane.World(generator="flat", threads=2)
    world.blocks((0, 0, 256, 256))
    before = python_leak.resident_bytes()
    for _ in range(6):
        world.blocks((0, 0, 400, 400)).fill(1)  # 78 MiB
    assert python_leak.resident_bytes() - before < 60 << 20
