"""Edits, in memory and in saves."""
import numpy as np
import pytest
import terrane

from conftest import fails


def test_arrays_names_and_ids():
    with terrane.World(generator="flat") as world:
        stone = world.block_id("stone")
        assert world.set_blocks(-5, 7, 90, "stone") == 1
        assert world.set_blocks(-5, 7, 90, stone) == 0
        assert world.set_blocks(-5, 7, 90, np.array(0)) == 1
        box = np.random.default_rng(2).integers(0, 20, (9, 30, 40)).astype(np.uint16)
        assert world.set_blocks(-11, -13, 100, box) == np.count_nonzero(box)
        assert (world.blocks((-11, -13, 100, 29, 17, 109)) == box).all()
        for other in (box.astype(np.int32), box.tolist(), np.asfortranarray(box), box[::-1][::-1]):
            assert world.set_blocks(-11, -13, 100, other) == 0
        assert world.set_blocks(-11, -13, 100, box[:, ::2]) > 0
        assert (world.blocks((-11, -13, 100, 29, 2, 109)) == box[:, ::2]).all()


def test_states_are_kept(tmp_path):
    file = str(tmp_path / "world.sqlite")
    random = np.random.default_rng(3)
    ids, states = random.integers(1, 5, (7, 20, 30)), random.integers(0, 2**16, (7, 20, 30))
    area = (-11, -13, 100, 19, 7, 107)
    with terrane.open(file, create=True, generator="flat") as world:
        assert not world.states((0, 0, 20, 20)).any()
        assert world.set_blocks(-11, -13, 100, ids, states) == ids.size
        assert world.set_blocks(-11, -13, 100, ids, states) == world.set_blocks(-11, -13, 100, ids) == 0
        assert world.set_blocks(-11, -13, 100, ids, 7) == np.count_nonzero(states != 7)
        assert world.set_blocks(-11, -13, 100, ids, states.astype(np.uint16)) == np.count_nonzero(states != 7)
        assert world.set_blocks(-11, -13, 100, "sand", 3) == world.set_blocks(-11, -13, 100, "air") == 1
    with terrane.open(file) as world:
        kept, read = world.states(area), world.blocks(area)
        assert kept.dtype == np.uint16 and kept.flags.c_contiguous
        assert kept[0, 0, 0] == read[0, 0, 0] == 0
        assert (kept.flat[1:] == states.flat[1:]).all() and (read.flat[1:] == ids.flat[1:]).all()
        assert world.set_blocks(-10, -13, 100, "lamp_white") == 1 and world.states((-10, -13, 100, -9, -12, 101)) == 0


def test_wrong_blocks_change_nothing():
    with terrane.World(generator="flat") as world:
        count = len(world.block_names)
        for blocks in (count, -1, 2**16, 2**40, [[[1, count]]], np.full((1, 1, 2), -5)):
            text = fails("bad_input", world.set_blocks, 0, 0, 90, blocks)
            assert text.startswith(("block id", "blocks: expected")), text
        fails("not_found", world.set_blocks, 0, 0, 90, "stoen")
        fails("bad_input", world.set_blocks, 0, 0, 90, 1.5)
        fails("bad_input", world.set_blocks, 0, 0, 90, [1, 2])
        fails("bad_input", world.set_blocks, 0, 0, 255, np.zeros((2, 1, 1), int))
        fails("bad_input", world.set_blocks, 2**62, 0, 0, 1)
        fails("bad_input", world.set_blocks, 0, 0, 0, np.zeros((0, 1, 1), int))
        assert not world.blocks((0, 0, 90, 16, 16, 256)).any()


def test_a_save_keeps_edits(tmp_path, program):
    file = str(tmp_path / "world.sqlite")
    assert "world.sqlite" in fails("not_found", terrane.open, file)
    with terrane.open(file, create=True, seed=9, generator="flat") as world:
        assert (world.seed, world.generator, world.location) == (9, "flat", file)
        world.set_blocks(0, 0, 81, np.full((4, 50, 50), world.block_id("sand")))
        world.flush()
    with terrane.open(file) as world:
        assert world.seed == 9
        assert (world.blocks((0, 0, 81, 50, 50, 85)) == world.block_id("sand")).all()
        digest = world.digest((0, 0, 4, 4))
        assert (world.heights((0, 0, 32, 32), 2) == 84).all()
        # A second writer.
        fails("busy", terrane.open, file)
    assert digest == program("generate", "--area", "0,0,4,4", "--world", file, "--digest")
    assert program("check", file).strip().endswith("good")
    fails("incompatible", terrane.open, file, seed=10)
    fails("incompatible", terrane.open, file, generator="overworld")


def test_a_world_that_cannot_be_saved_stays_open(tmp_path):
    file, away = tmp_path / "world.sqlite", tmp_path / "away.sqlite"
    world = terrane.open(str(file), create=True, generator="flat")
    world.blocks((0, 0, 90, 1, 1, 91))  # opens the reader of chunks
    file.rename(away)
    world.set_blocks(0, 0, 90, "sand")
    with pytest.raises(terrane.Error):
        world.close()
    assert not world.closed
    away.rename(file)
    world.close()
    assert world.closed
    with terrane.open(str(file)) as again:
        assert again.blocks((0, 0, 90, 1, 1, 91))[0, 0, 0] == again.block_id("sand")


def test_read_only_leaves_the_save_as_it_is(tmp_path):
    file = str(tmp_path / "world.sqlite")
    with terrane.open(file, create=True, generator="flat") as world:
        world.set_blocks(3, 3, 90, "stone")
        world.flush()
        with terrane.open(file, read_only=True) as reader:
            assert reader.blocks((3, 3, 90, 4, 4, 91)).all()
            assert reader.set_blocks(3, 3, 90, "air") == 1
            assert not reader.blocks((3, 3, 90, 4, 4, 91)).any()
    with terrane.open(file, read_only=True) as world:
        assert world.blocks((3, 3, 90, 4, 4, 91)).all()


def test_files_that_are_no_worlds(tmp_path):
    for content in (b"", b"hello" * 1000, b"SQLite format 3\0" + bytes(4096)):
        file = tmp_path / "odd.sqlite"
        file.write_bytes(content)
        with pytest.raises(terrane.Error) as caught:
            terrane.open(str(file))
        assert "odd.sqlite" in str(caught.value)
        assert file.read_bytes() == content
    fails("not_found", terrane.open, str(tmp_path / "none" / "a.sqlite"))
    fails("bad_input", terrane.open, "")
