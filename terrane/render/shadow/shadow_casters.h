// The draw commands of the casters of a rectangle of shadow tiles. All functions are pure; any thread may
// call them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrane/mesh/draw_bucket.h"
#include "terrane/render/shadow/shadow_clipmap.h"
#include "terrane/shared/mesh_section.h"

namespace terrane::render {

CasterBox casterBoxOf(const shared::MeshSectionRecord& record);

// Opaque and tested quads, one-sided and two-sided.
constexpr int kCasterBuckets = 4;

// Returns whether faces of a direction may be lit. `direction`: see mesh::kAnyDirection.
bool facesLight(int direction, glm::vec3 light);

// Commands of a draw bucket whose quads lie in one arena, each with its record. Base instances count from 0.
struct CasterList {
    std::vector<shared::DrawCommand> commands;
    std::vector<shared::DrawRecord> records;
    std::size_t quads = 0;
};

// Returns lists by arena × kCasterBuckets + draw bucket, for all arenas with quads: everything in the column
// along the light over the tiles, without face directions that face away from it. `records`: by slot, with
// heights 0 for free slots; `arenaQuads`: addresses of an arena.
std::vector<CasterList> castersOf(const ShadowTiles& tiles,
                                  std::span<const shared::MeshSectionRecord> records,
                                  std::uint32_t arenaQuads);

}  // namespace terrane::render
