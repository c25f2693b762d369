#include "terrane/gen_gpu/gpu_generator.h"

#include <algorithm>
#include <string>

#include "terrane/gen/generator.h"
#include "terrane/gen/generators/catalogue.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/render/content.h"

namespace terrane::gen_gpu {
namespace {

using world::ChunkPos;

// The first block in which two chunks differ, or nothing.
std::string difference(const world::Chunk& a, const world::Chunk& b) {
    for (int k = 0; k < world::kBlocksPerChunk; ++k) {
        const auto i = static_cast<world::BlockIndex>(k);
        if (a.block(i) != b.block(i)) {
            return fmt::format("x {} y {} z {}: {} and {}", k & 15, k >> 4 & 15, k >> 8, a.block(i),
                               b.block(i));
        }
    }
    return "";
}

class GpuGeneratorTest : public gpu::GlTest {
  protected:
    // Generates all chunks on both back ends, the GPU in batches of `batch`, and compares them block by
    // block.
    void compare(const std::string& name, const std::vector<ChunkPos>& chunks, std::size_t batch) {
        const auto graph = gen::makeGenerator(name, contentBlocks());
        ASSERT_TRUE(graph) << graph.error().message;
        const gen::Generator cpu(*graph, kSeed);
        auto onGpu = GpuGenerator::create(render::contentShaders(), *graph, kSeed);
        ASSERT_TRUE(onGpu) << onGpu.error().message;
        std::size_t compared = 0;
        while (compared < chunks.size()) {
            const std::size_t count = std::min(batch, chunks.size() - compared);
            ASSERT_GT(onGpu->submit(std::span(chunks).subspan(compared, count)), 0u);
            const auto done = onGpu->take(true);
            ASSERT_TRUE(done);
            for (const auto& [pos, chunk] : *done) {
                ASSERT_EQ(difference(cpu.generate(pos), chunk), "")
                    << name << " chunk " << pos.x << "," << pos.y;
                ++compared;
            }
        }
        EXPECT_EQ(compared, chunks.size());
    }

    static constexpr std::uint64_t kSeed = 12345;
};

std::vector<ChunkPos> square(ChunkPos first, int size) {
    std::vector<ChunkPos> chunks;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) chunks.push_back({first.x + x, first.y + y});
    }
    return chunks;
}

TEST_F(GpuGeneratorTest, FlatEqualsCpu) {
    compare("flat", square({-1, -1}, 3), 9);
}

TEST_F(GpuGeneratorTest, OverworldEqualsCpuAroundTheOrigin) {
    compare("overworld", square({-5, -5}, 10), 50);
}

TEST_F(GpuGeneratorTest, OverworldEqualsCpuFarAway) {
    compare("overworld", square({100000, -70000}, 6), 36);
    compare("overworld", square({world::kMinChunk, world::kMinChunk}, 5), 25);
    compare("overworld", square({world::kMaxChunk - 4, world::kMaxChunk - 4}, 5), 25);
    compare("overworld", square({world::kMinChunk, world::kMaxChunk - 4}, 5), 25);
}

TEST_F(GpuGeneratorTest, ScatteredChunksReuseSlots) {
    std::vector<ChunkPos> chunks;
    for (int k = 0; k < 128; ++k) chunks.push_back({(k * 7919) % 1000 - 500, (k * 104729) % 1000 - 500});
    compare("overworld", chunks, kMaxBatch);
}

}  // namespace
}  // namespace terrane::gen_gpu
