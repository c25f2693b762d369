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

// Appends the visible faces of a block of a chunk or tile of the scene.
void addFacesOf(const SurfaceScene& scene, world::ChunkPos tile, glm::ivec3 inTile,
                std::vector<mesh::CellFace>& faces);

// A ray on its way through a scene. One thread uses it, for one ray after the other, so that the lists keep
// their memory.
struct SurfaceWalk {
    shared::RayPlace place;
    bool isOver = false;            // nothing behind `surfaces`
    bool isEnclosed = false;        // the ray begins in an opaque cube
    std::vector<Surface> surfaces;  // of one block, the nearest first
    std::vector<mesh::CellFace> faces;
};

// Finds the surfaces of the next block on the way that has any; false if there is none. A walk begins with
// the place shared::rayBegin(ray).
bool nextSurfaces(const SurfaceScene& scene, const shared::Ray& ray, SurfaceWalk& walk);

// Calls use(surface) for each surface that the ray meets, the nearest first, until it returns true. Opaque
// cubes end a ray; what else ends it, such as a texel that is no hole, is up to `use`. Backs of one-sided
// faces are passed. A ray that begins in an opaque cube meets nothing. t equals shared::castRay() to the bit
// where a ray enters or leaves a cube; inside of cells it is computed in double.
template <class Use>
void forEachSurface(const SurfaceScene& scene, const shared::Ray& ray, SurfaceWalk& walk, const Use& use) {
    walk.place = shared::rayBegin(ray);
    walk.isOver = walk.isEnclosed = false;
    while (nextSurfaces(scene, ray, walk))
        for (const Surface& surface : walk.surfaces)
            if (use(surface)) return;
}

template <class Use>
void forEachSurface(const SurfaceScene& scene, const shared::Ray& ray, const Use& use) {
    SurfaceWalk walk;
    forEachSurface(scene, ray, walk, use);
}

}  // namespace terrane::rays
