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

}  // namespace
}  // namespace terrane::gen
