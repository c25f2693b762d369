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
            ->type_name("CHOICE");
    const auto addNumbers = [&](const std::string& name, auto& numbers, std::size_t count,
                                const std::string& form, const std::string& unit, const std::string& help) {
        const auto take = [=, &numbers](const std::string& text) {
            numbers = parseNumbers(text, count, fmt::format("{}: expected {} in {}", name, form, unit));
        };
        return command.add_option_function<std::string>(name, take, help)->type_name(form);
    };
    addNumbers("--at", options.at, 3, "X,Y,Z", "blocks", "Camera position")->excludes(scene);
    addNumbers("--look", options.look, 2, "YAW,PITCH", "degrees",
               "Camera direction; yaw 0 looks along x, 90 along y");
    command.add_option("--time", options.time, "Time of day: 0 midnight, 0.2 dawn, 0.5 noon, 0.8 dusk")
        ->check(numberFrom(0, 1));
}

base::Result<Scene> placeOf(const PlaceOptions& options, const Scene& otherwise) {
    Scene place = options.scene ? *options.scene : otherwise;
    if (options.at) place.camera.position = {(*options.at)[0], (*options.at)[1], (*options.at)[2]};
    if (options.look) {
        place.camera.yaw = static_cast<float>((*options.look)[0]);
        place.camera.pitch = static_cast<float>(std::clamp((*options.look)[1], -90.0, 90.0));
    }
    if (options.time) place.timeDay = *options.time;
    if (!world::isInWorld(render::cameraChunk(place.camera))) return base::fail("--at: outside the world");
    return place;
}

}  // namespace terrane::app
