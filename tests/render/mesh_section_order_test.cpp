#include "terrane/render/quads/mesh_section_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "terrane/shared/hash.h"

namespace terrane::render {
namespace {

// Small numbers that look random and are the same in every run.
class Dice {
  public:
    std::uint32_t below(std::uint32_t count) { return shared::hash2(++rolls_, 0, 5) % count; }

  private:
    std::uint32_t rolls_ = 0;
};

struct MeshSection {
    world::ChunkPos pos;
    std::uint32_t heights;
};

// Reference: sorts all at once.
std::vector<std::uint32_t> sortedSlots(const std::map<std::uint32_t, MeshSection>& meshSections,
                                       world::ChunkPos center) {
    std::vector<std::uint32_t> slots;
    for (const auto& [slot, meshSection] : meshSections) slots.push_back(slot);
    std::ranges::sort(slots, {}, [&](std::uint32_t slot) {
        const auto& [pos, heights] = meshSections.at(slot);
        const std::int64_t x = std::int64_t{pos.x} - center.x, y = std::int64_t{pos.y} - center.y;
        const std::int64_t distance = std::min<std::int64_t>(x * x + y * y, UINT32_MAX);
        return std::tuple(distance, pos.x, pos.y, heights);
    });
    return slots;
}

TEST(MeshSectionOrder, NothingHasNoOrder) {
    MeshSectionOrder order;
    EXPECT_FALSE(order.update({}));
    EXPECT_TRUE(order.slots().empty());
}

// A chunk of level 2 covers 4 × 4 of level 0: the nearest of these counts.
TEST(MeshSectionOrder, ChunksOfAllLevelsAreOrderedByBlocks) {
    MeshSectionOrder order;
    order.add(0, {2, 0}, 16);     // 2 away
    order.add(1, {1, 0, 2}, 16);  // 4 to 7
    order.add(2, {0, 0, 2}, 16);  // 0 to 3: the camera is within
    order.add(3, {5, 0}, 16);
    order.add(4, {-1, 0, 2}, 16);  // -4 to -1
    order.update({});
    EXPECT_EQ(order.slots(), (std::vector<std::uint32_t>{2, 4, 0, 1, 3}));
}

TEST(MeshSectionOrder, SaysWhetherItChanged) {
    MeshSectionOrder order;
    order.add(3, {1, 1}, 16);
    EXPECT_TRUE(order.update({}));
    EXPECT_FALSE(order.update({}));
    EXPECT_TRUE(order.update({2, 0}));
    EXPECT_FALSE(order.update({2, 0}));
    order.remove(3);
    EXPECT_TRUE(order.update({2, 0}));
    EXPECT_TRUE(order.slots().empty());
}

// Mesh sections come, go and change slots between updates; the camera moves now and then.
TEST(MeshSectionOrder, IsThatOfSortingAllAtOnce) {
    Dice dice;
    MeshSectionOrder order;
    std::map<std::uint32_t, MeshSection> meshSections;
    std::map<std::tuple<int, int, std::uint32_t>, std::uint32_t> slotOf;  // by place
    world::ChunkPos center;
    for (int step = 0; step < 200; ++step) {
        const std::uint32_t changes = dice.below(8) == 0 ? 200 : dice.below(6);
        for (std::uint32_t k = 0; k < changes; ++k) {
            const world::ChunkPos pos{static_cast<int>(dice.below(20)) - 10,
                                      static_cast<int>(dice.below(20)) - 10};
            const std::uint32_t low = 16 * dice.below(4), heights = low | (low + 16) << 16;
            const std::tuple place(pos.x, pos.y, low);
            if (const auto found = slotOf.find(place); found != slotOf.end()) {
                order.remove(found->second);
                meshSections.erase(found->second);
                slotOf.erase(found);
                continue;
            }
            std::uint32_t slot = dice.below(50);
            while (meshSections.contains(slot)) ++slot;
            order.add(slot, pos, heights);
            meshSections[slot] = {pos, heights};
            slotOf[place] = slot;
        }
        if (dice.below(5) == 0)
            center = {static_cast<int>(dice.below(9)) - 4, static_cast<int>(dice.below(9))};
        if (dice.below(3) == 0) continue;
        order.update(center);
        ASSERT_EQ(order.slots(), sortedSlots(meshSections, center)) << "step " << step;
    }
    EXPECT_GT(meshSections.size(), 300u);
}

TEST(MeshSectionOrder, TheEndsOfTheWorldAreFarthest) {
    MeshSectionOrder order;
    order.add(0, {world::kMaxChunk, world::kMaxChunk}, 16);
    order.add(1, {world::kMinChunk, world::kMaxChunk}, 16);
    order.add(2, {world::kMinChunk + 9, world::kMinChunk}, 16);
    order.update({world::kMinChunk, world::kMinChunk});
    EXPECT_EQ(order.slots(), (std::vector<std::uint32_t>{2, 1, 0}))
        << "of two beyond measure, the one with less x";
}

}  // namespace
}  // namespace terrane::render
