// What shaders that light surfaces and layers read besides the G-buffer and the frame's uniforms. Used by the
// renderer on the context's thread.
#pragma once

#include "terrane/render/light_store.h"
#include "terrane/render/shadow_map.h"
#include "terrane/render/sky_noise.h"

namespace terrane::render {

struct ShadingInputs {
    const LightStore& light;
    const ShadowMap& shadowMap;  // of size 0 where there are no shadows
    const SkyNoise& noise;
    bool isUnderWater = false;  // where the camera is: shaders have variants for it

    void bind() const {
        light.bind();
        if (shadowMap.size() > 0) shadowMap.bind();
        noise.bind();
    }
};

}  // namespace terrane::render
