// A world of flat land in a folder of its own.
#pragma once

#include "terrane/io/world_options.h"
#include "tests/base/temp_folder.h"

namespace terrane::io {

inline WorldOptions flatLand() {
    WorldOptions options;
    options.generator = "flat";
    options.threads = 2;
    return options;
}

inline SaveOptions worldIn(const base::TempFolder& folder) {
    return {.world = (folder / "world.sqlite").string(), .storeGenerated = {}};
}

}  // namespace terrane::io
