// What a session shows around a camera, as a scene of the path tracer: the same chunks and tiles, the same
// sky and air as the rasterizer draws.
#pragma once

#include <memory>

#include "terrane/base/image.h"
#include "terrane/base/result.h"
#include "terrane/path/denoise.h"
#include "terrane/path/film.h"
#include "terrane/path/scene.h"
#include "terrane/view/offscreen.h"

namespace terrane::view {

// Returns the blocks of a chunk or tile down to the bottom of the world, as they are saved or generated.
world::Chunk wholeChunk(game::Session& session, world::ChunkPos pos);

// Makes the scene of what `world` shows after loadAll(), for this camera. Fails if a texture cannot be read.
base::Result<std::unique_ptr<path::Scene>> makePathScene(Offscreen& world, const render::FrameInput& input);

struct Lens {
    float radius = 0;  // blocks
    float focus = 16;  // blocks
};
path::Camera pathCameraOf(const render::FrameInput& input, glm::ivec2 size, const Lens& lens);

// The image with the rasterizer's exposure (FrameInput) and tone curve.
base::Image displayedImage(const path::Means& means, glm::vec3 exposure);

}  // namespace terrane::view
