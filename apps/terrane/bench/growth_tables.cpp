// What grows with the view distance and the picture, and what each effect costs.
#include <fmt/format.h>

#include <algorithm>

#include "apps/terrane/bench/bench_cells.h"

namespace terrane::app {
namespace {

Table byViewDistance(const BenchSettings& s) {
    Table table{
        "view-distance",
        "What grows with the view distance",
        fmt::format("Landscape. Loading: from nothing until all in view is lit, meshed and uploaded, "
                    "generating or from a save. Frames: {}, with the options of the thesis's tables and with "
                    "`--preset low`; processor: milliseconds of all cores for a frame of the former.",
                    s.size),
        "view distances over " + fmt::to_string(2 * s.farthest),
        {"V", "chunks in view", "generating, s", "from a save, s", "triangles, k", "frame, ms",
         "processor, ms", "preset low: frame, ms", "process, MB"},
        {},
        {{"frame", PlotKind::Lines, "view distance, chunks", "milliseconds a frame", {5, 7}, 1, true, true},
         {"load", PlotKind::Lines, "view distance, chunks", "seconds to load all", {2, 3}, 1, true, true}}};
    for (int distance : {4, 8, 16, 32, 64}) {
        if (distance > std::max(4, (s.isQuick ? 2 : 1) * s.farthest)) continue;
        const Flags flags = {{"--view-distance", fmt::to_string(distance)}};
        const Cell frame = frameCell(s, "landscape", flags),
                   generated = generatingCell("landscape", distance);
        table.rows.push_back(
            {textEntry(fmt::to_string(distance)), valueEntry(generated, {kChunksInView}),
             valueEntry(generated, loadSeconds()),
             valueEntry(loadingCell("landscape", distance), loadSeconds()),
             sumEntry(frame, {{"/triangles/opaque", 1e-3}, {"/triangles/transparent", 1e-3}}),
             valueEntry(frame, {"/milliseconds/frame"}), valueEntry(frame, {"/milliseconds/frame_processor"}),
             valueEntry(plainFrameCell(s, "landscape", flags), {"/milliseconds/frame"}),
             valueEntry(generated, {"/bytes/process", 1e-6})});
    }
    return table;
}

Table byResolution(const BenchSettings& s) {
    Table table{
        "resolution",
        "What grows with the picture",
        fmt::format("Landscape, V={}, with the options of the thesis's tables and with `--preset low`.",
                    s.viewDistance),
        "large pictures",
        {"pixels", "size", "frame, ms", "processor, ms", "ns a pixel", "preset low: frame, ms",
         "preset low: ns a pixel"},
        {},
        {{"", PlotKind::Lines, "pixels", "milliseconds a frame", {2, 5}, 1, true, true}}};
    const std::vector<std::string> sizes =
        s.isQuick ? std::vector<std::string>{"160x90", "320x180", "640x360"}
                  : std::vector<std::string>{"320x180", "640x360", "960x540", "1280x720", "1920x1080"};
    for (const std::string& size : sizes) {
        const Cell frame = frameCell(s, "landscape", {{"--size", size}});
        const Cell plain = plainFrameCell(s, "landscape", {{"--size", size}});
        const Value perPixel{"/milliseconds/frame", 1e6 / pixelsOf(size)};
        table.rows.push_back({textEntry(fmt::format("{:.0f}", pixelsOf(size))), textEntry(size),
                              valueEntry(frame, {"/milliseconds/frame"}),
                              valueEntry(frame, {"/milliseconds/frame_processor"}),
                              valueEntry(frame, perPixel), valueEntry(plain, {"/milliseconds/frame"}),
                              valueEntry(plain, perPixel)});
    }
    return table;
}

enum class InLow : std::uint8_t { Off, On, Neither };

struct Effect {
    const char* name;
    std::string flag, on, off;
    InLow inLow;  // what --preset low has
};

std::vector<Effect> effectList() {
    return {{"4 samples a pixel", "--samples", "4", "1", InLow::Off},
            {"shading", "--shading", "sample", "off", InLow::On},
            {"smooth light", "--light", "smooth", "classic", InLow::Off},
            {"shadows, 2048²", "--shadows", "2048", "off", InLow::Off},
            {"ambient occlusion", "--ssao", "on", "off", InLow::Off},
            {"depth of field", "--depth-of-field", "on", "off", InLow::Off},
            {"atmosphere", "--atmosphere", "on", "off", InLow::On},
            {"god rays", "--god-rays", "on", "off", InLow::Off},
            {"clouds", "--clouds", "on", "off", InLow::Off},
            {"animation", "--animation", "on", "off", InLow::On},
            {"better texturing", "--better-texturing", "on", "off", InLow::Off},
            {"3 layers of water and glass", "--layers", "3", "0", InLow::Neither},
            {"T-junctions covered", "--t-junctions", "covered", "open", InLow::On},
            {"hidden regions left out", "--occlusion-culling", "on", "off", InLow::On}};
}

Table effectCosts(const BenchSettings& s) {
    Table table{
        "effect-costs",
        "What each effect costs",
        fmt::format("Landscape, {}, V={}: milliseconds of a frame with `--preset low`, the effect switched "
                    "on and off and all else as it is. Under about a tenth of the frame a difference is "
                    "noise; processor time, of all cores, is steadier where other programs run.",
                    s.size, s.viewDistance),
        "view distance, size",
        {"effect", "off, ms", "on, ms", "difference, ms", "difference, processor ms"},
        {},
        {{"", PlotKind::Bars, "effect", "milliseconds it adds", {3, 4}, 1}}};
    const Value milliseconds{"/milliseconds/frame"};
    for (const Effect& effect : effectList()) {
        const auto cell = [&](InLow state, const std::string& word) {
            // What the preset has needs no flag: it is one run for all effects.
            return plainFrameCell(s, "landscape",
                                  effect.inLow == state ? Flags() : Flags{{effect.flag, word}});
        };
        const Cell off = cell(InLow::Off, effect.off), on = cell(InLow::On, effect.on);
        table.rows.push_back({textEntry(effect.name), valueEntry(off, milliseconds),
                              valueEntry(on, milliseconds), differenceEntry(on, off, milliseconds),
                              differenceEntry(on, off, {"/milliseconds/frame_processor"})});
    }
    return table;
}

}  // namespace

std::vector<Table> growthTables(const BenchSettings& s) {
    return {byViewDistance(s), byResolution(s), effectCosts(s)};
}

}  // namespace terrane::app
