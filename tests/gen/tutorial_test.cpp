// The tutorial's generators have no mistakes and give what the text says.
#include "examples/tutorial_generators.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/gen/gen_fixture.h"

namespace terrane::gen {
namespace {

std::vector<BlockId> chunkOf(void (*write)(GeneratorBuilder&), ChunkPos pos) {
    GeneratorBuilder builder("tutorial", contentBlocks());
    write(builder);
    auto graph = builder.finish();
    EXPECT_TRUE(graph.has_value()) << (graph ? "" : graph.error().message);
    return graph ? blocksOf(Generator(std::move(*graph), 1).generate(pos)) : std::vector<BlockId>();
}

BlockId id(std::string_view name) {
    return contentBlocks().find(name)->id;
}

TEST(Tutorial, FlatLand) {
    const std::vector<BlockId> blocks = chunkOf(examples::writeStep1, {0, 0});
    EXPECT_EQ(std::count(blocks.begin(), blocks.end(), id("grass")), 81 * 256);
}

TEST(Tutorial, LaterStepsAddWhatTheyPromise) {
    const auto has = [](void (*write)(GeneratorBuilder&), std::string_view name) {
        for (std::int32_t k = 0; k < 12; ++k) {
            const std::vector<BlockId> blocks = chunkOf(write, {k * 9, k * 5});
            if (std::find(blocks.begin(), blocks.end(), id(name)) != blocks.end()) return true;
        }
        return false;
    };
    EXPECT_TRUE(has(examples::writeStep2, "water"));
    EXPECT_FALSE(has(examples::writeStep2, "stone"));
    EXPECT_TRUE(has(examples::writeStep3, "snow"));
    EXPECT_FALSE(has(examples::writeStep3, "glowing_mushroom"));
    EXPECT_TRUE(has(examples::writeStep4, "glowing_mushroom"));
}

// Water above the sea, which nearly always has water or ground at its sides.
TEST(Tutorial, RiversRunInTheirBeds) {
    GeneratorBuilder builder("rivers", contentBlocks());
    examples::writeRivers(builder);
    auto graph = builder.finish();
    ASSERT_TRUE(graph) << graph.error().message;
    const Generator generator(std::move(*graph), 1);
    int river = 0, open = 0;
    for (std::int32_t k = 0; k < 64; ++k) {
        const std::vector<BlockId> blocks = blocksOf(generator.generate({20 + k % 4, k / 4 - 4}));
        for (std::size_t i = 81 * 256; i + 1 < blocks.size(); ++i) {
            if (blocks[i] != id("water")) continue;
            ++river;
            open += (i % 16 != 15 && blocks[i + 1] == world::kAir) +
                    (i % 256 < 240 && blocks[i + 16] == world::kAir);
        }
    }
    EXPECT_GT(river, 100);
    EXPECT_LT(open * 30, river);
}

}  // namespace
}  // namespace terrane::gen
