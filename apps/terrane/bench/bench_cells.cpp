#include "apps/terrane/bench/bench_cells.h"

#include <fmt/format.h>

#include <algorithm>

#include "terrane/mesh/mesh_options.h"

namespace terrane::app {
namespace {

// In place where it is there, so that equal options make equal cells.
void setFlag(Arguments& arguments, const std::string& flag, const std::string& word) {
    const auto found = std::ranges::find(arguments, flag);
    if (found != arguments.end()) {
        *(found + 1) = word;
        return;
    }
    arguments.push_back(flag);
    arguments.push_back(word);
}

Cell renderCell(const Flags& defaults, const Flags& flags) {
    Arguments arguments = {"render"};
    for (const auto& [flag, word] : defaults) setFlag(arguments, flag, word);
    for (const auto& [flag, word] : flags) setFlag(arguments, flag, word);
    return {std::move(arguments)};
}

Flags smallPicture(const std::string& scene, int viewDistance) {
    return {{"--scene", scene},
            {"--preset", "low"},
            {"--view-distance", fmt::to_string(viewDistance)},
            {"--size", "320x180"}};
}

}  // namespace

Cell frameCell(const BenchSettings& s, const std::string& scene, const Flags& flags) {
    // What tables change is named, although the preset has it.
    return renderCell({{"--scene", scene},
                       {"--preset", "thesis"},
                       {"--view-distance", fmt::to_string(s.viewDistance)},
                       {"--size", s.size},
                       {"--frames", fmt::to_string(s.frames)},
                       {"--samples", "2"},
                       {"--shading", "sample"},
                       {"--shadows", s.isQuick ? "1024" : "2048"},
                       {"--layers", "3"},
                       {"--aggregation", "greedy"},
                       {"--region-height", fmt::to_string(mesh::kDefaultRegionHeight)}},
                      flags);
}

Cell plainFrameCell(const BenchSettings& s, const std::string& scene, const Flags& flags) {
    return renderCell({{"--scene", scene},
                       {"--preset", "low"},
                       {"--view-distance", fmt::to_string(s.viewDistance)},
                       {"--size", s.size},
                       {"--frames", fmt::to_string(s.frames)}},
                      flags);
}

Cell generatingCell(const std::string& scene, int viewDistance) {
    return renderCell(smallPicture(scene, viewDistance), {});
}

Cell loadingCell(const std::string& scene, int viewDistance) {
    Cell cell = renderCell(smallPicture(scene, viewDistance),
                           {{"--save-game", fmt::format("{}-{}", scene, viewDistance)}});
    cell.before = cell.arguments;
    return cell;
}

Cell flightCell(const BenchSettings& s, bool isFromSave) {
    Cell cell{{"fly", "--scene", "landscape", "--for", fmt::format("{:g}", s.flightSeconds)}};
    setFlag(cell.arguments, "--preset", s.isSoftware ? "low" : "thesis");
    setFlag(cell.arguments, "--view-distance", fmt::to_string(s.viewDistance));
    // The flight takes so long in any case: its frames need not.
    setFlag(cell.arguments, "--size", s.isSoftware ? "320x180" : s.size);
    if (!isFromSave) return cell;
    setFlag(cell.arguments, "--save-game", "flight");
    cell.before = cell.arguments;
    return cell;
}

Cell memoryCopyCell() {
    return {{"bench", "--memory-copy"}};
}

double pixelsOf(const std::string& size) {
    const std::size_t cross = size.find('x');
    return std::stod(size.substr(0, cross)) * std::stod(size.substr(cross + 1));
}

std::vector<int> viewDistances(const BenchSettings& s) {
    std::vector<int> distances;
    for (const int distance : {4, 8, 16, 32, 64})
        if (distance < s.viewDistance) distances.push_back(distance);
    distances.push_back(s.viewDistance);
    return distances;
}

}  // namespace terrane::app
