// A world that is shown and not played, for `terrane map`.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/terrane/option_values.h"
#include "terrane/game/session_parts.h"
#include "terrane/map/map_painter.h"
#include "terrane/world/texture_source.h"

namespace terrane::app {

struct MapWorld {
    // Its store has the far tiles of edited land. The generators outlive it.
    game::SessionParts parts;
    world::TextureSource textures;
    std::vector<world::ChunkPos> edited;  // of level 0
};

// `options` get the world's seed and generator.
[[nodiscard]] base::Result<std::unique_ptr<MapWorld>> openMapWorld(WorldOptions& options,
                                                                   const SaveOptions& save,
                                                                   const std::string& resourcePack);

// Paints it; the world outlives it. `cache` may be null.
[[nodiscard]] base::Result<map::MapPainter> painterOf(MapWorld& world, map::SurfaceCache* cache = nullptr);

}  // namespace terrane::app
