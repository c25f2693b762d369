// Inputs of shaders that light surfaces and layers, besides the G-buffer and the frame's uniforms. Used by
// the renderer on the context's thread.
#pragma once

#include "terrane/render/light_store.h"
#include "terrane/render/shadow_map.h"
#include "terrane/render/sky_noise.h"

namespace terrane::render {

// Defines of these shaders for light.
struct LightVariant {
    int shadowVariant = 0;   // SHADOW of shadow_sample.glsl; 0: none
    bool knowsLand = false;  // LAND of land_light.glsl
};

struct ShadingInputs {
    const LightStore& light;
    const ShadowMap& shadowMap;
    const SkyNoise& noise;
    bool isUnderWater = false;  // the camera; shaders have variants for it

    void bind() const {
        light.bind();
        if (shadowMap.isOn()) shadowMap.bind();
        noise.bind();
    }
};

}  // namespace terrane::render
