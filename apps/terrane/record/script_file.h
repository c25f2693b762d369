// Reads path files (docs/video.md). Errors name the file, the line and the key.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/terrane/record/script.h"
#include "terrane/base/result.h"
#include "terrane/world/block_registry.h"

namespace terrane::app {

// Options of the command line; they take precedence over the file.
struct ScriptDefaults {
    WorldOptions world;
    GraphicsOptions graphics;
    // Given flags without dashes: the file's options of these names are ignored; with a preset, all options
    // that it sets.
    std::vector<std::string> given;
};

// `name` stands for the file in errors.
base::Result<Script> parseScript(std::string_view toml, std::string_view name, const ScriptDefaults& defaults,
                                 const world::BlockRegistry& blocks);

}  // namespace terrane::app
