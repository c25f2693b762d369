// What options that several commands share say; options.h reads them. Without the parser, which takes long to
// compile.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "apps/terrane/graphics_table.h"
#include "terrane/base/result.h"
#include "terrane/mesh/mesh_options.h"
#include "terrane/render/frame_input.h"
#include "terrane/world/coords.h"

namespace CLI {
class App;
}

namespace terrane::app {

struct WorldOptions {
    std::uint64_t seed = 1;
    std::string generator = "overworld";
    unsigned threads = 0;  // 0: as many as the machine has
};

struct GraphicsOptions {
    glm::ivec2 size{1280, 720};  // pixels
    int viewDistance = 16;       // chunks
    GraphicsChoices choices;
    render::View view = render::View::Color;
    mesh::MeshOptions mesh;
    std::string resourcePack;  // folder; empty: none
    std::string shaderRoot;
    bool debugGl = false;
};

// Chunks x0 … x1 − 1, y0 … y1 − 1.
struct Area {
    std::int32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    std::int64_t chunkCount() const { return (std::int64_t{x1} - x0) * (std::int64_t{y1} - y0); }
};

unsigned threadCount(const WorldOptions& options);

// What an option can be, and what each word means.
template <class T>
using Words = std::span<const std::pair<std::string, T>>;

Words<mesh::Method> aggregationWords();  // --merging
Words<render::View> viewWords();         // --view

}  // namespace terrane::app
