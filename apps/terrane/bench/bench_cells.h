// The runs that tables are made of.
#pragma once

#include <array>
#include <utility>

#include "apps/terrane/bench/bench_plan.h"

namespace terrane::app {

// Flags and their words, as in {"--shadows", "off"}.
using Flags = std::vector<std::pair<std::string, std::string>>;

inline constexpr std::array kSceneNames = {"ocean", "desert", "landscape", "cave"};

// Frames of a scene with the options that the thesis measured with, `flags` apart.
Cell frameCell(const BenchSettings& settings, const std::string& scene, const Flags& flags = {});
// With the least options, which are those of `--preset auto` without a graphics card.
Cell plainFrameCell(const BenchSettings& settings, const std::string& scene, const Flags& flags = {});
// Everything in view of a scene generated; a small picture, as loading does not wait for it.
Cell generatingCell(const std::string& scene, int viewDistance);
// The same from a save that has it all.
Cell loadingCell(const std::string& scene, int viewDistance);
// A flight ahead over the landscape, generating or from a save.
Cell flightCell(const BenchSettings& settings, bool isFromSave);
// How fast one thread copies memory.
Cell memoryCopyCell();

double pixelsOf(const std::string& size);  // of "1920x1080"

// The distances of tables that grow with it, up to the settings' own.
std::vector<int> viewDistances(const BenchSettings& settings);

inline constexpr const char* kChunksInView = "/chunks_in_view";
inline Value framesPerSecond() {
    return {"/milliseconds/frame", 1000, true};
}
inline Value loadSeconds() {
    return {"/milliseconds/load", 1e-3};
}

}  // namespace terrane::app
