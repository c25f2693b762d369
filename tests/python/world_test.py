"""Opening, properties, closing, errors."""
import gc
import os
import signal
import subprocess
import sys

import numpy as np
import pytest
import terrane

from conftest import HANG_SECONDS, fails


def test_a_world_says_what_it_is():
    world = terrane.World(seed=2**64 - 1, generator="hills3d", threads=1)
    assert (world.seed, world.generator, world.threads, world.location) == (2**64 - 1, "hills3d", 1, "")
    assert repr(world) == "<terrane.World seed=18446744073709551615 generator=hills3d>"
    assert terrane.World().generator == "wilderness"


def test_generators_are_listed():
    assert {"continents", "overworld", "flat"} <= set(terrane.generators())
    assert "overworld" in fails("bad_input", terrane.World, generator="overworlt")


def test_versions_are_equal(program):
    assert terrane.__version__ == program("--version")


@pytest.mark.parametrize("threads", [-1, 257, 10**6])
def test_wrong_numbers_of_threads(threads):
    assert "threads" in fails("bad_input", terrane.World, threads=threads)


def test_blocks_have_names_and_ids(flat):
    names = flat.block_names
    assert names[0] == "air" and len(names) == len(set(names)) > 50
    assert all(flat.block_id(name) == k for k, name in enumerate(names))
    assert '"stoen"' in fails("not_found", flat.block_id, "stoen")


def test_a_closed_world_does_nothing():
    with terrane.World(generator="flat") as world:
        assert not world.closed
    assert world.closed and "closed" in repr(world)
    world.close()
    for call in (lambda: world.blocks((0, 0, 1, 1)), lambda: world.heights((0, 0, 1, 1)), world.flush,
                 lambda: world.set_blocks(0, 0, 0, 0), lambda: world.block_names, lambda: world.light((0, 0, 1, 1))):
        assert fails("failed", call) == "the world is closed"
    assert world.seed == 1


def test_arrays_outlive_their_world():
    world = terrane.World(generator="flat")
    blocks = world.blocks((0, 0, 32, 32))
    del world
    gc.collect()
    assert blocks[80].min() > 0 and blocks.flags.writeable


def test_a_forked_process_is_told():
    world = terrane.World(generator="flat", threads=2)
    world.chunk(0, 0)
    child = os.fork()
    if child == 0:
        try:
            world.chunk(0, 0)
        except terrane.Error as error:
            del world
            os._exit(0 if "another process" in str(error) and terrane.World(generator="flat").chunk(0, 0).any() else 2)
        os._exit(1)
    assert os.waitpid(child, 0)[1] == 0


def test_control_c_ends_a_call():
    script = ("import terrane; world = terrane.World(generator='overworld', threads=2); print('now', flush=True)\n"
              "world.digest((0, 0, 100000, 100000))")
    with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as child:
        assert child.stdout.readline() == "now\n"
        child.send_signal(signal.SIGINT)
        _, errors = child.communicate(timeout=HANG_SECONDS)
    assert "KeyboardInterrupt" in errors and child.returncode != 0


ODD = [None, "", "flat", -1, 2**31, 2**70, 1.5, float("nan"), (), (0,), (0, 0, 1, 1), [1, 0, 0, 0], (0, 0, 0, 1, 1, 1),
       (0, 0, 0, 2**40, 2**40, 256), (-2**63, -2**63, 2**63 - 1, 2**63 - 1), ("a", "b", "c", "d"), np.zeros(3),
       np.zeros((2, 2)), np.zeros((1, 1, 1), np.uint16), np.full((1, 1, 1), 65535, np.uint16), object(), {}]


@pytest.mark.parametrize("method,count", [("blocks", 1), ("light", 1), ("heights", 2), ("surface", 2), ("chunk", 3),
                                          ("chunks", 2), ("digest", 1), ("set_blocks", 5), ("block_id", 1), ("states", 1),
                                          ("biomes", 2)])
def test_odd_arguments_are_errors(method, count):
    random = np.random.default_rng(1)
    with terrane.World(generator="flat", threads=1) as world:
        for _ in range(300):
            arguments = [ODD[random.integers(len(ODD))] for _ in range(count)]
            try:
                getattr(world, method)(*arguments)
            except terrane.Error as error:
                assert error.code in ("bad_input", "not_found", "unsupported")
