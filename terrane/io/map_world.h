// A world opened read-only to draw maps of it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/game/session_parts.h"
#include "terrane/io/world_options.h"
#include "terrane/map/map_painter.h"
#include "terrane/world/blocks/block_model.h"

namespace terrane::io {

struct MapWorld {
    // The store has the far tiles of edited terrain. The generators outlive it.
    game::SessionParts parts;
    world::TextureSource textures;
    std::vector<world::ChunkPos> edited;  // of level 0
};

// Sets seed and generator in `options` to the world's.
[[nodiscard]] base::Result<std::unique_ptr<MapWorld>> openMapWorld(WorldOptions& options,
                                                                   const SaveOptions& save,
                                                                   const std::string& resourcePack);

// The painter of the world's map; the world outlives it. `cache` may be null.
[[nodiscard]] base::Result<map::MapPainter> painterOf(MapWorld& world, map::SurfaceCache* cache = nullptr);

}  // namespace terrane::io
