#include "terrane/web/visible_changes.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <vector>

namespace terrane::web {
namespace {

using world::ChunkPos;

TEST(EditEvent, NamesTheBlocksOfEachChunk) {
    const std::vector<ChunkPos> chunks{{2, -1}, {-1, 0, 3}};
    EXPECT_EQ(
        editEvent(7, chunks),
        R"({"boxes":[{"level":3,"x0":-128,"x1":-1,"y0":0,"y1":127},{"level":0,"x0":32,"x1":47,"y0":-16,"y1":-1}],)"
        R"("number":7})");
}

// Many chunks give few boxes, which cover all of them, separately for each level.
TEST(EditEvent, ManyChunksAreFewBoxes) {
    std::mt19937 random(5);
    std::vector<ChunkPos> chunks{{world::kMinChunk, world::kMaxChunk}};
    for (int k = 0; k < 5000; ++k)
        chunks.push_back({static_cast<std::int32_t>(random() % 300) - 150,
                          static_cast<std::int32_t>(random() % 300) - 150,
                          static_cast<std::uint8_t>(random() % 3)});
    const auto boxes = nlohmann::json::parse(editEvent(1, chunks))["boxes"];
    EXPECT_LE(boxes.size(), 200u);
    EXPECT_GT(boxes.size(), 20u) << "land between is left out";
    for (const ChunkPos chunk : chunks) {
        const std::int64_t width = std::int64_t{world::kChunkSize} << chunk.level;
        const auto covers = [&](const nlohmann::json& box) {
            return box["level"] == chunk.level && box["x0"] <= chunk.x * width &&
                   box["x1"] >= (chunk.x + 1) * width - 1 && box["y0"] <= chunk.y * width &&
                   box["y1"] >= (chunk.y + 1) * width - 1;
        };
        ASSERT_EQ(std::count_if(boxes.begin(), boxes.end(), covers), 1) << chunk.x << "," << chunk.y;
    }
}

}  // namespace
}  // namespace terrane::web
