// Records of the chunks' mesh sections for culling and drawing on the GPU, and their order from the camera
// outward. The renderer uses it on the context's thread, beside QuadStore.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "terrane/gpu/buffer.h"
#include "terrane/render/cull/screen_rect.h"
#include "terrane/render/frame/camera.h"
#include "terrane/render/quads/mesh_section_order.h"
#include "terrane/render/quads/quad_store.h"
#include "terrane/render/shadow/shadow_clipmap.h"
#include "terrane/shared/bindings.h"
#include "terrane/shared/mesh_section.h"

namespace terrane::render {

class MeshSectionTable {
  public:
    // `arenaQuads`: addresses of an arena, as QuadStore has them.
    explicit MeshSectionTable(std::uint32_t arenaQuads = UINT32_MAX);

    // Sets the mesh sections of a chunk. `meshSections`: all that it has in the QuadStore (none removes it).
    // `changed`: those that may differ from before.
    void set(world::ChunkPos pos, std::span<const mesh::MeshSection> meshSections,
             const mesh::MeshSectionSet& changed = mesh::kAllMeshSections);
    void remove(world::ChunkPos pos);

    // Uploads changed records and sorts the mesh sections by their distance from the chunk, nearest first.
    // Does nothing if neither the mesh sections nor the chunk have changed since the last call.
    void update(world::ChunkPos center);

    void bindRecords() const { records_.bindStorage(shared::kMeshSectionsBinding); }
    const gpu::Buffer& records() const { return records_; }  // shared::MeshSectionRecord by slot
    void bindOrder() const { orderBuffer_.bindStorage(shared::kMeshSectionOrderBinding); }

    // Returns the slots in their order, nearest first.
    const std::vector<std::uint32_t>& order() const { return order_.slots(); }
    // Returns the records by slot; heights are 0 if the slot is free, and only then.
    std::span<const shared::MeshSectionRecord> slotRecords() const { return cpuRecords_; }
    // Returns the boxes of mesh sections that were replaced, removed or added since the last call, before and
    // after the change.
    std::vector<CasterBox> takeChanges() { return std::exchange(changes_, {}); }

    // Returns the number of mesh sections that have quads, and of entries in the order.
    std::uint32_t count() const { return count_; }
    // Returns the number of slots, free ones included.
    std::uint32_t slots() const { return static_cast<std::uint32_t>(cpuRecords_.size()); }
    // Most commands that drawing all faces of a draw bucket can take, by arena. There is at least one arena.
    const std::vector<BucketCommands>& maxCommands() const { return maxCommands_; }
    std::uint32_t arenaQuads() const { return arenaQuads_; }
    // Returns the GPU memory as of the next update(), including buffers that it replaces.
    std::size_t gpuBytes() const;
    // Returns the rectangles without overlap that contain all pixels of an image of `size` that blended faces
    // may cover, waves included; none if no mesh section in view has any. `viewProjection`: from blocks from
    // the corner of the chunk `center`.
    std::vector<ScreenRect> blendedRects(world::ChunkPos center, const glm::mat4& viewProjection,
                                         glm::ivec2 size) const;

  private:
    // A mesh section with quads.
    struct Slot {
        int bottom;  // its lowest layer
        std::uint32_t number;
    };

    std::uint32_t allocateSlot();
    void fill(std::uint32_t slot, const shared::MeshSectionRecord& record);
    void clear(std::uint32_t slot);
    void free(std::uint32_t slot);
    void addCommands(const shared::MeshSectionRecord& record, std::int32_t sign);
    void uploadRecords();
    void uploadOrder();

    // Lowest first.
    std::unordered_map<world::ChunkPos, std::vector<Slot>, world::ChunkPosHash> chunks_;
    std::vector<shared::MeshSectionRecord> cpuRecords_;
    std::vector<std::uint32_t> free_, changed_, blended_;  // slots
    std::vector<CasterBox> changes_;
    std::uint32_t arenaQuads_;
    std::vector<BucketCommands> maxCommands_{1};
    std::uint32_t count_ = 0;
    MeshSectionOrder order_;
    gpu::Buffer records_, orderBuffer_;
};

}  // namespace terrane::render
