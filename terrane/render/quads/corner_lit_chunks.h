// The chunks' meshes as the mesher made them, and their light, for Shading::Corners: which mesh sections have
// to be lit again, and their quads with light. The renderer uses it on the context's thread.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "terrane/mesh/remesh.h"
#include "terrane/render/quads/corner_light.h"
#include "terrane/world/coords.h"

namespace terrane::render {

class CornerLitChunks {
  public:
    static constexpr int kPerFrame = 16;  // 2 ms

    // Replaces these mesh sections of a chunk by those of `mesh`, which has no others.
    void setMesh(world::ChunkPos pos, const mesh::ChunkMesh& mesh,
                 const mesh::MeshSectionSet& meshSections = mesh::kAllMeshSections);
    // `bricks`: those that may differ from the last call.
    void setLight(world::ChunkPos pos, const light::ChunkLight& light, const world::SectionSet& bricks);
    void removeMesh(world::ChunkPos pos);
    void remove(world::ChunkPos pos);

    // Forgets all meshes. Light stays.
    void clearMeshes();

    // Mesh sections of a chunk, with light; `lit` has no others.
    struct Change {
        world::ChunkPos pos;
        mesh::MeshSectionSet meshSections;
        LitMesh lit;
    };
    // Lights what changed since the last call: of one chunk, or of the one whose changes are oldest.
    Change light(world::ChunkPos pos, std::span<const shared::ShapeFace> shapeFaces);
    std::optional<Change> lightNext(std::span<const shared::ShapeFace> shapeFaces);
    // Returns the same change with as few quads as the mesher made.
    Change unsplit(const Change& change, std::span<const shared::ShapeFace> shapeFaces) const;
    // Returns the mesh of a chunk as it was set; null if there is none.
    const mesh::ChunkMesh* meshOf(world::ChunkPos pos) const;

  private:
    struct Chunk {
        mesh::ChunkMesh mesh;
        std::optional<light::ChunkLight> light;
        mesh::MeshSectionSet changed;
    };

    void markChanged(world::ChunkPos pos, const mesh::MeshSectionSet& meshSections);
    void markAround(world::ChunkPos pos, const mesh::MeshSectionSet& meshSections);
    LitMesh lit(world::ChunkPos pos, const mesh::MeshSectionSet& meshSections,
                std::span<const shared::ShapeFace> shapeFaces, Splitting splitting) const;

    std::unordered_map<world::ChunkPos, Chunk, world::ChunkPosHash> chunks_;
    std::deque<world::ChunkPos> changed_;  // some may be gone, or lit again
};

}  // namespace terrane::render
