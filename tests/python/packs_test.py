"""Worlds of content packs."""
import pytest

import terrane

SCRIPT = """
g:pass3D("ground", function(p)
    p:setBlock(select(p.z:le(70), "glow", "air"))
end)
"""
BLOCKS = """
[[block]]
name = "glow"
shape = "cube"
texture = "stone"
"""


@pytest.fixture
def pack(tmp_path):
    folder = tmp_path / "isles"
    (folder / "generators").mkdir(parents=True)
    (folder / "pack.toml").write_text('format = 1\nname = "isles"\n')
    (folder / "blocks.toml").write_text(BLOCKS)
    (folder / "generators" / "plain.lua").write_text(SCRIPT)
    return str(folder)


def test_a_generator_of_a_pack(pack):
    assert "isles:plain" in terrane.generators([pack])
    assert "isles:plain" not in terrane.generators()
    with terrane.World(1, "isles:plain", content=[pack]) as world:
        column = world.blocks((3, 4, 69, 4, 5, 72))[:, 0, 0]
        assert [world.block_names[k] for k in column] == ["isles:glow", "isles:glow", "air"]


def test_a_saved_world_with_a_pack(pack, tmp_path):
    file = str(tmp_path / "w.sqlite")
    with terrane.open(file, create=True, generator="isles:plain", content=[pack]) as world:
        world.set_blocks(0, 0, 90, "isles:glow")
    with terrane.open(file, content=[pack]) as world:
        assert world.blocks((0, 0, 90, 1, 1, 91))[0, 0, 0] == world.block_id("isles:glow")
    with pytest.raises(terrane.Error) as raised:
        terrane.open(file)
    assert raised.value.code == "incompatible"


def test_mistakes_of_packs(pack, tmp_path):
    with pytest.raises(terrane.Error) as raised:
        terrane.World(content=[str(tmp_path / "none")])
    assert raised.value.code == "not_found"
