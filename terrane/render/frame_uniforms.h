// Uniforms of a frame from its input and options. Pure; any thread.
#pragma once

#include "terrane/render/frame_input.h"
#include "terrane/render/render_options.h"
#include "terrane/shared/frame.h"

namespace terrane::render {

struct FrameSetup {
    ViewMatrices view;
    glm::vec2 size;           // pixels
    float edgeExpansion = 0;  // pixels
};

// Sets all members but the place in the light grid.
shared::Frame frameUniforms(const FrameInput& input, const RenderOptions& options, const FrameSetup& setup);

}  // namespace terrane::render
