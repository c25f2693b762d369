#include "apps/terrane/place_options.h"

#include <algorithm>

#include "apps/terrane/options.h"

namespace terrane::app {
namespace {

std::string sceneNames() {
    std::string names;
    for (const Scene& scene : scenes()) names += (names.empty() ? "" : ", ") + std::string(scene.name);
    return names;
}

const Scene* sceneNamed(const std::string& name) {
    const Scene* found = findScene(name);
    if (found) return found;
    throw CLI::ValidationError("--scene", fmt::format("expected one of {}, got \"{}\"", sceneNames(), name));
}

}  // namespace

void addPlaceOptions(CLI::App& command, PlaceOptions& options) {
    auto* scene =
        command
            .add_option_function<std::string>(
                "--scene", [&options](const std::string& name) { options.scene = sceneNamed(name); },
                "A reference scene: " + sceneNames())
            ->type_name("WORD");
    command
        .add_option_function<std::string>(
            "--at",
            [&options](const std::string& text) {
                options.at = parseNumbers(text, 3, "--at: expected X,Y,Z in blocks");
            },
            "Camera position")
        ->type_name("X,Y,Z")
        ->excludes(scene);
    command
        .add_option_function<std::string>(
            "--look",
            [&options](const std::string& text) {
                options.look = parseNumbers(text, 2, "--look: expected YAW,PITCH in degrees");
            },
            "Camera direction; yaw 0 looks along x, 90 along y")
        ->type_name("YAW,PITCH");
    command.add_option("--time", options.time, "Time of day: 0 midnight, 0.2 dawn, 0.5 noon, 0.8 dusk")
        ->check(numberFrom(0, 1));
}

base::Result<Scene> placeOf(const PlaceOptions& options, const Scene& otherwise) {
    Scene place = options.scene ? *options.scene : otherwise;
    if (options.at) place.camera = {{(*options.at)[0], (*options.at)[1], (*options.at)[2]}, 0, 0};
    if (options.look) {
        place.camera.yaw = static_cast<float>((*options.look)[0]);
        place.camera.pitch = static_cast<float>(std::clamp((*options.look)[1], -90.0, 90.0));
    }
    if (options.time) place.timeDay = *options.time;
    if (!world::isInWorld(render::cameraChunk(place.camera))) return base::fail("--at: outside the world");
    return place;
}

}  // namespace terrane::app
