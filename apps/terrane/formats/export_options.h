// Options of `terrane export`. A plain value.
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
    std::optional<world::ChunkArea> area;  // all heights; or `box`
    std::string box;                       // "X0,Y0,Z0,X1,Y1,Z1" in blocks, the end excluded
    std::string mapping;                   // for a schematic
    std::string resourcePack;              // for formats with colors or textures
    int bits = 8;                          // per pixel of a height map
};

}  // namespace terrane::app
