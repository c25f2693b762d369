#include "apps/terrane/graphics_options.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "apps/terrane/options.h"

namespace terrane::app {

namespace {

constexpr int kMaxImageSide = 16384;

void addGraphicsChoices(CLI::App& command, render::GraphicsChoices& choices, std::string preset) {
    choices.preset = std::move(preset);
    command
        .add_option("--preset", choices.preset,
                    "Graphics options together, changed by the flags that follow: " + render::presetNames())
        ->check(render::presetNameError)
        ->type_name("CHOICE")
        ->capture_default_str();
    for (std::size_t k = 0; k < render::graphicsTable().size(); ++k) {
        const render::GraphicsRow& row = render::graphicsTable()[k];
        const std::string flag = "--" + std::string(row.name), words = render::valueNamesOf(row);
        const auto take = [&choices, k, flag](const std::string& text) {
            const render::GraphicsRow& chosen = render::graphicsTable()[k];
            const auto choice = render::choiceOf(chosen, text);
            const std::vector<std::string> names(chosen.valueNames.begin(), chosen.valueNames.end());
            if (!choice) throw CLI::ValidationError(flag, base::expectedOneOf(names, text));
            choices.changed.emplace_back(k, *choice);
        };
        command.add_option_function<std::string>(flag, take, std::string(row.description) + ": " + words)
            ->type_name("CHOICE");
    }
}

}  // namespace

glm::ivec2 parseSize(const std::string& text) {
    int width = 0, height = 0;
    const char* end = text.data() + text.size();
    const auto x = std::from_chars(text.data(), end, width);
    const bool hasCross = x.ec == std::errc() && x.ptr != end && *x.ptr == 'x';
    const auto y = hasCross ? std::from_chars(x.ptr + 1, end, height) : x;
    const bool isGood = hasCross && y.ec == std::errc() && y.ptr == end;
    if (!isGood || width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide) {
        throw CLI::ValidationError(
            "--size",
            fmt::format("expected WIDTHxHEIGHT with sides of 1 to {}, got \"{}\"", kMaxImageSide, text));
    }
    return {width, height};
}

void addGpuMemoryOption(CLI::App& command, std::optional<int>& mebibytes) {
    command
        .add_option(
            "--gpu-memory", mebibytes,
            "Limit of memory on the graphics card in MiB; the view distance shrinks to stay within it")
        ->check(numberFrom(16, 1 << 20))
        ->type_name("MIB")
        ->default_str("half of the free memory; 2048 if the driver does not report it");
}

void addGraphicsOptions(CLI::App& command, GraphicsOptions& options, std::string preset) {
    command
        .add_option_function<std::string>(
            "--size", [&](const std::string& text) { options.size = parseSize(text); },
            "Image size in pixels")
        ->type_name("WxH")
        ->default_str("1280x720");
    command.add_option("--view-distance", options.choices.viewDistance, "View distance in chunks")
        ->check(numberFrom(1, render::kMaxViewDistance))
        ->default_str("16, thesis 32");
    addGpuMemoryOption(command, options.gpuMemory);
    addGraphicsChoices(command, options.choices, std::move(preset));
    addChoice<render::View>(command, "--view", options.view, {viewNames().begin(), viewNames().end()},
                            "Content of the image");
    addResourcePackOption(command, options.resourcePack);
    command
        .add_option("--shader-root", options.shaderRoot, "Source tree to read shaders from, for development")
        ->check(existingFolder())
        ->type_name("DIR");
    command.add_flag("--debug-gl", options.debugGl, "Report errors of the graphics driver");
}

EnumNames<render::View> viewNames() {
    using render::View;
    static const std::array<std::pair<std::string, View>, 5> words = {{{"color", View::Color},
                                                                       {"normal", View::Normal},
                                                                       {"depth", View::Depth},
                                                                       {"merging", View::Merging},
                                                                       {"light", View::Light}}};
    return words;
}

namespace {

std::vector<std::string> sceneNames() {
    std::vector<std::string> names;
    for (const content::Scene& scene : content::scenes()) names.emplace_back(scene.name);
    return names;
}

const content::Scene* sceneNamed(const std::string& name) {
    const content::Scene* found = content::findScene(name);
    if (found) return found;
    throw CLI::ValidationError("--scene", base::expectedOneOf(sceneNames(), name));
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
        ->default_str(fmt::format("{}, {} with --scene", io::WorldOptions::kDefaultGenerator,
                                  content::kSceneGenerator));
}

io::WorldOptions worldOf(const PlaceOptions& place, io::WorldOptions world) {
    if (place.scene) world.otherwise = content::kSceneGenerator;
    return world;
}

}  // namespace terrane::app
