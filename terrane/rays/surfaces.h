// The surfaces along a ray: faces of cubes, plants, liquids and models in the order in which the ray passes
// them, as meshes show them (mesh/cell_faces.h), without meshes. Any number of threads may call it while
// nobody changes the scene or the chunks.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "terrane/mesh/cell_faces.h"
#include "terrane/rays/scene.h"

namespace terrane::rays {

struct Surface {
    world::ChunkPos tile;  // the chunk or tile, and the index of the block in it
    world::BlockIndex block = 0;
    mesh::CellFace face;
    float t = 0;
    glm::vec2 texel{0};   // texture coordinates from the upper left corner, 0 to 1
    bool isFront = true;  // else the ray meets the back of a two-sided face
};

struct SurfaceScene {
    shared::RayWords cells;  // of blocks of all shapes: drawnBlocks()
    // The chunk or tile that the scene has at a position; null if there is none.
    std::function<const world::Chunk*(world::ChunkPos)> chunkAt;
    const world::BlockRegistry* blocks = nullptr;     // of chunks
    const world::BlockRegistry* farBlocks = nullptr;  // of tiles: blocks->forFarTiles()
    std::vector<shared::ShapeFace> shapeFaces;        // mesh::shapeFaces(*blocks)
};

// The blocks that surfaces are looked for in: all that have a shape.
StopTable drawnBlocks(const world::BlockRegistry& blocks);

// Calls use(surface) for each surface that the ray meets, the nearest first, until it returns true. Opaque
// cubes end a ray; what else ends it, such as a texel that is no hole, is up to `use`. Backs of one-sided
// faces are passed. A ray that begins in an opaque cube meets nothing. t equals shared::castRay() to the bit
// where a ray enters a cube; inside of cells it is computed in double.
void forEachSurface(const SurfaceScene& scene, const shared::Ray& ray,
                    const std::function<bool(const Surface&)>& use);

}  // namespace terrane::rays
