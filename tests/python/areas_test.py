"""Blocks, chunks, light and digests of areas."""
import itertools
import sys
import threading
import time

import numpy as np
import pytest
import terrane

from conftest import HANG_SECONDS, fails

EDGE = 2**31


def test_shape_type_and_axes(flat):
    blocks = flat.blocks((-3, 5, 79, 14, 25, 83))
    assert blocks.shape == (4, 20, 17) and blocks.dtype == np.uint16 and blocks.flags.c_contiguous
    grass = flat.block_id("grass")
    assert (blocks[1] == grass).all() and (blocks[2:] == 0).all() and (blocks[0] != grass).all()
    assert flat.blocks((0, 0, 1, 2)).shape == (256, 2, 1)


def test_areas_are_made_of_chunks(land):
    blocks = land.blocks((-37, -21, 40, 30, 27, 200))
    padded = np.zeros((256, 80, 80), np.uint16)
    for cy in range(-2, 3):
        for cx in range(-3, 2):
            y, x = 16 * cy + 32, 16 * cx + 48
            padded[:, y:y + 16, x:x + 16] = land.chunk(cx, cy)
    assert (blocks == padded[40:200, -21 + 32:27 + 32, -37 + 48:30 + 48]).all()
    assert len(np.unique(blocks)) > 5


def test_many_chunks_at_once(land):
    positions = np.array([[0, 0], [5, -7], [-1, 2]])
    for level in (0, 2):
        chunks = land.chunks(positions, level)
        assert chunks.shape == (3, 256, 16, 16)
        for k, (cx, cy) in enumerate(positions):
            assert (chunks[k] == land.chunk(cx, cy, level)).all()
    assert land.chunks(np.zeros((0, 2), int)).shape == (0, 256, 16, 16)
    assert land.chunks([(0, 0)]).any()


def test_areas_at_the_edge_of_the_world(flat):
    assert flat.blocks((EDGE - 2, -EDGE, 80, EDGE, -EDGE + 2, 81)).all()
    for area in ((EDGE - 1, 0, EDGE + 1, 1), (0, -EDGE - 1, 1, 0), (0, 0, -1, 1, 1, 1), (0, 0, 0, 1, 1, 257), (0, 0, 0, 1),
                 (1, 0, 0, 1), (0, 0, 0), (0,) * 7, (-EDGE, -EDGE, EDGE, EDGE), (0, 0, 2049, 2048)):
        assert "area" in fails("bad_input", flat.blocks, area)
        assert "area" in fails("bad_input", flat.light, area)
    for chunk in ((2**27, 0), (0, -2**27 - 1), (2**26, 0, 1), (0, 0, 16), (0, 0, -1), (2**40, 0)):
        text = fails("bad_input", flat.chunk, *chunk)
        assert "outside the world" in text or text.startswith(("cx: ", "cy: ", "level: ")), text
    fails("bad_input", flat.chunks, [(0, 0, 0)])
    assert "16385" in fails("bad_input", flat.chunks, np.zeros((16385, 2), int))
    fails("bad_input", flat.digest, (0, 0, 0, 1))


@pytest.mark.parametrize("generator", ["continents", "hills3d"])
def test_the_digest_is_that_of_the_program(program, generator):
    world = terrane.World(seed=5, generator=generator)
    expected = program("generate", "--seed", 5, "--generator", generator, "--area=-3,2,5,9", "--digest")
    assert world.digest((-3, 2, 5, 9)) == expected
    assert terrane.World(seed=6, generator=generator).digest((-3, 2, 5, 9)) != expected


def test_a_digest_is_one_of_the_blocks(land):
    xxhash = pytest.importorskip("xxhash")
    digest = xxhash.xxh3_128()
    for cy in range(2):
        for cx in range(3):
            digest.update(land.blocks((16 * cx, 16 * cy, 16 * cx + 16, 16 * cy + 16)).astype("<u2").tobytes())
    assert land.digest((0, 0, 3, 2)) == digest.hexdigest()


# Beyond the ends of the world it is dark, also for the program.
@pytest.mark.parametrize("cx,cy", [(-2, 1), *itertools.product((-EDGE // 16, EDGE // 16 - 3), repeat=2)])
def test_blocks_and_light_are_those_that_the_program_dumps(program, land, tmp_path, cx, cy):
    area = (16 * cx, 16 * cy, 16 * cx + 48, 16 * cy + 48)
    chunks = f"--area={cx},{cy},{cx + 3},{cy + 3}"
    for what in ("blocks", "light"):
        program("dump", "--generator", "overworld", chunks, "--what", what, "-o", tmp_path / "a.npy")
        dumped = np.load(tmp_path / "a.npy").transpose(2, 1, 0)  # dump writes x, y, z
        if what == "blocks":
            assert (land.blocks(area) == dumped).all()
        else:
            levels = np.stack([dumped >> 12, dumped & 15, dumped >> 4 & 15, dumped >> 8 & 15], axis=-1)
            assert (land.light(area) == levels).all()


def test_light_of_lamps(flat):
    with terrane.World(generator="flat") as world:
        world.set_blocks(0, 0, 90, np.full((3, 40, 40), world.block_id("stone")))
        world.set_blocks(8, 8, 91, np.zeros((1, 20, 20), int))
        world.set_blocks(18, 18, 91, "lamp_red")
        light = world.light((8, 8, 91, 28, 28, 92))[0]
        assert light.shape == (20, 20, 4) and light.dtype == np.uint8
        assert (light[..., 0] == 0).all()
        assert light[10, 10, 1] == light[..., 1].max() > 8
        assert light[10, 12, 1] == light[10, 10, 1] - 2
    assert (flat.light((0, 0, 100, 1, 1, 101)) == [15, 0, 0, 0]).all()


def test_threads_share_a_world(land):
    expected = land.blocks((0, 0, 64, 64))
    wrong = []

    def read():
        for _ in range(3):
            if (land.blocks((0, 0, 64, 64)) != expected).any() or land.light((0, 0, 60, 20, 20, 90)).max() != 15:
                wrong.append(1)

    threads = [threading.Thread(target=read) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_other_threads_run_meanwhile(land):
    begun, seen = threading.Event(), []

    def watch():
        begun.wait()
        seen.append(True)

    thread = threading.Thread(target=watch)
    thread.start()
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1000)  # other threads run only where this one lets them
    try:
        begun.set()
        end = time.monotonic() + HANG_SECONDS
        while not seen and time.monotonic() < end:
            land.blocks((1000, 0, 1016, 16))
    finally:
        sys.setswitchinterval(interval)
    assert seen


def test_worlds_of_other_heights(land, tmp_path):
    tall = terrane.World(seed=land.seed, generator=land.generator, bottom=-64, top=320)
    assert (tall.bottom, tall.top, land.bottom, land.top) == (-64, 320, 0, 256)
    blocks = tall.blocks((0, 0, 16, 16))
    assert blocks.shape == (384, 16, 16) and (blocks == tall.chunk(0, 0)).all()
    assert (blocks[64 + 70:64 + 256] == land.chunk(0, 0)[70:]).all() and (blocks[64 + 256:] == 0).all()
    assert tall.chunks([(0, 0)]).shape == (1, 384, 16, 16)
    assert tall.set_blocks(3, 4, -64, "glowing_ore") == 1 and tall.set_blocks(3, 4, 319, "stone") == 1
    assert tall.blocks((3, 4, -64, 4, 5, -63))[0, 0, 0] == tall.block_id("glowing_ore")
    assert tall.heights((3, 4, 4, 5))[0, 0] == 319
    assert tall.light((3, 4, 318, 4, 5, 320)).shape == (2, 1, 1, 4)
    for area in ((0, 0, -65, 1, 1, 0), (0, 0, 0, 1, 1, 321)):
        assert "-64 to 320" in fails("bad_input", tall.blocks, area)
    with terrane.open(str(tmp_path / "tall.sqlite"), create=True, generator="flat", bottom=-64, top=320) as saved:
        saved.set_blocks(0, 0, -64, "stone")
    with terrane.open(str(tmp_path / "tall.sqlite")) as again:
        assert (again.bottom, again.top) == (-64, 320) and again.blocks((0, 0, -64, 1, 1, -63))[0, 0, 0] == again.block_id("stone")
    assert "layers" in fails("incompatible", terrane.open, str(tmp_path / "tall.sqlite"), bottom=-80)
    assert "multiples of 16" in fails("bad_input", terrane.World, bottom=-7)
    assert "256 and 256" in fails("bad_input", terrane.World, generator="flat", bottom=256)
