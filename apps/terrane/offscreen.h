// A world with its renderer and without a window, for render, record and flight-bench.
#pragma once

#include <memory>
#include <optional>

#include "apps/terrane/back_ends.h"
#include "apps/terrane/graphics_options.h"
#include "terrane/gpu/context.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/io/open_session.h"
#include "terrane/render/frame/renderer.h"
#include "terrane/view/gpu_back_ends.h"
#include "terrane/view/world_view.h"

namespace terrane::app {

struct OffscreenOptions {
    io::WorldOptions world;
    io::SaveOptions save;
    GraphicsOptions graphics;
    Backend backend = Backend::Cpu;
    store::WorldAccess access = store::WorldAccess::ReadOnly;
    double meshMilliseconds = view::WorldView::kNoLimit;  // GPU time for meshing per frame
};

// The parts refer to each other by address: constructed in place, destroyed in reverse order. Used on the
// thread that made it.
struct Offscreen {
    // Sets up size, quality, view distance and mesher from the options.
    static base::Result<std::unique_ptr<Offscreen>> create(const OffscreenOptions& options);

    // Fails if the graphics driver reported errors.
    base::Result<void> finish() const;

    gpu::HeadlessContext context;
    gpu::ShaderLoader shaders;
    gpu::DeviceInfo device;
    render::GraphicsSettings graphics;            // initial settings
    std::unique_ptr<view::GpuBackEnds> backEnds;  // null: workers do the work
    std::unique_ptr<game::Session> session;
    render::Renderer renderer;
    std::optional<view::WorldView> view;
};

}  // namespace terrane::app
