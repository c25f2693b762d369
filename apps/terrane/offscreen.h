// A world and what draws it, without a window: what render, record and fly begin with.
#pragma once

#include <memory>

#include "apps/terrane/world_session.h"
#include "terrane/gpu/context.h"
#include "terrane/gpu/device_info.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/render/renderer.h"

namespace terrane::app {

// The parts refer to each other by address: made in place, destroyed in reverse order. Used on the thread
// that made it.
struct Offscreen {
    // With the options' size, quality, view distance and mesher set up.
    static base::Result<std::unique_ptr<Offscreen>> create(
        const WorldOptions& world, const SaveOptions& save, const GraphicsOptions& graphics,
        store::WorldAccess access = store::WorldAccess::ReadWriteOrMemory);

    // Fails where the graphics driver reported errors.
    base::Result<void> finish() const;

    std::unique_ptr<WorldSession> session;
    gpu::HeadlessContext context;
    gpu::ShaderLoader shaders;
    gpu::DeviceInfo device;
    render::Renderer renderer;
};

}  // namespace terrane::app
