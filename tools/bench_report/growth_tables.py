"""Cost by view distance, by image size and of each effect."""

from .cells import frame, generating, loading, pixels, plain_frame
from .table import (CHUNKS_IN_VIEW, FRAME_MS, LOAD_SECONDS, CPU_MS, Plot, Table, Value, difference, total,
                    value)


def by_view_distance(s):
    rows = []
    for distance in (4, 8, 16, 32, 64):
        if distance > max(4, (2 if s.is_quick else 1) * s.farthest):
            continue
        drawn, generated = frame(s, "landscape", view_distance=distance), generating("landscape", distance)
        rows.append([str(distance), value(generated, Value(CHUNKS_IN_VIEW)), value(generated, LOAD_SECONDS),
                     value(loading("landscape", distance), LOAD_SECONDS),
                     total(drawn, [Value("/triangles/opaque", 1e-3), Value("/triangles/transparent", 1e-3)]),
                     value(drawn, FRAME_MS), value(drawn, CPU_MS),
                     value(plain_frame(s, view_distance=distance), FRAME_MS),
                     value(generated, Value("/bytes/process", 1e-6))])
    return Table(
        "view-distance", "Cost by view distance",
        "Landscape. Loading: until all in view is lit, meshed and uploaded, generated or from a save. "
        f"Frames: {s.size}, with the options of the thesis's tables and with `--preset low`. CPU: milliseconds of all "
        "cores for a frame with the options of the thesis's tables.",
        f"view distances over {2 * s.farthest}",
        ["V", "chunks in view", "generating, s", "from a save, s", "triangles, k", "frame, ms", "CPU, ms",
         "preset low: frame, ms", "process, MB"],
        rows, [Plot("view distance, chunks", "milliseconds per frame", [5, 7], "frame", is_lines=True),
               Plot("view distance, chunks", "seconds to load all", [2, 3], "load", is_lines=True)])


SIZES = ("320x180", "640x360", "960x540", "1280x720", "1920x1080")
QUICK_SIZES = ("160x90", "320x180", "640x360")


def by_resolution(s):
    rows = []
    for size in QUICK_SIZES if s.is_quick else SIZES:
        drawn, plain = frame(s, "landscape", size=size), plain_frame(s, size=size)
        per_pixel = Value(FRAME_MS.pointer, 1e6 / pixels(size))
        rows.append([str(pixels(size)), size, value(drawn, FRAME_MS), value(drawn, CPU_MS),
                     value(drawn, per_pixel), value(plain, FRAME_MS), value(plain, per_pixel)])
    return Table(
        "resolution", "Cost by image size",
        f"Landscape, V={s.view_distance}, with the options of the thesis's tables and with `--preset low`.",
        "large images",
        ["pixels", "size", "frame, ms", "CPU, ms", "ns per pixel", "preset low: frame, ms",
         "preset low: ns per pixel"],
        rows, [Plot("pixels", "milliseconds per frame", [2, 5], is_lines=True)])


# Each effect's flag, its values on and off, and which of the two `--preset low` has. That one needs no flag, so one run
# serves all effects.
EFFECTS = (
    ("4 samples per pixel", "samples", "4", "1", "off"),
    ("shading", "shading", "sample", "off", "on"),
    ("smooth light", "light", "smooth", "classic", "off"),
    ("shadows, 50 blocks", "shadows", "near", "off", "off"),
    ("ambient occlusion", "ssao", "on", "off", "off"),
    ("depth of field", "depth_of_field", "on", "off", "off"),
    ("distance fog", "distance_fog", "on", "off", "on"),
    ("god rays", "god_rays", "on", "off", "off"),
    ("clouds", "clouds", "on", "off", "off"),
    ("animation", "animation", "on", "off", "on"),
    ("sharp filtering", "sharp_filtering", "on", "off", "off"),
    ("3 transparency layers", "layers", "3", "0", "neither"),
    ("T-junctions covered", "t_junctions", "covered", "open", "on"),
    ("occlusion culling", "occlusion_culling", "on", "off", "on"),
)


def effect_costs(s):
    rows = []
    for name, flag, word_on, word_off, in_preset in EFFECTS:
        off = plain_frame(s, **({} if in_preset == "off" else {flag: word_off}))
        on = plain_frame(s, **({} if in_preset == "on" else {flag: word_on}))
        rows.append([name, value(off, FRAME_MS), value(on, FRAME_MS), difference(on, off, FRAME_MS),
                     difference(on, off, CPU_MS)])
    return Table(
        "effect-costs", "Cost of each effect",
        f"Landscape, {s.size}, V={s.view_distance}: milliseconds of a frame with `--preset low` with the effect off "
        "and on, all other options unchanged. Differences below about a fifth of the frame are noise; CPU time of all "
        "cores is more stable when other programs run.",
        "view distance, size", ["effect", "off, ms", "on, ms", "difference, ms", "difference, CPU ms"], rows,
        [Plot("effect", "added milliseconds", [3, 4])])


def growth_tables(s):
    return [by_view_distance(s), by_resolution(s), effect_costs(s)]
