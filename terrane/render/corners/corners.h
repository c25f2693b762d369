// Quads that are shaded at their corners and drawn straight into the image (Shading::Corners).
#pragma once

#include <array>
#include <optional>

#include "terrane/render/frame/frame.h"

namespace terrane::render {

// In air and under water.
struct CornerPrograms {
    std::array<const gpu::Program*, 2> inAirAndWater{};

    const gpu::Program& of(const FrameContext& context) const {
        return *inAirAndWater[context.isUnderWater() ? 1 : 0];
    }
};

// Returns nothing if the options shade otherwise.
base::Result<std::optional<CornerPrograms>> makeCornerPrograms(FrameBuilder& build,
                                                               mesh::AlphaClass alphaClass);

// Blended faces in one pass, without an order: of two faces behind each other the farther one may cover the
// nearer.
MaybePass makeCornerLayers(FrameBuilder& build);

// See corner_sky.cpp.
MaybePass makeCornerSky(FrameBuilder& build);

}  // namespace terrane::render
