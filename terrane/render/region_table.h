// What the GPU must know to cull and draw the regions of the chunks: a record each, and their order from the
// camera outward. Used by the renderer on the context's thread, beside QuadStore.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "terrane/gpu/buffer.h"
#include "terrane/render/camera.h"
#include "terrane/render/quad_store.h"
#include "terrane/render/region_order.h"
#include "terrane/shared/bindings.h"
#include "terrane/shared/region.h"

namespace terrane::render {

class RegionTable {
  public:
    RegionTable();

    // Of `regions`, which are all that the chunk has in the QuadStore (none: it is removed), those in
    // `changed` are others than before.
    void set(world::ChunkPos pos, std::span<const mesh::RegionMesh> regions,
             mesh::RegionSet changed = mesh::kAllRegions);
    void remove(world::ChunkPos pos);

    // Sends what changed to the GPU and sorts the regions by their distance from the chunk, nearest first.
    // Does nothing where neither the regions nor the chunk are others than at the last call.
    void update(world::ChunkPos centre);

    void bindRecords() const { records_.bindStorage(shared::kRegionsBinding); }
    const gpu::Buffer& records() const { return records_; }  // shared::RegionRecord by slot
    void bindOrder() const { orderBuffer_.bindStorage(shared::kRegionOrderBinding); }

    // Regions that have quads; the order has as many entries.
    std::uint32_t count() const { return count_; }
    // Slots of records, free ones included.
    std::uint32_t slots() const { return static_cast<std::uint32_t>(cpuRecords_.size()); }
    // Most commands that drawing all faces of a context can take.
    const std::array<std::uint32_t, shared::kFaceContexts>& mostCommands() const { return mostCommands_; }
    // Whether a region within the planes has blended faces. The planes are in blocks from the corner of the
    // chunk `centre`.
    bool hasBlended(world::ChunkPos centre, std::span<const glm::vec4> planes) const;

  private:
    static constexpr std::uint32_t kNoSlot = UINT32_MAX;

    std::uint32_t allocateSlot();
    void setRegion(std::uint32_t& slot, const shared::RegionRecord& record);
    void addCommands(const shared::RegionRecord& record, std::int32_t sign);
    void uploadRecords();
    void uploadOrder();

    // Slots by region, kNoSlot where it has no quads.
    std::unordered_map<world::ChunkPos, std::vector<std::uint32_t>, world::ChunkPosHash> chunks_;
    std::vector<shared::RegionRecord> cpuRecords_;
    std::vector<std::uint32_t> free_, changed_, blended_;  // slots
    std::array<std::uint32_t, shared::kFaceContexts> mostCommands_{};
    std::uint32_t count_ = 0;
    RegionOrder order_;
    gpu::Buffer records_, orderBuffer_;
};

}  // namespace terrane::render
