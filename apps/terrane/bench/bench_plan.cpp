#include "apps/terrane/bench/bench_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>
#include <utility>

#include "terrane/content/built_in.h"

namespace terrane::app {

std::vector<Cell> expandLine(const std::string& line) {
    std::istringstream text(line);
    std::string command, flag, words;
    text >> command;
    std::vector<std::pair<std::string, std::string>> options;
    while (text >> flag >> words) {
        const auto known = std::ranges::find(options, flag, &std::pair<std::string, std::string>::first);
        if (known == options.end())
            options.emplace_back(flag, words);
        else
            known->second = words;
    }
    std::vector<Cell> cells = {{{command}}};
    for (const auto& [name, alternatives] : options) {
        std::vector<Cell> longer;
        for (const Cell& cell : cells) {
            std::istringstream list(alternatives);
            for (std::string word; std::getline(list, word, ',');) {
                longer.push_back(cell);
                longer.back().arguments.insert(longer.back().arguments.end(), {name, word});
            }
        }
        cells = std::move(longer);
    }
    return cells;
}

namespace {

using Cells = std::vector<Cell>;

constexpr const char* kScenes = "--scene ocean,desert,landscape,cave ";

void append(Cells& cells, Cells more) {
    std::ranges::move(more, std::back_inserter(cells));
}

// Frames of the landscape with the options of the thesis; `flags` changes them. Options that groups vary are
// named even if the preset sets them.
Cells frames(const BenchSettings& s, const std::string& flags) {
    return expandLine(fmt::format(
        "render --scene landscape --preset thesis --view-distance {} --size {} --frames {} --samples 2 "
        "--shading sample "
        "--shadows near --shadow-size {} --layers 3 --merging squares-ext --mesh-section-height 64 {}",
        s.viewDistance, s.size, s.frames, s.isQuick ? 1024 : 2048, flags));
}

// With the cheapest options: those of `--preset auto` without a graphics card.
Cells plainFrames(const BenchSettings& s, const std::string& flags) {
    return expandLine(
        fmt::format("render --scene landscape --preset low --view-distance {} --size {} --frames {} {}",
                    s.viewDistance, s.size, s.frames, flags));
}

// Generates everything in view of a scene; the image is small, since loading does not depend on it.
Cells generating(const std::string& scene, const std::string& distances) {
    return expandLine(
        fmt::format("render --scene {} --preset low --view-distance {} --size 320x180", scene, distances));
}

// Loads the same view from a save. A run before it generates the save, with a border of one chunk for light.
Cell loading(const std::string& scene, int distance) {
    Cell cell = generating(scene, fmt::to_string(distance))[0];
    const std::string save = fmt::format("{}-{}", scene, distance);
    cell.arguments.insert(cell.arguments.end(), {"--world", save});
    const world::ChunkPos c = world::chunkOf(content::findScene(scene)->pose.position);
    const int radius = distance + 1;
    cell.before = {
        "generate",
        "--world",
        save,
        "--generator",
        content::kSceneGenerator,
        fmt::format("--area={},{},{},{}", c.x - radius, c.y - radius, c.x + radius + 1, c.y + radius + 1)};
    return cell;
}

// A straight flight over the landscape in real time, generated, or from a save that an equal flight filled.
// Without a graphics card it uses the low preset and a small image.
Cell flight(const BenchSettings& s, bool isFromSave) {
    Cell cell = expandLine(
        fmt::format("flight-bench --scene landscape --duration {:g} --preset {} --view-distance {} --size {}",
                    s.flightSeconds, s.isSoftware ? "low" : "thesis", s.viewDistance,
                    s.isSoftware ? "320x180" : s.size))[0];
    if (!isFromSave) return cell;
    cell.arguments.insert(cell.arguments.end(), {"--world", "flight"});
    return {cell.arguments, cell.arguments};
}

std::vector<int> upTo(int farthest, std::vector<int> numbers) {
    std::erase_if(numbers, [&](int number) { return number > farthest; });
    return numbers;
}

Cells goals(const BenchSettings& s) {
    Cells cells = expandLine(fmt::format("generate --generator {} --radius {} --threads 1 --backend cpu",
                                         content::kSceneGenerator, s.isQuick ? 6 : 16));
    append(cells, generating("landscape", fmt::to_string(s.viewDistance)));
    cells.push_back(loading("landscape", s.viewDistance));
    append(cells, frames(s, "--merging greedy,squares-ext --occlusion-culling off"));
    cells.push_back(flight(s, false));
    return cells;
}

Cells meshSectionHeights(const BenchSettings& s) {
    Cells cells;
    for (const int distance : upTo(std::max(8, s.farthest), {8, 16, 32, 56})) {
        // At 56 the thesis has only these.
        const char* heights = distance == 56 ? "8,64,128" : "8,16,32,64,128";
        for (Cell& cell :
             frames(s, fmt::format("--view-distance {0} --mesh-section-height {1} --world landscape-{0}",
                                   distance, heights)))
            cells.push_back({std::move(cell.arguments), loading("landscape", distance).before});
    }
    return cells;
}

Cells shadowMaps(const BenchSettings& s) {
    const auto samples = upTo(s.maxSamples, s.isQuick ? std::vector{1, 4} : std::vector{1, 2, 4, 8});
    const std::string flags = fmt::format("--samples {} --time 0.2 ", fmt::join(samples, ","));
    Cells cells = frames(s, flags + "--shadows off");
    append(cells, frames(s, flags + "--shadow-size " + (s.isQuick ? "1024" : "1024,2048,4096")));
    return cells;
}

Cells effects(const BenchSettings& s) {
    Cells cells;
    for (const char* flag : {"", "--depth-of-field off", "--god-rays off", "--sharp-filtering off",
                             "--msaa-alpha-test off", "--t-junctions open", "--animation off"})
        append(cells, frames(s, (s.isQuick ? "--scene ocean,landscape " : kScenes) + std::string(flag)));
    return cells;
}

Cells viewDistances(const BenchSettings& s) {
    Cells cells;
    for (const int distance : upTo(std::max(4, (s.isQuick ? 2 : 1) * s.farthest), {4, 8, 16, 32, 64})) {
        const std::string word = fmt::to_string(distance);
        append(cells, generating("landscape", word));
        cells.push_back(loading("landscape", distance));
        append(cells, frames(s, "--view-distance " + word));
        append(cells, plainFrames(s, "--view-distance " + word));
    }
    return cells;
}

Cells resolutions(const BenchSettings& s) {
    const std::string sizes =
        s.isQuick ? "--size 160x90,320x180,640x360" : "--size 320x180,640x360,960x540,1280x720,1920x1080";
    Cells cells = frames(s, sizes);
    append(cells, plainFrames(s, sizes));
    return cells;
}

// `--preset low`, and the same with each single option changed.
Cells effectCosts(const BenchSettings& s) {
    Cells cells;
    for (const char* flag :
         {"", "--samples 4", "--shading off", "--light smooth", "--shadows near", "--ssao on",
          "--depth-of-field on", "--distance-fog off", "--god-rays on", "--clouds on", "--animation off",
          "--sharp-filtering on", "--layers 0,3", "--t-junctions open", "--occlusion-culling off"})
        append(cells, plainFrames(s, flag));
    return cells;
}

}  // namespace

std::string keyOf(const Cell& cell) {
    return fmt::format("{}", fmt::join(cell.arguments, " "));
}

BenchSettings quickSettings() {
    BenchSettings settings;
    settings.isQuick = true;
    settings.size = "320x180";
    settings.viewDistance = settings.farthest = 8;
    settings.frames = 3;
    settings.runs = 1;
    settings.flightSeconds = 4;
    return settings;
}

std::vector<CellGroup> planGroups(const BenchSettings& s) {
    const auto scenes = [&](const std::string& flags) { return frames(s, kScenes + flags); };
    std::vector<int> upToOwn = upTo(s.viewDistance - 1, {4, 8, 16, 32, 64});
    upToOwn.push_back(s.viewDistance);
    const Cells landscapes = generating("landscape", fmt::format("{}", fmt::join(upToOwn, ",")));
    const std::string distances =
        fmt::format("{}", fmt::join(upTo(std::max(4, s.farthest), {4, 8, 16, 32}), ","));
    Cells saves;
    for (const char* scene : {"ocean", "desert", "landscape", "cave"})
        saves.push_back(loading(scene, s.viewDistance));
    return {
        {"goals", goals(s)},
        {"region-height", meshSectionHeights(s)},
        {"memory", landscapes},
        {"merging", scenes("--merging none,lines,squares,squares-ext,greedy --occlusion-culling off")},
        {"flight", {flight(s, true), flight(s, false)}},
        {"post-processing", scenes("--ssao on")},
        {"light-texture", scenes("")},
        {"shading", scenes("--samples 4 --shading off,pixel,sample --view-distance " + distances)},
        {"shadow-triangles", generating("landscape", distances)},
        {"shadow-maps", shadowMaps(s)},
        {"layers", scenes(s.isQuick ? "--layers 0,3" : "--layers 0,1,2,3")},
        {"effects", effects(s)},
        {"stages", {landscapes.back(), loading("landscape", s.viewDistance), {{"bench", "--memory-copy"}}}},
        {"passes", scenes("")},
        {"memory-by-owner", landscapes},
        {"disk", saves},
        {"view-distance", viewDistances(s)},
        {"resolution", resolutions(s)},
        {"effect-costs", effectCosts(s)},
    };
}

std::vector<Cell> uniqueCells(const std::vector<CellGroup>& groups) {
    std::vector<Cell> cells;
    std::set<std::string> known;
    for (const CellGroup& group : groups)
        for (const Cell& cell : group.cells)
            if (known.insert(keyOf(cell)).second) cells.push_back(cell);
    return cells;
}

}  // namespace terrane::app
