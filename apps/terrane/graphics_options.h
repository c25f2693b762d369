// Options of commands that draw.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "apps/terrane/option_values.h"
#include "terrane/render/frame_input.h"
#include "terrane/render/graphics_table.h"

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
