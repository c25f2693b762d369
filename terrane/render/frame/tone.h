// Tone mapping on the CPU, as tone.glsl does it, for images that shaders have not drawn. Any thread.
#pragma once

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/vec3.hpp>

#include "terrane/base/srgb.h"

namespace terrane::render {

constexpr float kExposure = 0.92f;

// Display color of linear light, 0 to 1.
inline glm::vec3 displayColor(glm::vec3 light) {
    constexpr float kStart = 0.6f;
    glm::vec3 color = light * kExposure;
    const glm::vec3 over = glm::max(color - kStart, 0.0f);
    color = glm::min(color, kStart) + (1 - kStart) * (1.0f - glm::exp(-over / (1 - kStart)));
    color = glm::clamp(color, 0.0f, 1.0f);
    return {base::encodeSrgb(color.x), base::encodeSrgb(color.y), base::encodeSrgb(color.z)};
}

}  // namespace terrane::render
