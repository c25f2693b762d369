// libFuzzer: any text as a path file (docs/video.md). Accepted camera paths are evaluated.
#include <cmath>

#include "apps/terrane/record/script.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace terrane;

const world::BlockRegistry& fuzzBlocks() {
    static const world::BlockRegistry blocks = *world::BlockRegistry::parse(
        "[[block]]\nname = \"stone\"\nshape = \"cube\"\ntexture = \"stone\"\n", "fuzz");
    return blocks;
}

void requireFinite(const view::PathPoint& point) {
    const glm::dvec3& at = point.camera.position;
    for (const double value : {at.x, at.y, at.z, double{point.camera.yaw}, double{point.camera.pitch}})
        fuzz::require(std::isfinite(value));
    fuzz::require(point.timeDay >= 0 && point.timeDay <= 1);
    fuzz::require(world::isInWorld(render::cameraChunk(point.camera)));
}

void walk(const app::Script& script) {
    constexpr int kSteps = 16;
    fuzz::require(std::isfinite(script.seconds()) && script.seconds() > 0);
    for (int step = 0; step <= kSteps; ++step) {
        const double time = script.seconds() * step / kSteps;
        const view::Shot& shot = view::shotAt(script.shots, time);
        requireFinite(shot.path.at(time - shot.start));
        render::settingsOf(view::optionsAt(shot, time - shot.start).choices, true);
    }
    for (const view::Shot& shot : script.shots)
        for (const view::EditCue& edit : shot.edits) fuzz::require(edit.box.blockCount() > 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    app::ScriptDefaults defaults;
    defaults.graphics.choices.preset = "high";
    const auto script =
        app::parseScript(fuzz::FuzzInput(data, size).restAsText(), "path.toml", defaults, fuzzBlocks());
    if (script) {
        walk(*script);
    } else {
        fuzz::requireReason(script.error());
    }
    return 0;
}
