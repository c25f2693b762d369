"""Images, in builds with graphics."""
import math
import subprocess
import sys
import textwrap
import threading

import numpy as np
import pytest
import terrane

from conftest import HANG_SECONDS, fails

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


SMALL = {"size": (96, 64), "view_distance": 2, "preset": "low"}
EDGE = 2.0**31


@needs_graphics
@pytest.mark.parametrize("x,y,yaw", [(0.5 - EDGE, 0.5 - EDGE, 45), (EDGE - 0.5, EDGE - 0.5, 225),
                                     (-EDGE, math.nextafter(EDGE, 0), 315), (math.nextafter(EDGE, 0), -EDGE, 135)])
def test_an_image_from_the_last_column(x, y, yaw):
    with terrane.World(generator="flat", threads=2) as world:
        inward = world.render((x, y, 100), yaw, -30, **SMALL)
        ground = inward[-8:].mean((0, 1))
        assert ground[1] > ground[0] and ground[1] > ground[2]
        assert difference(inward, world.render((x, y, 100), yaw + 180, -30, **SMALL))[0] > 10, "nothing lies beyond"


@needs_graphics
def test_nothing_is_drawn_from_beyond_the_world():
    with terrane.World(generator="flat", threads=2) as world:
        for beyond in (EDGE, math.nextafter(-EDGE, -math.inf), 1e300):
            for position in ((beyond, 0, 100), (0, beyond, 100)):
                text = fails("bad_input", world.render, position, **SMALL)
                assert text.startswith("position: expected a number from -2147483648 to less than 2147483648"), text


HIGH = {"size": (120, 80), "view_distance": 3, "preset": "high"}


def difference(image, other):
    """The mean and the largest difference of two images."""
    between = np.abs(image.astype(int) - other)
    return between.mean(), between.max()


def drawn_alone(position, angles=(0, 0), edits=(), **options):
    """An image of a world that has drawn no other."""
    with terrane.World(seed=1, generator="continents", threads=2) as world:
        for edit in edits:
            world.set_blocks(*edit)
        return world.render(position, *angles, **options)


@needs_graphics
def test_images_are_those_of_a_world_that_has_drawn_no_other():
    spots = [((8, 8, 130), (20, -20), HIGH), ((60, 20, 120), (200, -30), HIGH | {"view_distance": 4, "time": 0.8}),
             ((60, 20, 120), (200, -30), SMALL), ((60, 20, 120), (200, -30), HIGH | {"horizon": 16}),
             ((9000, 20, 140), (0, -30), HIGH | {"size": (33, 77), "field_of_view": 100}), ((8, 8, 130), (20, -20), HIGH)]
    with terrane.World(seed=1, generator="continents", threads=2) as world:
        images = [world.render(position, *angles, **options) for position, angles, options in spots]
    assert (images[0] == images[-1]).all()
    for image, (position, angles, options) in zip(images[1:-1], spots[1:-1]):
        assert difference(image, drawn_alone(position, angles, **options)) == (0, 0), (position, angles, options)


@needs_graphics
@pytest.mark.parametrize("horizon,compared", [(0, (2, 5)), (16, (5,))])
def test_edits_between_images_show(horizon, compared):
    position, angles, options = (8, 8, 150), (45, -60), HIGH | {"horizon": horizon}
    edits = [(20, 20, 120, "lamp_white"), (12, 12, 100, np.zeros((60, 20, 20), int)), (5, 30, 130, np.full((2, 4, 40), 1)),
             (6, 31, 131, "water"), (300, 300, 0, np.ones((200, 30, 30), int)), (6, 31, 131, "air")]
    with terrane.World(seed=1, generator="continents", threads=2) as world:
        before = world.render(position, *angles, **options)
        for number, edit in enumerate(edits):
            assert world.set_blocks(*edit) > 0
            image = world.render(position, *angles, **options)
            if number in compared:
                assert difference(image, drawn_alone(position, angles, edits[:number + 1], **options)) == (0, 0), edit
                assert difference(image, before)[0] > 1
        moved = world.render((40, 40, 170), 225, -60, **options)
        assert difference(moved, drawn_alone((40, 40, 170), (225, -60), edits, **options)) == (0, 0)


@needs_graphics
def test_states_show():
    with terrane.World(generator="flat", threads=2) as world:
        door = next(k for k, name in enumerate(world.block_names) if "stairs" in name)
        world.set_blocks(4, 0, 82, door, 0)
        images = []
        for state in range(4):
            world.set_blocks(4, 0, 82, door, state)
            images.append(world.render((1.5, 0.5, 83.5), 0, -15, **SMALL))
        assert any(difference(image, images[0])[0] > 0.5 for image in images[1:])


@needs_graphics
def test_edits_of_another_program_show(tmp_path):
    file = str(tmp_path / "w.sqlite")
    with terrane.open(file, create=True, generator="flat", threads=2) as writer:
        writer.set_blocks(0, 0, 90, "stone")
        writer.flush()
        with terrane.open(file, read_only=True, threads=2) as reader:
            before = reader.render((0, 0, 100), 0, 0, **SMALL)
            writer.set_blocks(4, -8, 90, np.full((24, 16, 1), writer.block_id("sand")))
            writer.flush()
            assert difference(reader.render((0, 0, 100), 0, 0, **SMALL), before)[0] > 20


@needs_graphics
def test_an_error_is_not_the_end():
    with terrane.World(generator="flat", threads=2) as world:
        image = world.render((0, 0, 100), **SMALL)
        fails("bad_input", world.render, (0, 0, 100), preset="pretty")
        assert (world.render((0, 0, 100), **SMALL) == image).all()
    assert fails("failed", world.render, (0, 0, 100)) == "the world is closed"


@needs_graphics
def test_threads_draw_one_after_the_other():
    with terrane.World(generator="continents", threads=2) as world:
        spots = [(16 * k, 0, 130 + k) for k in range(4)]
        alone = [world.render(spot, 30 * k, -20, **SMALL) for k, spot in enumerate(spots)]
        images = {}

        def draw(k):
            for _ in range(3):
                images[k] = world.render(spots[k], 30 * k, -20, **SMALL)
                world.set_blocks(1000 + k, 0, 200, 1)

        threads = [threading.Thread(target=draw, args=(k,)) for k in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert all((images[k] == alone[k]).all() for k in range(4))


@needs_graphics
def test_a_world_can_be_closed_while_it_draws():
    for _ in range(3):
        world = terrane.World(generator="continents", threads=2)
        thread = threading.Thread(target=lambda: world.render((0, 0, 130), **SMALL))
        thread.start()
        world.close()
        thread.join()
        assert world.closed


def ends(script):
    """Runs Python code in a process of its own, which must end well by itself, and returns its output."""
    done = subprocess.run([sys.executable, "-c", "import os, sys, threading, terrane\n"
                           "options = {'size': (64, 48), 'view_distance': 2, 'preset': 'low'}\n" + textwrap.dedent(script)],
                          capture_output=True, text=True, timeout=HANG_SECONDS, check=False)
    assert done.returncode == 0 and not done.stderr, done.stderr
    return done.stdout


@needs_graphics
@pytest.mark.parametrize("script", [
    "world = terrane.World(generator='flat'); world.render((0, 0, 100), **options)",
    "world = terrane.World(generator='flat'); world.render((0, 0, 100), **options); world.close()",
    "world = terrane.World(generator='flat'); world.render((0, 0, 100), **options); ring = [world]; ring.append(ring)",
    "world = terrane.World(generator='flat'); world.render((0, 0, 100), **options); sys.leaked = world",
    "worlds = [terrane.World(k, 'flat') for k in range(3)]; [world.render((0, 0, 100), **options) for world in worlds]",
], ids=["open", "closed", "ring", "leaked", "several"])
def test_the_interpreter_ends_after_images(script):
    assert ends(script + "; print('drawn')") == "drawn\n"


@needs_graphics
def test_the_interpreter_ends_while_a_thread_draws():
    assert ends("""
        world = terrane.World(generator='continents')
        begun = threading.Event()

        def draw():
            try:
                while True:
                    world.render((0, 0, 100), **options)
                    begun.set()
            except terrane.Error:
                pass

        threading.Thread(target=draw, daemon=True).start()
        begun.wait()
        print('drawn')
        """) == "drawn\n"


@needs_graphics
def test_a_fork_ends_and_is_told():
    assert ends("""
        world = terrane.World(generator='flat')
        world.render((0, 0, 100), **options)
        child = os.fork()
        if child == 0:
            for drawn in (world, terrane.World(generator='flat')):
                try:
                    drawn.render((0, 0, 100), **options)
                except terrane.Error as error:
                    print(error.code, flush=True)
            del world, drawn
            sys.exit(3)  # with all that the interpreter does at its end
        assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 3
        world.render((0, 0, 100), **options)
        print('drawn')
        """) == "unsupported\nunsupported\ndrawn\n"


@needs_graphics
def test_a_fork_draws_if_its_parent_has_not():
    assert ends("""
        parent = terrane.World(generator='flat')
        child = os.fork()
        if child == 0:
            terrane.World(generator='flat').render((0, 0, 100), **options)
            sys.exit(3)
        assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 3
        parent.render((0, 0, 100), **options)
        """) == ""


@needs_graphics
def test_wrong_values_are_refused(flat):
    fails("bad_input", flat.render, (2.0**40, 0, 100))
    fails("bad_input", flat.render, (0, float("nan"), 100))
    with pytest.raises(TypeError):
        flat.render((0, 0, 100), colour=1)


@needs_graphics
def test_a_new_player_sees_the_world(land):
    (x, y, z), yaw, pitch = land.spawn
    top = land.heights((int(x // 1), int(y // 1), int(x // 1) + 1, int(y // 1) + 1))[0, 0]
    assert 1 < z - top < 4 and -90 <= pitch <= 90 and 0 <= yaw < 360
    assert land.render(*land.spawn, **SMALL).std() > 5
