// A world opened read-only for `terrane map`.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/terrane/options.h"
#include "terrane/base/result.h"
#include "terrane/game/places.h"
#include "terrane/game/session_parts.h"
#include "terrane/map/map_painter.h"
#include "terrane/world/blocks/block_model.h"

namespace terrane::app {

// Reads a file of places for maps: bookmarks with or without names.
// Lines are "X Y Z YAW PITCH NAME"; unnamed places are numbered. An empty path gives no places. Errors name
// the line.
[[nodiscard]] base::Result<std::vector<game::Place>> readPlaceFile(const std::filesystem::path& file);

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

}  // namespace terrane::app
