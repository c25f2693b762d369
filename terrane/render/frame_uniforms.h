// The uniforms of a frame from what the program wants to see. Pure; any thread.
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

// All but the place in the light grid.
shared::Frame frameUniforms(const FrameInput& input, const RenderOptions& options, const FrameSetup& setup);

}  // namespace terrane::render
