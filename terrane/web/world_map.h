// Serves the map of a world to browsers, without a game server. One thread.
#pragma once

#include <cstdint>
#include <functional>

#include "terrane/base/result.h"
#include "terrane/io/map_world.h"
#include "terrane/web/map_parts.h"

namespace terrane::web {

struct WorldMapLoop {
    std::function<void(std::uint16_t port)> onOpened = {};  // may be empty
    std::function<bool()> stopRequested;                    // called a few times per second
};

// Uses the world's threads in place of those of `settings`. Runs until stopRequested().
[[nodiscard]] base::Result<void> serveWorldMap(io::MapWorld& world, const MapSettings& settings,
                                               const WorldMapLoop& loop);

}  // namespace terrane::web
