// The figures of a frame as shaders read them. A pure function; any thread.
#pragma once

#include <span>
#include <vector>

#include "terrane/render/camera.h"
#include "terrane/shared/figure.h"
#include "terrane/world/figure.h"

namespace terrane::render {

// Those that the planes (in the frame's positions) leave in, that are nearer than `farBlocks` and not where
// the camera is; the nearest kMostFigures of them.
std::vector<shared::FigureRecord> figureRecords(std::span<const world::Figure> figures, const Camera& camera,
                                                std::span<const glm::vec4> planes, double farBlocks);

}  // namespace terrane::render
