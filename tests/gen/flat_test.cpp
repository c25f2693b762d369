#include <gtest/gtest.h>

#include <cstdint>

#include "terrane/gen/generators/catalogue.h"
#include "tests/gen/gen_fixture.h"

namespace terrane::gen {
namespace {

// Stone up to 76, dirt, grass at sea level (80), air: the same in every column of the world.
TEST(Flat, IsTheSameEverywhere) {
    auto graph = makeGenerator("flat", contentBlocks());
    ASSERT_TRUE(graph.has_value());
    const auto id = [](std::string_view name) { return contentBlocks().find(name)->id; };
    const BlockId stone = id("stone"), dirt = id("dirt"), grass = id("grass");
    const Generator generator(std::move(*graph), 3);
    for (const ChunkPos pos : kPlaces) {
        SCOPED_TRACE(testing::PrintToString(pos));
        expectChunk(generator, pos, [&](std::int32_t, std::int32_t, std::int32_t z) {
            if (z > 80) return world::kAir;
            if (z == 80) return grass;
            return z > 76 ? dirt : stone;
        });
        if (HasFatalFailure()) return;
    }
}

}  // namespace
}  // namespace terrane::gen
