// Uniforms of a frame from its input and options. It is pure; any thread may call it.
#pragma once

#include <climits>
#include <optional>
#include <span>

#include "terrane/render/frame/camera.h"
#include "terrane/render/frame/render_options.h"
#include "terrane/render/shadow/shadow_clipmap.h"
#include "terrane/shared/frame.h"
#include "terrane/world/pose.h"
#include "terrane/world/sky/environment.h"

namespace terrane::render {

// Input that changes from frame to frame. It is a plain value.
enum class View : std::uint8_t { Color, Normal, Depth, Merging, Light };

struct FrameInput {
    Camera camera;
    world::Environment environment;
    float fogDistance = 256;  // blocks at which the fog is complete
    float timeSeconds = 0;    // for animations
    View view = View::Color;
    int waterAbove = 0;  // blocks of water over the camera, its own included; 0 in air
    // Most shadow tiles to draw; others follow in later frames. Single images draw all.
    std::size_t maxShadowTiles = ShadowClipmap::kAllTiles;
    // Chunks whose changed light reaches quads that are shaded at corners in this frame; others follow.
    int maxLitChunks = INT_MAX;
    // The frame draws only the mesh sections in view of this camera, without occlusion culling, to show
    // culling from outside. It is in the same chunk as `camera`.
    std::optional<Camera> cullingCamera = std::nullopt;
    // Other players; may include figures out of view.
    std::span<const world::Figure> figures = {};
    glm::vec3 exposure{1};  // of an adapted eye (view/eye.h), by color; 1 by day
};

struct FrameSetup {
    ViewMatrices view;
    glm::vec2 size;           // pixels
    float edgeExpansion = 0;  // pixels
};

// Sets all members except the position in the light grid.
shared::Frame frameUniforms(const FrameInput& input, const RenderOptions& options, const FrameSetup& setup);

}  // namespace terrane::render
