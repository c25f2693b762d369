#!/usr/bin/python3
"""tools/views.py on land of a few hills. Usage: views_test.py SCRIPT. Ends with 77 where Python has no NumPy."""
import importlib.util
import math
import sys
import types
import unittest

SCRIPT = sys.argv.pop(1)

try:
    import numpy as np
except ModuleNotFoundError as missing:
    print(f"skipped: {missing}; needs python3-numpy")
    sys.exit(77)

spec = importlib.util.spec_from_file_location("views", SCRIPT)
views = importlib.util.module_from_spec(spec)
sys.modules["views"] = views
spec.loader.exec_module(views)


def land_of(heights, step=16, is_water=None):
    """A square of land around 0, 0 without blocks and biomes."""
    land = types.SimpleNamespace(
        x0=-heights.shape[1] * step // 2, y0=-heights.shape[0] * step // 2, step=step, cells=heights.shape[0],
        top=heights.astype(np.float32), is_water=np.zeros(heights.shape, dtype=bool) if is_water is None else is_water)
    land.is_sea = land.is_water & (land.top <= 0)
    for name in ("cells_of", "index", "place"):
        setattr(land, name, types.MethodType(getattr(views.Land, name), land))
    return land


def hill(cells=256, height=400, at=(128, 200), wide=12):
    i, j = np.indices((cells, cells))
    return np.maximum(0, height * (1 - np.hypot(i - at[0], j - at[1]) / wide))


class Views(unittest.TestCase):
    def test_the_sky_begins_where_the_land_ends(self):
        level = land_of(np.zeros((2048, 2048)))
        depth, _, _ = views.cast([level], views.Camera((0, 0, 50), 0, 0))
        self.assertFalse(np.isfinite(depth[: views.ROWS // 2]).any(), "above the horizon")
        self.assertTrue(np.isfinite(depth[views.ROWS // 2 + 1:]).all(), "below it")
        # tan of half a field of view of 70° over 27 rows: the lowest row's middle is 34.5° down.
        lowest = 49 / math.tan(math.atan(math.tan(math.radians(35)) * 53 / 54))
        self.assertAlmostEqual(float(depth[-1, views.COLUMNS // 2]), lowest, delta=0.05 * lowest)

    def test_a_hill_is_seen_ahead_and_hides_what_is_behind(self):
        land = land_of(hill())  # 1,152 blocks along x
        for yaw, is_seen in ((0, True), (180, False)):
            depth, px, py = views.cast([land], views.Camera((0, 0, 30), yaw, 0))
            top = land.top[land.index(px, py)[:2]]
            self.assertEqual(bool((np.isfinite(depth) & (top > 300)).any()), is_seen, yaw)
        lower = np.maximum(hill(), hill(height=250, at=(128, 235)))
        _, px, _ = views.cast([land_of(lower)], views.Camera((0, 0, 30), 0, 0))
        self.assertLess(float(px[views.ROWS // 2, views.COLUMNS // 2]), 1500)

    def test_right_is_toward_lower_yaw(self):
        land = land_of(hill(at=(148, 200)))  # to +y of the x axis, so to the left
        depth, px, py = views.cast([land], views.Camera((0, 0, 30), 0, 0))
        columns = np.flatnonzero((np.isfinite(depth) & (land.top[land.index(px, py)[:2]] > 200)).any(axis=0))
        self.assertLess(columns.max(), views.COLUMNS // 2)

    def test_fine_land_counts_before_coarse(self):
        fine = land_of(np.full((64, 64), 100.0), step=4)
        coarse = land_of(np.zeros((256, 256)))
        self.assertEqual(views.stand([fine, coarse], 10, 10), (100.0, False))
        self.assertEqual(views.stand([fine, coarse], 1000, 10), (0.0, False))
        self.assertIsNone(views.stand([fine, coarse], 10000, 10))

    def test_windows(self):
        values = np.zeros((9, 9))
        values[4, 4] = 7
        for cells in (1, 2, 3):
            highest = views.highest_around(values, cells)
            self.assertEqual(int((highest == 7).sum()), (2 * cells + 1) ** 2)
            self.assertEqual(highest[4 - cells, 4 + cells], 7)
            self.assertAlmostEqual(views.share_around(values > 0, cells)[4, 4], 1 / (2 * cells + 1) ** 2, places=6)

    def test_places_are_apart(self):
        land = land_of(hill())
        places = views.best_places(land.top.copy(), land, 5, 600)
        for k, (x, y) in enumerate(places):
            self.assertTrue(all(max(abs(x - u), abs(y - v)) > 600 for u, v in places[:k]))
        self.assertEqual(places[0], land.place(128, 200))

    def test_scores(self):
        wanted = (0.0, 0.2, 0.4, 0.8)
        shares = [views.share_within(value, wanted) for value in (-1, 0, 0.1, 0.2, 0.4, 0.6, 0.8, 2)]
        self.assertEqual([round(share, 6) for share in shares], [0, 0, 0.5, 1, 1, 0.5, 0, 0])
        self.assertEqual(views.score({"sky": 0.3}, {"sky": wanted}), 1)
        self.assertLess(views.score({"sky": 0.3, "bands": 0}, {"sky": wanted, "bands": (1, 3, 5, 6)}), 0.05)

    def test_images(self):
        rng = np.random.default_rng(1)
        gray = np.full((90, 160, 3), 128, dtype=np.uint8)
        colored = rng.integers(0, 256, gray.shape, dtype=np.uint8)
        for name in ("contrast", "colors", "detail"):
            self.assertGreater(views.image_values(colored)[name], views.image_values(gray)[name] + 0.1, name)
        self.assertAlmostEqual(views.image_values(gray)["light"], 128 / 255, places=3)


if __name__ == "__main__":
    unittest.main()
