// Where a camera stands and when: --scene, --at, --look, --time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/terrane/scenes.h"
#include "terrane/base/result.h"

namespace CLI {
class App;
}

namespace terrane::app {

struct PlaceOptions {
    const Scene* scene = nullptr;
    std::optional<std::vector<double>> at, look;  // X, Y, Z in blocks; yaw, pitch in degrees
    std::optional<float> time;                    // of day
};

void addPlaceOptions(CLI::App& command, PlaceOptions& options);

// `otherwise`: what the options do not say. Fails for a place outside the world.
base::Result<Scene> placeOf(const PlaceOptions& options, const Scene& otherwise);

}  // namespace terrane::app
