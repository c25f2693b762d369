// What changes from frame to frame. A plain value.
#pragma once

#include "terrane/render/camera.h"
#include "terrane/world/environment.h"

namespace terrane::render {

enum class View : std::uint8_t { Color, Normal, Depth, Aggregation, Light };

struct FrameInput {
    Camera camera;
    world::Environment environment;
    float fogDistance = 256;  // blocks: from here on everything is sky
    float timeSeconds = 0;    // for animations
    View view = View::Color;
    bool isUnderWater = false;
};

}  // namespace terrane::render
