// Options of commands that draw.
#pragma once

#include <glm/vec2.hpp>

#include <optional>
#include <string>
#include <vector>

#include "apps/terrane/options.h"
#include "terrane/base/result.h"
#include "terrane/content/built_in.h"
#include "terrane/render/frame/frame_uniforms.h"
#include "terrane/render/frame/graphics_table.h"

namespace terrane::app {

struct GraphicsOptions {
    glm::ivec2 size{1280, 720};  // pixels
    render::GraphicsChoices choices;
    render::View view = render::View::Color;
    std::string resourcePack;      // folder; empty: none
    std::optional<int> gpuMemory;  // MiB; none: from what the driver reports
    std::string shaderRoot;
    bool debugGl = false;
};

// `preset`: the default of --preset.
void addGraphicsOptions(CLI::App& command, GraphicsOptions& options, std::string preset);

void addGpuMemoryOption(CLI::App& command, std::optional<int>& mebibytes);  // --gpu-memory

// "1280x720", for --size. Throws CLI::ValidationError.
glm::ivec2 parseSize(const std::string& text);

EnumNames<render::View> viewNames();  // --view

}  // namespace terrane::app

// Options for the pose of a camera and the time of day: --scene, --at, --look, --time.
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
io::WorldOptions worldOf(const PlaceOptions& place, io::WorldOptions world);

}  // namespace terrane::app
