// What `terrane export` is asked for. A plain value.
#pragma once

#include <optional>
#include <string>

#include "apps/terrane/option_values.h"
#include "terrane/world/coords.h"

namespace terrane::app {

struct ExportOptions {
    std::string output;
    WorldOptions world;
    SaveOptions save;
    std::optional<world::ChunkArea> area;  // all heights of it; or
    std::string box;                       // "X0,Y0,Z0,X1,Y1,Z1" in blocks, the end excluded
    std::string mapping;                   // of a schematic
    std::string resourcePack;              // of what has colors or textures
    int bits = 8;                          // of a pixel of heights
};

}  // namespace terrane::app
