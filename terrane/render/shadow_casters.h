// The draw commands of what casts shadows into a rectangle of shadow tiles. Pure functions; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrane/mesh/draw_bucket.h"
#include "terrane/render/shadow_clipmap.h"
#include "terrane/shared/mesh_section.h"

namespace terrane::render {

// Opaque and tested quads, one-sided and two-sided.
constexpr int kCasterBuckets = 4;

// Whether faces that look so may be lit. `direction`: see mesh::kAnyDirection.
bool facesLight(int direction, glm::vec3 light);

// Commands of a draw bucket whose quads lie in one arena.
struct CasterList {
    std::vector<shared::DrawCommand> commands;
    std::size_t quads = 0;
};

// By arena × kCasterBuckets + draw bucket, as many arenas as there are quads in: everything in the column
// along the light over the tiles, without face directions that look away from it. `records` by slot, those of
// free slots with heights 0; `arenaQuads`: addresses of an arena.
std::vector<CasterList> castersOf(const ShadowTiles& tiles,
                                  std::span<const shared::MeshSectionRecord> records,
                                  std::uint32_t arenaQuads);

}  // namespace terrane::render
