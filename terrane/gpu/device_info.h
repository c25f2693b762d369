// Properties and limits of the driver of the current context. Queried once after a context is made, on its
// thread.
#pragma once

#include <cstdint>
#include <string>

#include "terrane/base/result.h"

namespace terrane::gpu {

struct DeviceInfo {
    std::string vendor;
    std::string renderer;
    std::string version;
    std::string glsl;
    bool software = false;       // drawn by the CPU: the CPU back ends are faster then
    bool indirectCount = false;  // glMultiDraw*IndirectCount: draw counts written by the GPU
    int maxSamples = 0;          // of color and depth textures that are drawn into
    int maxTextureSize = 0;
    int maxTexture3dSize = 0;
    int maxArrayLayers = 0;
    float maxAnisotropy = 1.0F;  // 1: not offered
    int subpixelBits = 4;        // a pixel is 2^bits steps of the grid that the rasterizer moves corners to
    std::int64_t maxStorageBlockBytes = 0;
    std::int64_t videoMemoryBytes = 0;  // free on the graphics card when queried; 0: unknown
};

[[nodiscard]] DeviceInfo queryDevice();

// One line naming the first thing the current context lacks.
[[nodiscard]] base::Result<void> checkRequirements();

}  // namespace terrane::gpu
