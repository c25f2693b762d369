// Options for the pose of a camera and the time of day: --scene, --at, --look, --time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/terrane/option_values.h"
#include "terrane/base/result.h"
#include "terrane/content/scenes.h"

namespace CLI {
class App;
}

namespace terrane::app {

struct PlaceOptions {
    const content::Scene* scene = nullptr;
    std::optional<std::vector<double>> at, look;  // X, Y, Z in blocks; yaw, pitch in degrees
    std::optional<float> time;                    // of day, 0…1
};

void addPlaceOptions(CLI::App& command, PlaceOptions& options);

// `otherwise` is used for values without an option. Fails for a position outside the world.
base::Result<content::Scene> placeOf(const PlaceOptions& options, const content::Scene& otherwise);

// With --scene the default generator is the scene's; the help of --generator says so.
void nameSceneGenerator(CLI::App& command);
WorldOptions worldOf(const PlaceOptions& place, WorldOptions world);

}  // namespace terrane::app
