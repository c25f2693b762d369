// An area of chunks whose light is kept up to date by relight, and random edits of it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "terrane/light/relight.h"
#include "tests/light/test_area.h"

namespace terrane::light {

// A lit area in the world, its corner chunk at `corner`. Nothing is known around it.
class LitArea {
  public:
    LitArea(TestArea area, world::ChunkPos corner) : area_(std::move(area)), corner_(corner) {
        const std::vector<ChunkLight> lights = area_.lights();
        for (std::size_t k = 0; k < lights.size(); ++k)
            chunks_[posOf(k)] = {std::make_shared<world::Chunk>(area_.chunks[k]),
                                 std::make_shared<ChunkLight>(lights[k])};
    }

    // x and y count from the area's corner.
    void set(int x, int y, int z, world::BlockId id) {
        const world::BlockPos pos{corner_.x * world::kChunkSize + x, corner_.y * world::kChunkSize + y, z};
        const world::BlockId before = area_.type(x, y, z).id;
        if (before == id) return;
        if (std::none_of(edits_.begin(), edits_.end(),
                         [&](const world::BlockEdit& e) { return e.pos == pos; }))
            edits_.push_back({pos, before, id});
        area_.set(x, y, z, id);
        const std::size_t k = area_.chunkIndex(x, y);
        chunks_[posOf(k)].chunk = std::make_shared<world::Chunk>(area_.chunks[k]);
    }
    // Brings the light up to date.
    std::vector<LightChange> relightQuietly() {
        std::vector<LightChange> changes = relight(chunks_, edits_, contentTable(), scratch_);
        edits_.clear();
        return changes;
    }
    // The same, and checks that the reported changes are the real ones.
    std::vector<LightChange> relightEdits() {
        const LitChunks before = chunks_;
        std::vector<LightChange> changes = relightQuietly();
        expectReported(before, changes);
        return changes;
    }

    std::vector<ChunkLight> lights() const {
        std::vector<ChunkLight> lights;
        for (std::size_t k = 0; k < area_.chunks.size(); ++k) lights.push_back(*chunks_.at(posOf(k)).light);
        return lights;
    }
    LightValue at(int x, int y, int z) const {
        return chunks_.at(posOf(area_.chunkIndex(x, y))).light->get(x & 15, y & 15, z);
    }
    const TestArea& area() const { return area_; }

  private:
    world::ChunkPos posOf(std::size_t k) const {
        const int number = static_cast<int>(k);
        return {corner_.x + number % area_.chunksX, corner_.y + number / area_.chunksX};
    }
    void expectReported(const LitChunks& before, const std::vector<LightChange>& changes) const {
        for (const auto& [pos, chunk] : chunks_) {
            const auto found = std::find_if(changes.begin(), changes.end(),
                                            [p = pos](const LightChange& c) { return c.pos == p; });
            const world::Heights heights = area_.heights;
            for (int k = heights.firstSection(); k < heights.endSection(); ++k) {
                const bool changed = !(chunk.light->brick(k) == before.at(pos).light->brick(k));
                EXPECT_EQ(changed, found != changes.end() && found->bricks.has(k))
                    << pos.x << ' ' << pos.y << " brick " << k;
            }
        }
    }

    TestArea area_;
    world::ChunkPos corner_;
    LitChunks chunks_;
    std::vector<world::BlockEdit> edits_;
    LightScratch scratch_;
};

// Successive random numbers.
class Random {
  public:
    explicit Random(std::uint32_t seed) : seed_(seed) {}
    int below(int limit) {
        return static_cast<int>(shared::hash3(++count_, 0u, 0u, seed_) % static_cast<std::uint32_t>(limit));
    }

  private:
    std::uint32_t seed_, count_ = 0;
};

// Mostly blocks that matter for light; now and then any block.
inline world::BlockId randomBlock(Random& random) {
    static const std::array kBlocks = {world::kAir,
                                       world::kAir,
                                       world::kAir,
                                       contentBlock("stone"),
                                       contentBlock("stone"),
                                       contentBlock("oak_leaves"),
                                       contentBlock("water"),
                                       contentBlock("lamp_white"),
                                       contentBlock("lamp_red"),
                                       contentBlock("lamp_blue"),
                                       contentBlock("cactus"),
                                       contentBlock("glowing_mushroom")};
    const int k = random.below(static_cast<int>(kBlocks.size()) + 2);
    return k < static_cast<int>(kBlocks.size()) ? kBlocks[static_cast<std::size_t>(k)]
                                                : anyBlock(static_cast<std::uint32_t>(random.below(1 << 20)));
}

// More than half of the places lie at borders and corners of chunks, a few at the world's bottom and top. In
// worlds of 0…255 most others lie where the random worlds have blocks.
inline world::BlockPos randomPlace(Random& random, const TestArea& area) {
    const auto along = [&](int size) {
        const int any = random.below(size);
        return random.below(3) != 0 ? any : std::min(size - 1, (any & ~15) + 15 * random.below(2));
    };
    const int x = along(area.width()), y = along(area.height());
    const int kind = random.below(20);
    const world::Heights heights = area.heights;
    if (kind == 0) return {x, y, random.below(2) == 0 ? heights.bottom : heights.top - 1};
    if (kind == 1) return {x, y, heights.bottom + random.below(heights.layers())};
    if (heights != world::Heights()) return {x, y, heights.bottom + along(heights.layers())};
    return {x, y, random.below(kFilledHeight + 8)};
}

}  // namespace terrane::light
