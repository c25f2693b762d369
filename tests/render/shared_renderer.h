// One renderer for the tests of a process: creating it takes longer than most of them. Needs the context of
// GlTest.
#pragma once

#include <map>
#include <stdexcept>
#include <utility>

#include "terrane/render/frame/renderer.h"
#include "tests/render/content.h"

namespace terrane::render {

// Without chunks and tiles, as after Renderer::create(); not configured. Renderers differ by device. Lives as
// long as the process: drivers may be gone when static objects are destroyed.
inline Renderer& emptyRenderer(const gpu::DeviceInfo& device) {
    static auto* const made = new std::map<std::pair<bool, int>, Renderer>;
    const std::pair key(device.software, device.subpixelBits);
    if (!made->contains(key)) {
        auto renderer = Renderer::create(contentShaders(), contentBlocks(), contentTexture, device);
        if (!renderer) throw std::runtime_error(renderer.error().message);
        made->emplace(key, *std::move(renderer));
    }
    Renderer& renderer = made->at(key);
    for (const auto& done : {renderer.useTint(false), renderer.useLand(false)})
        if (!done) throw std::runtime_error(done.error().message);
    renderer.setHeights({});
    renderer.setMemoryBudget(SIZE_MAX);  // removes all chunks
    renderer.setViewDistance(16);
    return renderer;
}

}  // namespace terrane::render
