// Records of the figures of a frame for shaders. A pure function; any thread.
#pragma once

#include <span>
#include <vector>

#include "terrane/render/camera.h"
#include "terrane/shared/figure.h"
#include "terrane/world/figure.h"

namespace terrane::render {

// Box of a figure around its feet, in blocks: legs and arms swing out of the box of the player, hair is above
// it.
constexpr glm::vec3 kFigureLow{-1, -1, -0.2f}, kFigureHigh{1, 1, 2.2f};

// Returns the figures inside the planes (in positions of the frame) that are nearer than `farBlocks` and not
// around the camera; the nearest kMostFigures of them.
std::vector<shared::FigureRecord> figureRecords(std::span<const world::Figure> figures, const Camera& camera,
                                                std::span<const glm::vec4> planes, double farBlocks);

}  // namespace terrane::render
