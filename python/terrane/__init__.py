"""Terrane's worlds as NumPy arrays: generated land, blocks, heights, light, edits, images.

    import terrane

    world = terrane.World(seed=1)
    heights = world.heights((0, 0, 512, 512))  # int16 [y, x]
    blocks = world.blocks((0, 0, 64, 64))      # uint16 [z, y, x]

docs/python.md of Terrane has the reference.
"""

from ._terrane import Error, World, __version__, generators, has_graphics, open

__all__ = ["Error", "World", "generators", "has_graphics", "open"]
