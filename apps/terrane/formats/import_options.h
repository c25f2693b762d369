// Options of `terrane import`. A plain value.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "apps/terrane/option_values.h"
#include "terrane/world/coords.h"

namespace terrane::app {

struct ImportOptions {
    std::string source;
    WorldOptions world;
    SaveOptions save;
    std::string mapping, report;           // files; empty: none
    std::string dimension = "overworld";   // of a Minecraft world
    std::optional<world::ChunkArea> area;  // x0, z0, x1, z1 in its chunks
    int shift = 0;                         // blocks added to heights
    std::string at;                        // "X,Y" or "X,Y,Z" in blocks; empty: 0
    std::string output;                    // a structure file instead of a world
    bool skipsAir = false;                 // air of the source leaves the world as it is
    int exitCode = 0;                      // after the run
};

}  // namespace terrane::app
