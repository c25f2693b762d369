// The thesis's tables about regions, memory, merging and flights.
#include <fmt/format.h>

#include <algorithm>

#include "apps/terrane/bench/bench_cells.h"

namespace terrane::app {
namespace {

constexpr std::array kHeights = {8, 16, 32, 64, 128};

// Table 6.5; 0: not measured.
struct RegionFigures {
    int viewDistance;
    std::array<int, 5> framesPerSecond;
    std::array<int, 5> triangles;
    std::array<double, 5> loadSeconds;
};
constexpr std::array<RegionFigures, 4> kRegions = {
    {{8, {79, 79, 79, 79, 79}, {139594, 147518, 165684, 194812, 272270}, {11, 8, 4, 3, 2.5}},
     {16, {59, 60, 55, 61, 59}, {739286, 747504, 767902, 808836, 914982}, {43, 28, 18, 10, 8}},
     {32, {40, 44, 41, 41, 44}, {1734210, 1743498, 1768282, 1811754, 1928928}, {172, 87, 60, 41, 31}},
     {56, {26, 0, 0, 28, 29}, {4163242, 0, 0, 4261558, 4407838}, {893, 0, 0, 125, 115}}}};

Entry orNothing(double figure) {
    return figure > 0 ? figureEntry(figure) : textEntry("–");
}

Table regionHeights(const BenchSettings& s) {
    Table table{
        "region-height",
        "Height of regions (table 6.5, graphs 6.1 and 6.2)",
        "Chunks are culled and drawn in parts of this height. Landscape. Loading is from a save that has "
        "everything, in the file system's cache, until all in view is lit, meshed and uploaded. Triangles "
        "are "
        "those in view, without what is hidden behind terrain.",
        "fewer view distances",
        {"V", "height", "frames/s", "triangles", "load, s", "thesis: frames/s", "thesis: triangles",
         "thesis: load, s"},
        {},
        {{"triangles", PlotKind::Bars, "view distance, height of regions", "triangles", {3, 6}, 2},
         {"load", PlotKind::Bars, "view distance, height of regions", "seconds to load", {4, 7}, 2}}};
    for (const RegionFigures& thesis : kRegions) {
        if (thesis.viewDistance > std::max(8, s.farthest)) continue;
        for (std::size_t k = 0; k < kHeights.size(); ++k) {
            if (thesis.framesPerSecond[k] == 0) continue;
            const std::string distance = fmt::to_string(thesis.viewDistance),
                              height = fmt::to_string(kHeights[k]);
            Cell cell =
                frameCell(s, "landscape", {{"--view-distance", distance}, {"--region-height", height}});
            const std::string save = "landscape-" + distance;
            cell.arguments.insert(cell.arguments.end(), {"--save-game", save});
            cell.before = loadingCell("landscape", thesis.viewDistance).arguments;
            table.rows.push_back({textEntry(distance), textEntry(height), valueEntry(cell, framesPerSecond()),
                                  sumEntry(cell, {{"/triangles/opaque"}, {"/triangles/transparent"}}),
                                  valueEntry(cell, loadSeconds()), orNothing(thesis.framesPerSecond[k]),
                                  orNothing(thesis.triangles[k]), orNothing(thesis.loadSeconds[k])});
        }
    }
    return table;
}

Table memoryByChunks(const BenchSettings& s) {
    Table table{
        "memory",
        "Memory by the number of chunks (graph 6.3)",
        "Straight lines through what the landscape takes at all view distances: so much for each chunk "
        "that is shown, and so much in any case. Without a graphics card the driver keeps the GPU's "
        "memory, and its own frames and shaders, in the process.",
        "smaller view distances",
        {"memory", "kB a chunk", "MB in any case", "thesis: kB a chunk", "thesis: MB in any case"},
        {},
        {}};
    std::vector<Cell> cells;
    for (const int distance : viewDistances(s)) cells.push_back(generatingCell("landscape", distance));
    const auto add = [&](const char* name, const std::vector<const char*>& owners, const char* slope,
                         const char* rest) {
        std::vector<Value> kilobytes, megabytes;
        for (const char* owner : owners) {
            kilobytes.push_back({owner, 1e-3});
            megabytes.push_back({owner, 1e-6});
        }
        table.rows.push_back({textEntry(name), lineEntry(cells, {kChunksInView}, kilobytes, LinePart::Slope),
                              lineEntry(cells, {kChunksInView}, megabytes, LinePart::Intercept),
                              textEntry(slope), textEntry(rest)});
    };
    add("RAM: the whole process", {"/bytes/process"}, "312.9", "24");
    add("RAM: blocks and light of the world", {"/bytes/blocks", "/bytes/light"}, "–", "–");
    add("GPU: quads and light of the world", {"/bytes/quads_gpu", "/bytes/light_gpu"}, "258.6", "853");
    return table;
}

struct MergingFigures {
    const char* scene;
    // none, lines, squares, squares ext: share of opaque, transparent and shadow triangles in per cent;
    // frames/s
    std::array<const char*, 4> shares;
    std::array<int, 4> framesPerSecond;
};
constexpr std::array<MergingFigures, 4> kMerging = {
    {{"ocean", {"100", "40/13/44", "34/2/40", "30/2/36"}, {35, 54, 56, 56}},
     {"desert", {"100", "56/–/50", "56/–/50", "48/–/42"}, {44, 53, 53, 56}},
     {"landscape", {"100", "46/16/52", "41/3/50", "36/3/43"}, {29, 42, 44, 46}},
     {"cave", {"100", "57/–/55", "57/–/54", "50/–/48"}, {60, 60, 60, 60}}}};
constexpr std::array kMethods = {"none", "lines", "squares", "squares-ext", "greedy"};

Table merging(const BenchSettings& s) {
    Table table{
        "aggregation",
        "Merging faces into rectangles (table 6.9)",
        "Triangles in thousands; the share is that of the same scene without merging. What is hidden "
        "behind terrain is drawn too, as in the thesis. `greedy` is ours. Worlds differ, shares can be "
        "compared.",
        "a smaller view distance",
        {"scene", "merging", "opaque, k", "transparent, k", "shadow, k", "opaque, %", "transparent, %",
         "shadow, %", "frames/s", "thesis: shares, %", "thesis: frames/s"},
        {},
        {{"", PlotKind::Bars, "scene, merging", "triangles, % of none", {5, 7}, 2}}};
    for (const MergingFigures& thesis : kMerging) {
        const auto cell = [&](const char* method) {
            return frameCell(s, thesis.scene, {{"--aggregation", method}, {"--occlusion-culling", "off"}});
        };
        for (std::size_t k = 0; k < kMethods.size(); ++k) {
            const Cell one = cell(kMethods[k]), none = cell("none");
            std::vector<Entry> row{textEntry(thesis.scene), textEntry(kMethods[k])};
            for (const char* kind : {"opaque", "transparent", "shadow"})
                row.push_back(valueEntry(one, {fmt::format("/triangles/{}", kind), 1e-3}));
            for (const char* kind : {"opaque", "transparent", "shadow"})
                row.push_back(shareEntry(one, none, {fmt::format("/triangles/{}", kind)}));
            row.push_back(valueEntry(one, framesPerSecond()));
            const bool isInThesis = k < thesis.shares.size();
            row.push_back(textEntry(isInThesis ? thesis.shares[k] : "–"));
            row.push_back(orNothing(isInThesis ? thesis.framesPerSecond[k] : 0));
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

Table flights(const BenchSettings& s) {
    const Cell fromSave = flightCell(s, true), generating = flightCell(s, false);
    Table table{
        "flight",
        "A flight ahead (graphs 6.4 and 6.5)",
        fmt::format(
            "Landscape: wait until all in view is there, fly ahead {:g} s at 60 blocks/s, wait again; "
            "frames are drawn all the time. {} The thesis (V=32, from disk: 41 s to load) saw stalls "
            "of up to 600 ms; loading kept up with the flight, generating did not.",
            s.flightSeconds,
            s.isSoftware ? "320×180, preset low: the processor draws, too."
                         : "With the options of the other tables."),
        "view distance and time",
        {"chunks", "to load, s", "to load again, s", "missing on landing", "frames", "frame, ms",
         "slowest frame, ms", "frames over twice the median"},
        {},
        {},
        CurvePlot{"seconds", "frames in a second", "chunks that are shown", {}}};
    for (const auto& [name, cell] :
         {std::pair("from a save", fromSave), std::pair("generated", generating)}) {
        std::vector<Entry> row{textEntry(name)};
        for (const char* figure : {"seconds_to_load", "seconds_to_load_again", "chunks_missing_on_landing",
                                   "frames", "frame_ms", "slowest_frame_ms", "frames_over_twice_the_median"})
            row.push_back(valueEntry(cell, {fmt::format("/flight/{}", figure)}));
        table.rows.push_back(std::move(row));
        const std::string lines = "/flight/by_second/";
        table.curvePlot->curves.push_back(
            {cell, lines + "seconds", lines + "frames", fmt::format("frames/s, {}", name), false});
        table.curvePlot->curves.push_back(
            {cell, lines + "seconds", lines + "visible", fmt::format("chunks, {}", name), true});
    }
    return table;
}

}  // namespace

std::vector<Table> worldTables(const BenchSettings& s) {
    return {regionHeights(s), memoryByChunks(s), merging(s), flights(s)};
}

}  // namespace terrane::app
