// What culling reads, on the GPU and on the CPU. Plain values of a frame.
#pragma once

#include "terrane/gpu/texture.h"
#include "terrane/render/frame/camera.h"
#include "terrane/render/quads/draw_commands.h"
#include "terrane/render/quads/quad_resources.h"
#include "terrane/render/quads/quad_store.h"
#include "terrane/shared/culling.h"

namespace terrane::render {

struct CullInput {
    world::ChunkPos cameraChunk;
    glm::vec3 cameraPosition;  // from the corner of its chunk
    Frustum camera;
    glm::mat4 viewProjection{1};
    glm::vec2 size{1};                    // of the image in pixels
    const gpu::Texture2D* hiZ = nullptr;  // for the late pass
    // With Hi-Z the late pass tests quads, and both passes list those to draw.
    QuadStore* quads = nullptr;
    const QuadResources* resources = nullptr;
    float edgeExpansion = 0;  // pixels that edges of quads move
    float blockPixels = 0;    // pixels of a block, one block ahead
    int samples = 1;          // a pixel
    bool hidesBacks = false;  // RenderOptions::leafBacks
    DrawMethod method = DrawMethod::Indirect;

    shared::CullView view() const {
        shared::CullView view{};
        view.viewProjection = viewProjection;
        view.viewportSize = size;
        view.nearPlane = kNearPlane;
        view.edgeExpansion = edgeExpansion;
        view.blockPixels = blockPixels;
        view.samples = static_cast<shared::uint>(samples);
        view.hiZLevels = hiZ ? hiZ->levels() : 0;
        view.hidesBacks = hidesBacks ? 1 : 0;
        return view;
    }
};

// All: everything in view. Early: everything that was visible in the frame before. Late: everything that the
// depth of the early pass does not hide. Mesh sections first, then their quads: cull_pass.h.
enum class CullPhase : std::uint8_t { All, Early, Late };

}  // namespace terrane::render
