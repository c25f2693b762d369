// Tells whether the driver draws lists of commands as OpenGL says. Known errors: draws that are lost, base
// instances that are ignored (Intel's old drivers for Windows), counts that are ignored, integers that go
// through a float, a grid of sub-pixels coarser than the driver reports. The program checks once, with its
// context current.
#pragma once

#include <string>

#include "terrane/base/result.h"
#include "terrane/gpu/context.h"
#include "terrane/gpu/shader_loader.h"

namespace terrane::render {

struct DrawCheck {
    bool indirectCount = false;  // lists whose count the GPU wrote are drawn right
    bool indirect = false;       // lists are
    int subpixelBits = 0;        // of the grid, up to 8; more make no difference
    std::string fault;           // for a warning; empty if nothing is wrong
};

// Draws a known pattern, reads it back and compares: 4,096 pixels in 2,047 commands.
base::Result<DrawCheck> checkDraws(const gpu::ShaderLoader& shaders, const gpu::DeviceInfo& device);

// Returns the properties of the current context's driver without those that do not work. Warns of them in
// one line.
gpu::DeviceInfo checkedDevice(const gpu::ShaderLoader& shaders);

}  // namespace terrane::render
