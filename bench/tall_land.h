// The generator examples/lua/generators/tall.lua, for benchmarks and tests of tall worlds.
#pragma once

#include "terrane/base/files.h"
#include "terrane/gen/level_generators.h"
#include "terrane/lua/script.h"

namespace terrane::bench {

constexpr world::Heights kTallHeights{-1024, 1792};  // that the script declares

// Throws if the script cannot be read. The block types outlive the result.
inline gen::LevelGenerators::MakeGraph recordTallLand(const world::BlockRegistry& blocks) {
    const lua::Script script{base::readFile(TERRANE_SOURCE_DIR "/examples/lua/generators/tall.lua").value(),
                             "tall.lua"};
    return [script, &blocks](int level) {
        return lua::recordScript(script, {"tall", ""}, blocks, {level, kTallHeights});
    };
}

}  // namespace terrane::bench
