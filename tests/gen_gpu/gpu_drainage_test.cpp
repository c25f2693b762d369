#include "terrane/gen_gpu/gpu_generator.h"
#include "tests/gen/drainage_land.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/render/content.h"

namespace terrane::gen_gpu {
namespace {

using world::ChunkPos;

// Blocks in which every bit of what the map says counts.
gen::GeneratorGraph drainedLand(int level, gen::Valleys valleys) {
    gen::GeneratorBuilder builder("drained", gen::testBlocks(), level);
    gen::DrainageSpec spec = gen::kDrainageSpec;
    spec.lakeDepth = 2.0f;
    gen::DrainageRunner::write(builder, spec, valleys);
    auto graph = builder.finish();
    EXPECT_TRUE(graph) << graph.error().message;
    return *std::move(graph);
}

class GpuDrainageTest : public gpu::GlTest {
  protected:
    void compare(const std::vector<ChunkPos>& chunks, gen::Valleys valleys) {
        const gen::GeneratorGraph graph = drainedLand(chunks.front().level, valleys);
        const gen::Generator cpu(graph, gen::kTestSeed);
        auto onGpu = GpuGenerator::create(render::contentShaders(), graph, gen::kTestSeed);
        ASSERT_TRUE(onGpu) << onGpu.error().message;
        const auto done = gen::generateAll(*onGpu, chunks);
        ASSERT_TRUE(done) << done.error().message;
        for (std::size_t k = 0; k < chunks.size(); ++k) {
            EXPECT_EQ(gen::blocksOf(*(*done)[k]), gen::blocksOf(cpu.generate(chunks[k])))
                << testing::PrintToString(chunks[k]);
        }
    }
};

TEST_F(GpuDrainageTest, RiversAndLakesEqualCpu) {
    std::vector<ChunkPos> chunks;
    for (int k = 0; k < 24; ++k) chunks.push_back({k * 7 - 60, k * 5 + 11});
    chunks.insert(chunks.end(), gen::kPlaces.begin(), gen::kPlaces.end());
    compare(chunks, gen::Valleys::No);
    compare(chunks, gen::Valleys::Yes);
}

TEST_F(GpuDrainageTest, LevelsEqualCpu) {
    for (const std::uint8_t level : {5, 6}) {
        for (const gen::Valleys valleys : {gen::Valleys::No, gen::Valleys::Yes}) {
            compare({{2, 3, level},
                     {-1, -1, level},
                     {world::kMinChunk >> level, world::kMaxChunk >> level, level}},
                    valleys);
        }
    }
}

}  // namespace
}  // namespace terrane::gen_gpu
