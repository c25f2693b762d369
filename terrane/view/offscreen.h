// A session with its renderer and without a window, to draw images.
#pragma once

#include <glm/vec2.hpp>

#include <memory>
#include <optional>
#include <string>

#include "terrane/base/result.h"
#include "terrane/game/session.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gpu/context.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/render/frame/graphics_table.h"
#include "terrane/render/frame/renderer.h"
#include "terrane/view/gpu_back_ends.h"
#include "terrane/view/world_view.h"
#include "terrane/world/blocks/block_model.h"

namespace terrane::view {

struct OffscreenSettings {
    glm::ivec2 size{1280, 720};  // pixels
    render::GraphicsChoices graphics;
    std::optional<int> gpuMemory = {};  // MiB; none: from what the driver reports
    std::string shaderRoot = {};        // source tree that the renderer's shaders are read from; empty: none
    bool debugGl = false;               // count errors of the graphics driver
    bool usesGpu = false;               // to generate, light and mesh
    double meshMilliseconds = WorldView::kNoLimit;  // GPU time for meshing per frame
};

// The parts refer to each other by address: constructed in place, destroyed in reverse order. Used on the
// thread that made it.
struct Offscreen {
    // Sets up size, quality, view distance and mesher from the settings. `generators` include the world's,
    // and are only read here, as are the textures.
    static base::Result<std::unique_ptr<Offscreen>> create(game::SessionParts parts,
                                                           const gen::GeneratorCatalogue& generators,
                                                           const world::TextureSource& textures,
                                                           const OffscreenSettings& settings);

    // Fails if the graphics driver reported errors.
    base::Result<void> finish() const;

    gpu::HeadlessContext context;
    gpu::ShaderLoader shaders;
    gpu::DeviceInfo device;
    render::GraphicsSettings graphics;      // initial settings
    std::unique_ptr<GpuBackEnds> backEnds;  // null: workers do the work
    std::unique_ptr<game::Session> session;
    render::Renderer renderer;
    std::optional<WorldView> view;
    world::TextureSource textures;
};

}  // namespace terrane::view
