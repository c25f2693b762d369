"""Images, in builds with graphics."""
import numpy as np
import pytest
import terrane

from conftest import fails

needs_graphics = pytest.mark.skipif(not terrane.has_graphics, reason="built without graphics")


@pytest.mark.skipif(terrane.has_graphics, reason="built with graphics")
def test_without_graphics_it_says_so(flat):
    assert fails("unsupported", flat.render, (0, 0, 100)) == "render: this build has no graphics"


@needs_graphics
def test_an_image_shows_ground_sky_and_edits():
    with terrane.World(generator="flat", threads=2) as world:
        options = {"size": (96, 64), "view_distance": 2, "preset": "low"}
        image = world.render((0, 0, 100), 0, 0, **options)
        assert image.shape == (64, 96, 3) and image.dtype == np.uint8
        sky = image[:8].mean((0, 1))
        assert sky[2] > sky[1] > sky[0] > 0
        ground = world.render((0, 0, 85), 0, -90, **options).mean((0, 1))
        assert ground[1] > ground[0] and ground[1] > ground[2]
        world.set_blocks(4, -8, 90, np.full((24, 16, 1), world.block_id("sand")))
        wall = world.render((0, 0, 100), 0, 0, **options)
        assert abs(wall.astype(int) - image).mean() > 20
        night = world.render((0, 0, 100), time=0.0, **options)
        assert night.mean() < image.mean() / 2


@needs_graphics
def test_wrong_options_are_refused(flat):
    for options in ({"size": (0, 1)}, {"size": (1, 8193)}, {"size": (1,)}, {"time": 2}, {"view_distance": 0},
                    {"horizon": -1}, {"preset": "pretty"}, {"field_of_view": 0}, {"pitch": 91}, {"yaw": float("nan")}):
        fails("bad_input", flat.render, (0, 0, 100), **options)
    fails("bad_input", flat.render, (2.0**40, 0, 100))
    fails("bad_input", flat.render, (0, float("nan"), 100))
    with pytest.raises(TypeError):
        flat.render((0, 0, 100), colour=1)
