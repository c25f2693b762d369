// Surfaces from a generator equal those of the chunks that it makes.
#include <random>
#include <string>

#include "tests/map/map_fixture.h"
#include "tests/support/default_heights.h"
#include "tests/support/depth.h"

namespace terrane::map {
namespace {

const int kChunks = atDepth(4, 24);

TEST(GeneratedSurface, IsThatOfTheWholeChunk) {
    std::mt19937 random(5);
    for (const std::string& name : gen::namesOf(gen::builtInGenerators())) {
        const gen::LevelGenerators& generators = generatorsOf(name);
        const bool isSlow =
            name == "hills3d" || name == "voronoi" || generators.heights().layers() > world::kChunkHeight;
        const int chunks = isSlow ? kChunks / 4 : kChunks;
        for (int k = 0; k < chunks * (world::kMaxLevel + 1); ++k) {
            const int level = k / chunks;
            const auto at = [&] { return (static_cast<std::int32_t>(random() % 40000) - 20000) >> level; };
            const world::ChunkPos pos{at(), at(), static_cast<std::uint8_t>(level)};
            const Surface fromAbove = surfaceOf(**generators.at(level), pos, contentKinds());
            ASSERT_EQ(fromAbove, surfaceOf(generators.generate(pos), contentKinds()))
                << name << ", " << testing::PrintToString(pos);
        }
    }
}

}  // namespace
}  // namespace terrane::map
