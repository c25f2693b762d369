#include "apps/terrane/place_options.h"

#include <algorithm>

#include "apps/terrane/options.h"

namespace terrane::app {
namespace {

std::vector<std::string> sceneNames() {
    std::vector<std::string> names;
    for (const content::Scene& scene : content::scenes()) names.emplace_back(scene.name);
    return names;
}

const content::Scene* sceneNamed(const std::string& name) {
    const content::Scene* found = content::findScene(name);
    if (found) return found;
    throw CLI::ValidationError("--scene", base::notOneOf(sceneNames(), name));
}

}  // namespace

void addPlaceOptions(CLI::App& command, PlaceOptions& options) {
    auto* scene =
        command
            .add_option_function<std::string>(
                "--scene", [&options](const std::string& name) { options.scene = sceneNamed(name); },
                fmt::format("A reference scene: {}", fmt::join(sceneNames(), ", ")))
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

base::Result<content::Scene> placeOf(const PlaceOptions& options, const content::Scene& otherwise) {
    content::Scene place = options.scene ? *options.scene : otherwise;
    if (options.at) place.pose.position = {(*options.at)[0], (*options.at)[1], (*options.at)[2]};
    if (options.look) {
        place.pose.yaw = static_cast<float>((*options.look)[0]);
        place.pose.pitch = static_cast<float>(std::clamp((*options.look)[1], -90.0, 90.0));
    }
    if (options.time) place.timeDay = *options.time;
    if (!world::isInWorld(world::chunkOf(place.pose.position))) return base::fail("--at: outside the world");
    return place;
}

void nameSceneGenerator(CLI::App& command) {
    command.get_option("--generator")
        ->default_str(
            fmt::format("{}, {} with --scene", WorldOptions::kDefaultGenerator, content::kSceneGenerator));
}

WorldOptions worldOf(const PlaceOptions& place, WorldOptions world) {
    if (place.scene) world.otherwise = content::kSceneGenerator;
    return world;
}

}  // namespace terrane::app
