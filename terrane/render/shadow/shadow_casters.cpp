#include "terrane/render/shadow/shadow_casters.h"

#include <algorithm>

namespace terrane::render {
namespace {

class CasterWriter {
  public:
    CasterWriter(std::vector<CasterList>& lists, std::uint32_t arenaQuads)
        : lists_(lists), arenaQuads_(arenaQuads) {}

    // Contiguous ranges share a command.
    void add(const shared::MeshSectionRecord& record, std::uint32_t bucket, glm::uvec2 range) {
        if (range.y == 0) return;
        if (pending_.y > 0 && pending_.x + pending_.y == range.x && bucket == bucket_ && record_ == &record) {
            pending_.y += range.y;
            return;
        }
        flush();
        record_ = &record;
        bucket_ = bucket;
        pending_ = range;
    }
    void flush() {
        if (pending_.y == 0) return;
        const std::uint32_t arena = pending_.x / arenaQuads_;
        lists_.resize(std::max<std::size_t>(lists_.size(), (arena + 1) * std::size_t{kCasterBuckets}));
        CasterList& list = lists_[arena * std::size_t{kCasterBuckets} + bucket_];
        list.quads += pending_.y;
        for (std::uint32_t first = pending_.x - arena * arenaQuads_; pending_.y > 0;) {
            const std::uint32_t part = std::min(pending_.y, shared::kMaxQuadsPerCommand);
            const auto number = static_cast<std::uint32_t>(list.commands.size());
            list.commands.push_back({6 * part, 1, 0, 0, number});
            list.records.push_back({record_->chunk, record_->place, first});
            first += part;
            pending_.y -= part;
        }
    }

  private:
    std::vector<CasterList>& lists_;
    std::uint32_t arenaQuads_;
    const shared::MeshSectionRecord* record_ = nullptr;
    std::uint32_t bucket_ = 0;
    glm::uvec2 pending_{0};
};

void addCasters(CasterWriter& writer, const shared::MeshSectionRecord& record, glm::vec3 light) {
    for (std::uint32_t bucket = 0; bucket < kCasterBuckets; ++bucket) {
        const bool isTwoSided = mesh::bucketTwoSided(static_cast<int>(bucket));
        const std::uint32_t count = isTwoSided ? 1 : shared::kFaceDirections;
        for (std::uint32_t k = 0; k < count; ++k) {
            const int direction = isTwoSided ? mesh::kAnyDirection : static_cast<int>(k);
            if (facesLight(direction, light))
                writer.add(record, bucket, record.ranges[shared::firstRange(bucket) + k]);
        }
    }
    writer.flush();
}

}  // namespace

CasterBox casterBoxOf(const shared::MeshSectionRecord& record) {
    return {{record.chunk.x, record.chunk.y, static_cast<std::uint8_t>(shared::placeLevel(record.place))},
            shared::lowHeight(record.heights),
            shared::highHeight(record.heights)};
}

bool facesLight(int direction, glm::vec3 light) {
    if (direction == mesh::kAnyDirection) return true;
    const float along = light[direction / 2];
    return direction % 2 == 0 ? along < 0 : along > 0;
}

std::vector<CasterList> castersOf(const ShadowTiles& tiles,
                                  std::span<const shared::MeshSectionRecord> records,
                                  std::uint32_t arenaQuads) {
    const double blocks = shadowTileBlocks(tiles.cascade);
    const glm::dvec2 min = glm::dvec2(tiles.place) * blocks, max = min + glm::dvec2(tiles.size) * blocks;
    const glm::dmat3 axes = glm::transpose(tiles.plane.toLight);
    std::vector<CasterList> lists;
    CasterWriter writer(lists, arenaQuads);
    for (const shared::MeshSectionRecord& record : records) {
        if (record.heights == 0) continue;
        const PlaneBox box = onPlane(tiles.plane, casterBoxOf(record));
        if (box.min.x > max.x || box.max.x < min.x || box.min.y > max.y || box.max.y < min.y) continue;
        addCasters(writer, record, glm::vec3(axes[2]));
    }
    return lists;
}

}  // namespace terrane::render
