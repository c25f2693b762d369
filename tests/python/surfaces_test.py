"""Heights and surfaces."""
import numpy as np
import pytest
import terrane

from conftest import fails


def test_heights_are_those_of_the_blocks(land):
    area = (-25, 30, 60, 95)
    blocks, names = land.blocks(area), land.block_names
    heights, surface = land.heights(area), land.surface(area)
    assert heights.shape == surface.shape == (65, 85)
    assert heights.dtype == np.int16 and surface.dtype == np.uint16
    rows, columns = np.indices(heights.shape)
    assert (blocks[heights, rows, columns] == surface).all()
    # Above are air and plants without collision.
    above = {names[k] for k in np.unique(blocks[np.arange(256)[:, None, None] > heights])}
    assert "air" in above and "grass_tuft" in above
    assert not above & {"stone", "dirt", "grass", "sand", "water", "oak_leaves", "oak_log", "snow"}


def test_the_ground_lies_under_water_and_trees():
    sea = terrane.World(seed=1, generator="overworld")
    area = (-512, -512, 512, 512)
    top, ground = sea.heights(area, 4), sea.heights(area, 4, ground=True)
    assert (ground <= top).all() and (ground < top).any()
    water = sea.surface(area, 4) == sea.block_id("water")
    assert water.any() and (ground < top)[water].all()
    assert not (sea.surface(area, 4, ground=True)[water] == sea.block_id("water")).any()


@pytest.mark.parametrize("step", [1, 2, 16, 1024])
def test_steps_are_levels_of_detail(land, step):
    level = step.bit_length() - 1
    heights = land.heights((-20 * step, 0, 13 * step, 16 * step), step)
    assert heights.shape == (16, 33)
    chunk = land.chunk(-1, 0, level)
    surface = land.surface((-16 * step, 0, 0, 16 * step), step)
    rows, columns = np.indices((16, 16))
    assert (chunk[heights[:, 4:20], rows, columns] == surface).all()


def test_areas_are_widened_to_steps(land):
    assert (land.heights((3, 3, 9, 9), 8) == land.heights((0, 0, 16, 16), 8)).all()


def test_wrong_steps_and_areas(land):
    for step in (0, -1, 3, 65536):
        assert "step" in fails("bad_input", land.heights, (0, 0, 1, 1), step)
    for area in ((0, 0, 1), (0, 0, 0, 1), (0, 0, 2**31 + 1, 1), (-2**31, -2**31, 2**31, 2**31), (0, 0, 0, 1, 1, 1)):
        assert "area" in fails("bad_input", land.heights, area)


@pytest.mark.parametrize("step", [1, 8, 512])
def test_biomes_are_named_numbers(step):
    with terrane.World(seed=1) as world:
        area = (-70 * step, 30 * step, 130 * step, 160 * step)
        biomes, names = world.biomes(area, step), world.biome_names
        assert biomes.shape == (130, 200) and biomes.dtype == np.uint8 and biomes.flags.c_contiguous
        assert biomes.max() < len(names) == len(set(names)) and "ocean" in " ".join(names)
        assert (world.biomes((0, 40 * step, 20 * step, 50 * step), step) == biomes[10:20, 70:90]).all()
    with terrane.World(seed=1, threads=1) as world:
        wide = world.biomes((-2**15, -2**15, 2**15, 2**15), 64)
        assert len(np.unique(wide)) > 8
        # Water is where a biome of water is, and seldom elsewhere.
        wet = np.array(["ocean" in name for name in names])[wide]
        water = world.surface((-2**15, -2**15, 2**15, 2**15), 64) == world.block_id("water")
        assert water[wet].mean() > 0.8 and water[~wet].mean() < 0.2


def test_generators_without_biomes_say_so(land):
    assert land.biome_names == []
    assert "overworld has no biomes" in fails("unsupported", land.biomes, (0, 0, 1, 1))


def test_edits_change_heights():
    with terrane.World(generator="flat") as world:
        area = (0, 0, 64, 64)
        assert (world.heights(area) == 80).all()
        world.set_blocks(0, 0, 81, np.full((20, 64, 64), world.block_id("sand")))
        assert (world.heights(area) == 100).all()
        assert (world.heights(area, 4) == 100).all()
        world.set_blocks(5, 6, 0, np.zeros((256, 1, 1), int))
        assert world.heights(area)[6, 5] == -1 and world.surface(area)[6, 5] == 0
