"""The thesis's tables about frames: shading, shadows, layers, effects."""

from .cells import SCENES, frame, generating
from .table import CHUNKS_IN_VIEW, FRAME_MS, FRAMES_PER_SECOND, Curve, CurvePlot, Plot, Table, Value, share, value

# Tables 6.6 and 6.7, work groups of 8², about the best size: frames per second.
POST_PROCESSING = {"ocean": 56, "desert": 55, "landscape": 45, "cave": 66}
# Table 6.8, light textures of 4² chunks: MB, frames per second.
LIGHT_TEXTURE = {"ocean": (1967, 56), "desert": (1965, 54), "landscape": (1967, 45), "cave": (1967, 65)}


def with_thesis(names):
    """Columns of Terrane, each followed by the column of the thesis."""
    return [column for name in names for column in (str(name), f"thesis: {name}")]


def post_processing(s):
    rows = []
    for scene in SCENES:
        cell = frame(s, scene, ssao="on")
        passes = ("ambient occlusion", "god rays", "depth of field", "final")
        rows.append([scene, value(cell, FRAMES_PER_SECOND),
                     *(value(cell, Value(f"/passes/{name}")) for name in passes), POST_PROCESSING[scene]])
    return Table(
        "post-processing", "Post-processing (tables 6.6 and 6.7)",
        "The thesis computes effects in compute shaders and varies their work groups (2² to 32²; about the same from "
        "8² on). Terrane uses fragment shaders without work groups. The columns are GPU milliseconds of each pass, "
        "with ambient occlusion on.",
        "view distance, size",
        ["scene", "frames/s", "ambient occlusion, ms", "god rays, ms", "depth of field, ms", "final, ms",
         "thesis: frames/s, 8²"], rows)


def light_texture(s):
    rows = []
    for scene in SCENES:
        cell = frame(s, scene)
        rows.append([scene, value(cell, Value("/bytes/light_gpu", 1e-6)),
                     value(cell, Value("/bytes/light_gpu", 1e-3, per=CHUNKS_IN_VIEW)), value(cell, FRAMES_PER_SECOND),
                     *LIGHT_TEXTURE[scene]])
    return Table(
        "light-texture", "Light on the GPU (table 6.8)",
        "The thesis varies the size of its light textures (2² to 32² chunks: 1931 to 2665 MB). Terrane has a pool of "
        "light tiles of 8³ blocks that stores equal tiles once; it has no size to vary.",
        "view distance, size",
        ["scene", "light on the GPU, MB", "kB per chunk", "frames/s", "thesis: all on the GPU, MB, 4²",
         "thesis: frames/s, 4²"], rows)


DISTANCES = (4, 8, 16, 32)


def distances(s):
    """Indices of the measured ones."""
    return [k for k, distance in enumerate(DISTANCES) if distance <= max(4, s.farthest)]


# Table 6.10: frames per second by view distance.
SHADING = {
    "ocean": {"off": (82, 77, 71, 57), "pixel": (77, 71, 65, 52), "sample": (60, 53, 49, 41)},
    "desert": {"off": (88, 83, 73, 51), "pixel": (82, 77, 68, 52), "sample": (66, 60, 55, 44)},
    "landscape": {"off": (81, 73, 55, 42), "pixel": (79, 68, 52, 40), "sample": (69, 57, 43, 34)},
    "cave": {"off": (72, 68, 68, 62), "pixel": (60, 59, 58, 55), "sample": (45, 44, 44, 42)},
}


def shading(s):
    rows = []
    for scene in SCENES:
        for mode, thesis in SHADING[scene].items():
            row = [scene, mode]
            for k in distances(s):
                cell = frame(s, scene, samples=4, shading=mode, view_distance=DISTANCES[k])
                row += [value(cell, FRAMES_PER_SECOND), thesis[k]]
            rows.append(row)
    ours = [2 + 2 * k for k in range(len(distances(s)))]
    return Table(
        "shading", "Shading and view distance (table 6.10)",
        "Frames per second with 4 samples per pixel: without shading, shading per pixel, shading per sample.",
        "view distances", ["scene", "shading", *with_thesis(f"V={DISTANCES[k]}" for k in distances(s))], rows,
        [Plot("scene, shading", "frames/s", ours, name_columns=2)])


# Table 6.11, in thousands, by view distance; steps of 40 of a day.
SHADOW_TRIANGLES = {"noon": (20, (39, 50, 50, 50)), "dawn": (8, (35, 70, 221, 262))}


def shadow_triangles(s):
    over_the_day = "/shadow_triangles_over_the_day"
    cells = {k: generating("landscape", DISTANCES[k]) for k in distances(s)}
    rows = []
    for time, (step, thesis) in SHADOW_TRIANGLES.items():
        rows.append([time])
        for k, cell in cells.items():
            rows[-1] += [value(cell, Value(f"{over_the_day}/triangles/{step}", 1e-3)), thesis[k]]
    curves = [Curve(cell, over_the_day + "/time", over_the_day + "/triangles", f"V={DISTANCES[k]}")
              for k, cell in cells.items()]
    return Table(
        "shadow-triangles", "Triangles of the shadow map (table 6.11, graph 6.6)",
        "Landscape, in thousands: triangles drawn into the shadow map at noon (time 0.5) and at dawn (0.2), and over "
        "the day. Only possible casters of shadows on the nearest 50 blocks are drawn, without faces that point away "
        "from the light.",
        "view distances", ["time", *with_thesis(f"V={DISTANCES[k]}" for k in cells)], rows,
        curve_plot=CurvePlot("time of day (0: midnight, 0.5: noon)", "triangles of the shadow map", curves))


# Table 6.12: frames per second without a shadow map and by its size, by samples.
SHADOW_SIZES = ("off", "1024", "2048", "4096")
SHADOW_MAPS = {1: (54, 49, 39, 24), 2: (47, 41, 35, 22), 4: (35, 32, 28, 20), 8: (23, 21, 19, 15)}


def shadow_maps(s):
    sizes = SHADOW_SIZES[:2] if s.is_quick else SHADOW_SIZES
    rows = []
    for samples, thesis in SHADOW_MAPS.items():
        if s.is_quick and samples in (2, 8):
            continue
        rows.append([samples])
        for size, figure in zip(sizes, thesis):
            changed = {"shadows": "off"} if size == "off" else {"shadow_size": size}
            cell = frame(s, "landscape", samples=samples, time="0.2", **changed)
            ours = "not offered" if samples > s.most_samples else value(cell, FRAMES_PER_SECOND)
            rows[-1] += [ours, figure]
    return Table(
        "shadow-maps", "Shadow map size and samples per pixel (table 6.12)",
        "Landscape at dawn (0.2), frames per second. A driver may use more samples than requested: Mesa's software "
        "renderer uses 4 for 2.",
        "shadow maps of 2048² and 4096²; 2 and 8 samples",
        ["samples", *with_thesis(size if size == "off" else size + "²" for size in sizes)], rows)


# Table 6.13: frames per second with 0 to 3 layers.
LAYERS = {"ocean": (81, 64, 61, 57), "desert": (68, 61, 59, 56), "landscape": (54, 50, 47, 45),
          "cave": (100, 86, 80, 75)}


def layers(s):
    counts = (0, 3) if s.is_quick else (0, 1, 2, 3)
    rows = []
    for scene in SCENES:
        rows.append([scene])
        for count in counts:
            rows[-1] += [value(frame(s, scene, layers=count), FRAMES_PER_SECOND), LAYERS[scene][count]]
        three = frame(s, scene, layers=3)
        none, thesis = frame(s, scene, layers=0), LAYERS[scene]
        rows[-1] += [value(three, Value("/triangles/transparent", 1e-3)), share(three, none, FRAME_MS),
                     round(100 * thesis[0] / thesis[3])]
    return Table(
        "layers", "Transparency layers (table 6.13)",
        "Frames per second by number of layers. The last columns are the blended triangles in view, and the frame time "
        "with three layers relative to the frame time without layers.",
        "view distance, size; 1 and 2 layers",
        ["scene", *with_thesis(counts), "blended, k", "3 layers, %", "thesis: 3 layers, %"], rows)


# Table 6.14: frames per second of the four scenes; the thesis reports no change for the last four.
EFFECTS = (
    ("default", {}, (57, 56, 41, 59)),
    ("without depth of field", {"depth_of_field": "off"}, (66, 65, 46, 71)),
    ("without god rays", {"god_rays": "off"}, (59, 56, 42, 59)),
    ("without sharp filtering", {"sharp_filtering": "off"}, 4 * ("no change",)),
    ("without MSAA alpha test", {"msaa_alpha_test": "off"}, 4 * ("no change",)),
    ("T-junctions open", {"t_junctions": "open"}, 4 * ("no change",)),
    ("without animation", {"animation": "off"}, 4 * ("no change",)),
)


def effects(s):
    step = 2 if s.is_quick else 1
    rows = []
    for name, flags, thesis in EFFECTS:
        rows.append([name])
        for scene, figure in list(zip(SCENES, thesis))[::step]:
            rows[-1] += [value(frame(s, scene, **flags), FRAMES_PER_SECOND), figure]
    return Table(
        "effects", "Effects switched off, one at a time (table 6.14)",
        "Frames per second. The thesis reports no change for the last four.",
        "two of the four scenes", ["options", *with_thesis(SCENES[::step])], rows)


def frame_tables(s):
    return [post_processing(s), light_texture(s), shading(s), shadow_triangles(s), shadow_maps(s), layers(s),
            effects(s)]
