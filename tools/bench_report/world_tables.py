"""The thesis's tables about mesh sections, memory, merging and flights."""

from .cells import SCENES, flight, frame, generating, merging, view_distances
from .table import (CHUNKS_IN_VIEW, FRAMES_PER_SECOND, LOAD_SECONDS, Curve, CurvePlot, Plot, Table, Value, intercept,
                    share, slope, total, value)

# Table 6.5: frames per second, triangles, seconds to load by view distance and height.
MESH_SECTIONS = {
    8: {8: (79, 139594, 11), 16: (79, 147518, 8), 32: (79, 165684, 4), 64: (79, 194812, 3), 128: (79, 272270, 2.5)},
    16: {8: (59, 739286, 43), 16: (60, 747504, 28), 32: (55, 767902, 18), 64: (61, 808836, 10),
         128: (59, 914982, 8)},
    32: {8: (40, 1734210, 172), 16: (44, 1743498, 87), 32: (41, 1768282, 60), 64: (41, 1811754, 41),
         128: (44, 1928928, 31)},
    56: {8: (26, 4163242, 893), 64: (28, 4261558, 125), 128: (29, 4407838, 115)},
}


def mesh_section_heights(s):
    rows = []
    for distance, heights in MESH_SECTIONS.items():
        if distance > max(8, s.farthest):
            continue
        for height, thesis in heights.items():
            cell = frame(s, "landscape", view_distance=distance, mesh_section_height=height,
                         world=f"landscape-{distance}")
            rows.append([str(distance), str(height), value(cell, FRAMES_PER_SECOND),
                         total(cell, [Value("/triangles/opaque"), Value("/triangles/transparent")]),
                         value(cell, LOAD_SECONDS), *thesis])
    names = "view distance, mesh section height"
    return Table(
        "region-height", "Mesh section height (table 6.5, graphs 6.1 and 6.2)",
        "Chunks are culled and drawn in mesh sections of this height. Landscape. Loading is from a complete save in "
        "the file system's cache, until all in view is lit, meshed and uploaded. Triangles are those in view, without "
        "those hidden behind terrain.",
        "fewer view distances",
        ["V", "height", "frames/s", "triangles", "load, s", "thesis: frames/s", "thesis: triangles",
         "thesis: load, s"],
        rows, [Plot(names, "triangles", [3, 6], "triangles", 2), Plot(names, "seconds to load", [4, 7], "load", 2)])


def memory_by_chunks(s):
    cells = [generating("landscape", distance) for distance in view_distances(s)]
    rows = []
    for name, owners, *thesis in (
            ("RAM: the whole process", ["process"], "312.9", "24"),
            ("RAM: blocks and light of the world", ["blocks", "light"], "–", "–"),
            ("GPU: quads and light of the world", ["quads_gpu", "light_gpu"], "258.6", "853")):
        kilobytes, megabytes = ([Value(f"/bytes/{owner}", factor) for owner in owners] for factor in (1e-3, 1e-6))
        rows.append([name, slope(cells, Value(CHUNKS_IN_VIEW), kilobytes),
                     intercept(cells, Value(CHUNKS_IN_VIEW), megabytes), *thesis])
    return Table(
        "memory", "Memory by number of chunks (graph 6.3)",
        "Linear fits over all view distances of the landscape: a part per visible chunk and a constant part. Without a "
        "graphics card, the memory of the process includes the GPU memory of the driver, its frames and its shaders.",
        "smaller view distances",
        ["memory", "kB per chunk", "MB constant", "thesis: kB per chunk", "thesis: MB constant"], rows)


# Table 6.9: shares of opaque, transparent and shadow triangles in percent, and frames per second, by method.
METHODS = ("none", "lines", "squares", "squares-ext", "greedy")
MERGING = {
    "ocean": (("100", 35), ("40/13/44", 54), ("34/2/40", 56), ("30/2/36", 56), ("–", "–")),
    "desert": (("100", 44), ("56/–/50", 53), ("56/–/50", 53), ("48/–/42", 56), ("–", "–")),
    "landscape": (("100", 29), ("46/16/52", 42), ("41/3/50", 44), ("36/3/43", 46), ("–", "–")),
    "cave": (("100", 60), ("57/–/55", 60), ("57/–/54", 60), ("50/–/48", 60), ("–", "–")),
}


def merging_methods(s):
    rows = []
    for scene in SCENES:
        for method, thesis in zip(METHODS, MERGING[scene]):
            one, none = merging(s, scene, method), merging(s, scene, "none")
            kinds = [f"/triangles/{kind}" for kind in ("opaque", "transparent", "shadow")]
            rows.append([scene, method, *(value(one, Value(kind, 1e-3)) for kind in kinds),
                         *(share(one, none, Value(kind)) for kind in kinds), value(one, FRAMES_PER_SECOND), *thesis])
    return Table(
        "merging", "Merging faces into rectangles (table 6.9)",
        "Triangles are in thousands. Shares are relative to the same scene without merging. As in the thesis, "
        "triangles hidden behind terrain are drawn too. Terrane adds the method `greedy`. The worlds differ from those "
        "of the thesis, so compare only shares.",
        "a smaller view distance",
        ["scene", "merging", "opaque, k", "transparent, k", "shadow, k", "opaque, %", "transparent, %", "shadow, %",
         "frames/s", "thesis: shares, %", "thesis: frames/s"],
        rows, [Plot("scene, merging", "triangles, % of none", [5, 7], name_columns=2)])


def flights(s):
    rows, curves = [], []
    by_second = "/flight/by_second/"
    for name, is_from_save in (("from a save", True), ("generated", False)):
        cell = flight(s, is_from_save)
        rows.append([name, *(value(cell, Value(f"/flight/{number}")) for number in (
            "seconds_to_load", "seconds_to_load_again", "chunks_missing_on_landing", "frames", "frame_ms",
            "slowest_frame_ms", "frames_over_twice_the_median"))])
        curves += [Curve(cell, by_second + "seconds", by_second + "frames", f"frames/s, {name}"),
                   Curve(cell, by_second + "seconds", by_second + "visible", f"chunks, {name}", True)]
    options = ("at 320×180 with preset low; the CPU draws them too" if s.is_software
               else "with the options of the other tables")
    return Table(
        "flight", "Straight flight (graphs 6.4 and 6.5)",
        f"Landscape: wait until all in view is loaded, fly straight ahead for {s.flight_seconds:g} s at 60 blocks/s, "
        f"wait again. Frames are drawn all the time, {options}. The thesis (V=32, from disk: 41 s to load) had stalls "
        "of up to 600 ms. Its loading kept up with the flight, its generation did not.",
        "view distance and time",
        ["chunks", "first load, s", "load after the flight, s", "missing after the flight", "frames", "frame, ms",
         "slowest frame, ms", "frames over twice the median"],
        rows, curve_plot=CurvePlot("seconds", "frames per second", curves, "visible chunks"))


def world_tables(s):
    return [mesh_section_heights(s), memory_by_chunks(s), merging_methods(s), flights(s)]
