// The thesis's tables about frames: shading, shadows, layers, effects.
#include <fmt/format.h>

#include <algorithm>

#include "apps/terrane/bench/bench_cells.h"

namespace terrane::app {
namespace {

constexpr std::array kDistances = {4, 8, 16, 32};

// Tables 6.6 and 6.7, of work groups of 8², which are about the best.
constexpr std::array kPostProcessing = {56, 55, 45, 66};
// Table 6.8, of 4².
constexpr std::array<std::pair<int, int>, 4> kLightTexture = {
    {{1967, 56}, {1965, 54}, {1967, 45}, {1967, 65}}};

Table postProcessing(const BenchSettings& s) {
    Table table{
        "post-processing",
        "Effects after shading, in place of work groups (tables 6.6 and 6.7)",
        "The thesis computes effects in compute shaders and varies their work groups (2² to 32²; about the "
        "same from 8² on). Ours are fragment shaders without work groups; what they cost is beside: GPU "
        "milliseconds of each pass, ambient occlusion switched on.",
        "view distance, size",
        {"scene", "frames/s", "ambient occlusion, ms", "god rays, ms", "depth of field, ms", "final, ms",
         "thesis: frames/s, 8²"},
        {},
        {}};
    for (std::size_t k = 0; k < kSceneNames.size(); ++k) {
        const Cell cell = frameCell(s, kSceneNames[k], {{"--ssao", "on"}});
        std::vector<Entry> row{textEntry(kSceneNames[k]), valueEntry(cell, framesPerSecond())};
        for (const char* pass : {"ambient occlusion", "god rays", "depth of field", "final"})
            row.push_back(valueEntry(cell, {fmt::format("/passes/{}", pass)}));
        row.push_back(figureEntry(kPostProcessing[k]));
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table lightTexture(const BenchSettings& s) {
    Table table{
        "light-texture",
        "Light on the GPU, in place of a texture's size (table 6.8)",
        "The thesis varies the size of its light map's textures (2² to 32² chunks: 1931 to 2665 MB). Ours "
        "is a pool of tiles of 8³ blocks of which equal ones are kept once: it has no size to choose.",
        "view distance, size",
        {"scene", "light on the GPU, MB", "kB a chunk", "frames/s", "thesis: all on the GPU, MB, 4²",
         "thesis: frames/s, 4²"},
        {},
        {}};
    for (std::size_t k = 0; k < kSceneNames.size(); ++k) {
        const Cell cell = frameCell(s, kSceneNames[k]);
        table.rows.push_back({textEntry(kSceneNames[k]), valueEntry(cell, {"/bytes/light_gpu", 1e-6}),
                              valueEntry(cell, {"/bytes/light_gpu", 1e-3, false, kChunksInView}),
                              valueEntry(cell, framesPerSecond()), figureEntry(kLightTexture[k].first),
                              figureEntry(kLightTexture[k].second)});
    }
    return table;
}

// Table 6.10: off, per pixel, per sample; V = 4, 8, 16, 32.
constexpr std::array<std::array<std::array<int, 4>, 3>, 4> kShading = {
    {{{{82, 77, 71, 57}, {77, 71, 65, 52}, {60, 53, 49, 41}}},
     {{{88, 83, 73, 51}, {82, 77, 68, 52}, {66, 60, 55, 44}}},
     {{{81, 73, 55, 42}, {79, 68, 52, 40}, {69, 57, 43, 34}}},
     {{{72, 68, 68, 62}, {60, 59, 58, 55}, {45, 44, 44, 42}}}}};
constexpr std::array kShadingWords = {"off", "pixel", "sample"};

Table shading(const BenchSettings& s) {
    Table table{"shading",
                "Shading and view distance (table 6.10)",
                "Frames a second with 4 samples a pixel: without shading, once a pixel, for each sample.",
                "view distances",
                {"scene", "shading"},
                {},
                {}};
    std::vector<std::size_t> used;
    for (std::size_t k = 0; k < kDistances.size(); ++k)
        if (kDistances[k] <= std::max(4, s.farthest)) used.push_back(k);
    for (const std::size_t k : used) {
        table.columns.push_back(fmt::format("V={}", kDistances[k]));
        table.columns.push_back(fmt::format("thesis: V={}", kDistances[k]));
    }
    for (std::size_t scene = 0; scene < kSceneNames.size(); ++scene) {
        for (std::size_t mode = 0; mode < kShadingWords.size(); ++mode) {
            std::vector<Entry> row{textEntry(kSceneNames[scene]), textEntry(kShadingWords[mode])};
            for (const std::size_t k : used) {
                const Cell cell = frameCell(s, kSceneNames[scene],
                                            {{"--samples", "4"},
                                             {"--shading", kShadingWords[mode]},
                                             {"--view-distance", fmt::to_string(kDistances[k])}});
                row.push_back(valueEntry(cell, framesPerSecond()));
                row.push_back(figureEntry(kShading[scene][mode][k]));
            }
            table.rows.push_back(std::move(row));
        }
    }
    Plot plot{"", PlotKind::Bars, "scene, shading", "frames/s", {}, 2};
    for (std::size_t k = 0; k < used.size(); ++k) plot.columns.push_back(2 + 2 * k);  // ours
    table.plots.push_back(std::move(plot));
    return table;
}

// Table 6.11, in thousands.
constexpr std::array<int, 4> kShadowsAtNoon = {39, 50, 50, 50}, kShadowsAtDawn = {35, 70, 221, 262};
constexpr const char* kShadowsOverTheDay = "/shadow_triangles_over_the_day";
constexpr int kDawn = 8, kNoon = 20;  // of 40 steps of a day

Table shadowTriangles(const BenchSettings& s) {
    Table table{
        "shadow-triangles",
        "Triangles of the shadow map (table 6.11, graph 6.6)",
        "Landscape, in thousands: what is drawn into the shadow map at noon (time 0.5) and at dawn (0.2), "
        "and over the day. Only what can throw a shadow on the nearest 50 blocks is drawn, without the "
        "faces that look away from the light.",
        "view distances",
        {"time"},
        {},
        {},
        CurvePlot{"time of day (0: midnight, 0.5: noon)", "triangles of the shadow map", "", {}}};
    const std::string triangles = std::string(kShadowsOverTheDay) + "/triangles";
    std::vector<Entry> noon{textEntry("noon")}, dawn{textEntry("dawn")};
    for (std::size_t k = 0; k < kDistances.size(); ++k) {
        if (kDistances[k] > std::max(4, s.farthest)) continue;
        const Cell cell = generatingCell("landscape", kDistances[k]);
        table.columns.push_back(fmt::format("V={}", kDistances[k]));
        table.columns.push_back(fmt::format("thesis: V={}", kDistances[k]));
        noon.push_back(valueEntry(cell, {fmt::format("{}/{}", triangles, kNoon), 1e-3}));
        noon.push_back(figureEntry(kShadowsAtNoon[k]));
        dawn.push_back(valueEntry(cell, {fmt::format("{}/{}", triangles, kDawn), 1e-3}));
        dawn.push_back(figureEntry(kShadowsAtDawn[k]));
        table.curvePlot->curves.push_back({cell, std::string(kShadowsOverTheDay) + "/time", triangles,
                                           fmt::format("V={}", kDistances[k]), false});
    }
    table.rows = {std::move(noon), std::move(dawn)};
    return table;
}

// Table 6.12: off, 1024², 2048², 4096²; 1, 2, 4, 8 samples.
constexpr std::array<std::array<int, 4>, 4> kShadowMaps = {
    {{54, 49, 39, 24}, {47, 41, 35, 22}, {35, 32, 28, 20}, {23, 21, 19, 15}}};
constexpr std::array kShadowWords = {"off", "1024", "2048", "4096"};

Table shadowMaps(const BenchSettings& s) {
    Table table{
        "shadow-maps",
        "Size of the shadow map and samples a pixel (table 6.12)",
        "Landscape at dawn (0.2), frames a second. A driver may take more samples than asked for: Mesa's "
        "software renderer takes 4 for 2.",
        "shadow maps of 2048² and 4096²; 2 and 8 samples",
        {"samples"},
        {},
        {}};
    const std::size_t sizes = s.isQuick ? 2 : kShadowWords.size();
    for (std::size_t k = 0; k < sizes; ++k) {
        const std::string name = k == 0 ? "off" : fmt::format("{}²", kShadowWords[k]);
        table.columns.push_back(name);
        table.columns.push_back("thesis: " + name);
    }
    for (std::size_t row = 0; row < kShadowMaps.size(); ++row) {
        const int samples = 1 << row;
        if (s.isQuick && samples != 1 && samples != 4) continue;
        std::vector<Entry> entries{figureEntry(samples)};
        for (std::size_t k = 0; k < sizes; ++k) {
            const Cell cell = frameCell(
                s, "landscape",
                {{"--samples", fmt::to_string(samples)}, {"--shadows", kShadowWords[k]}, {"--time", "0.2"}});
            entries.push_back(samples > s.maxSamples ? textEntry("not offered")
                                                     : valueEntry(cell, framesPerSecond()));
            entries.push_back(figureEntry(kShadowMaps[row][k]));
        }
        table.rows.push_back(std::move(entries));
    }
    return table;
}

// Table 6.13: 0, 1, 2, 3 layers.
constexpr std::array<std::array<int, 4>, 4> kLayers = {
    {{81, 64, 61, 57}, {68, 61, 59, 56}, {54, 50, 47, 45}, {100, 86, 80, 75}}};

Table layers(const BenchSettings& s) {
    Table table{"layers",
                "Layers of water and glass (table 6.13)",
                "Frames a second. In the thesis layers cost frames where nothing blended is in view, too "
                "(desert, cave); here they cost nothing there.",
                "view distance, size; 1 and 2 layers",
                {"scene"},
                {},
                {}};
    std::vector<std::size_t> used;
    for (const std::size_t k : {0u, 1u, 2u, 3u})
        if (!s.isQuick || k % 3 == 0) used.push_back(k);
    for (const std::size_t k : used) {
        table.columns.push_back(fmt::format("{}", k));
        table.columns.push_back(fmt::format("thesis: {}", k));
    }
    for (std::size_t scene = 0; scene < kSceneNames.size(); ++scene) {
        std::vector<Entry> row{textEntry(kSceneNames[scene])};
        for (const std::size_t k : used) {
            row.push_back(valueEntry(frameCell(s, kSceneNames[scene], {{"--layers", fmt::to_string(k)}}),
                                     framesPerSecond()));
            row.push_back(figureEntry(kLayers[scene][k]));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

// Table 6.14: ocean, desert, landscape, cave; 0: no change, or not there.
struct EffectFigures {
    const char* name;
    Flags flags;
    std::array<int, 4> framesPerSecond;
};

Table effects(const BenchSettings& s) {
    const std::vector<EffectFigures> kEffects = {
        {"default", {}, {57, 56, 41, 59}},
        {"without depth of field", {{"--depth-of-field", "off"}}, {66, 65, 46, 71}},
        {"without god rays", {{"--god-rays", "off"}}, {59, 56, 42, 59}},
        {"without better texturing", {{"--better-texturing", "off"}}, {}},
        {"without MSAA alpha test", {{"--msaa-alpha-test", "off"}}, {}},
        {"T-junctions open", {{"--t-junctions", "open"}}, {}},
        {"without animation", {{"--animation", "off"}}, {}},
    };
    Table table{"effects",
                "Effects switched off, one at a time (table 6.14)",
                "Frames a second. The thesis saw no change from the last four.",
                "two of the four scenes",
                {"options"},
                {},
                {}};
    std::vector<std::size_t> used;
    for (std::size_t k = 0; k < kSceneNames.size(); ++k)
        if (!s.isQuick || k % 2 == 0) used.push_back(k);
    for (const std::size_t k : used) {
        table.columns.push_back(kSceneNames[k]);
        table.columns.push_back(fmt::format("thesis: {}", kSceneNames[k]));
    }
    for (const EffectFigures& effect : kEffects) {
        std::vector<Entry> row{textEntry(effect.name)};
        for (const std::size_t k : used) {
            row.push_back(valueEntry(frameCell(s, kSceneNames[k], effect.flags), framesPerSecond()));
            const int figure = effect.framesPerSecond[k];
            row.push_back(figure > 0 ? figureEntry(figure) : textEntry("no change"));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

}  // namespace

std::vector<Table> frameTables(const BenchSettings& s) {
    return {postProcessing(s), lightTexture(s), shading(s), shadowTriangles(s),
            shadowMaps(s),     layers(s),       effects(s)};
}

}  // namespace terrane::app
