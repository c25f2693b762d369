#include "terrane/light_gpu/gpu_batch_lighter.h"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "terrane/gen/generator.h"
#include "terrane/gen/generators/catalogue.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/light/area_solver_cases.h"
#include "tests/light/lit_area.h"
#include "tests/light/tall_worlds.h"
#include "tests/render/content.h"
#include "tests/support/default_heights.h"
#include "tests/support/depth.h"

namespace terrane::light_gpu {
namespace {

using light::TestArea;

class GpuLightSolverTest : public gpu::GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        if (!hasContext()) return;
        auto made = GpuLightSolver::create(render::contentShaders(), light::contentTable());
        ASSERT_TRUE(made) << made.error().message;
        solver_.emplace(std::move(*made));
    }
    void TearDown() override {
        solver_.reset();
        GlTest::TearDown();
    }

    std::optional<GpuLightSolver> solver_;
};

TEST_F(GpuLightSolverTest, SolvesWhatEveryBackEndSolves) {
    light::expectSolverCases(*solver_);
}

// The first block in which the lights differ, or nothing.
std::string difference(const std::vector<light::ChunkLight>& a, const std::vector<light::ChunkLight>& b) {
    if (a.size() != b.size()) return fmt::format("{} and {} chunks", a.size(), b.size());
    for (std::size_t chunk = 0; chunk < a.size(); ++chunk) {
        if (a[chunk] == b[chunk]) continue;
        const world::Heights heights = a[chunk].heights();
        if (heights != b[chunk].heights()) return fmt::format("chunk {}: other heights", chunk);
        for (world::BlockIndex i = 256 * heights.bottom; i < 256 * heights.top; ++i) {
            if (a[chunk].at(i) == b[chunk].at(i)) continue;
            return fmt::format("chunk {} x {} y {} z {}: {:04x} and {:04x}", chunk, i & 15, i >> 4 & 15,
                               i >> 8, a[chunk].at(i), b[chunk].at(i));
        }
    }
    return "";
}

TEST_F(GpuLightSolverTest, RandomWorldsEqualCpu) {
    for (std::uint32_t seed = 70; seed < 73; ++seed) {
        for (const auto& source : {light::caves(seed), light::scattered(seed, 3), light::scattered(seed, 40),
                                   light::layers(seed)}) {
            const TestArea area(3, 2, source);
            ASSERT_EQ(difference(solver_->solve(area.view()), area.lights()), "") << seed;
        }
    }
}

TEST_F(GpuLightSolverTest, TallWorldsEqualCpu) {
    for (const std::uint32_t seed : {0u, 3u, 7u}) {
        const light::TallWorld world = light::tallWorld(seed);
        const TestArea area(4, 3, world, world.heights);
        ASSERT_EQ(difference(solver_->solve(area.view()), area.lights()), "") << seed;
    }
}

// Two parts along x and y, the last ones small.
TEST_F(GpuLightSolverTest, PartsFitTogether) {
    const TestArea area(18, 17, light::caves(80));
    EXPECT_EQ(difference(solver_->solve(area.view()), area.lights()), "");
}

// More rounds than one submission: the tunnel crosses a border between light tiles at every third step.
TEST_F(GpuLightSolverTest, TunnelsAlongBordersOfTiles) {
    const world::BlockId stone = contentBlock("stone"), lamp = contentBlock("lamp_white");
    const TestArea area(2, 2, [&](int x, int y, int z) {
        if (z != 50 || x < 7 || x > 8 || y < 2 || y > 30) return stone;
        if (y == 2 && x == 7) return lamp;
        const bool isRung = y % 2 == 0, isLeft = y / 2 % 2 == 1;
        return isRung || (x == 7) == isLeft ? world::kAir : stone;
    });
    const auto light = solver_->solve(area.view());
    EXPECT_EQ(difference(light, area.lights()), "");
    EXPECT_EQ(light::levelOf(light[0].get(8, 10, 50), light::kRed), 15 - 11);
}

TEST_F(GpuLightSolverTest, OverworldEqualsCpu) {
    const auto graph = gen::makeGenerator("overworld", contentBlocks());
    ASSERT_TRUE(graph);
    const gen::Generator generator(*graph, 12345);
    for (const world::ChunkPos corner : {world::ChunkPos{-5, 11}, {-70, -9}, {60, 66}}) {
        constexpr int kSide = 8;
        std::vector<world::Chunk> chunks;
        for (int k = 0; k < kSide * kSide; ++k)
            chunks.push_back(generator.generate({corner.x + k % kSide, corner.y + k / kSide}));
        light::LightArea area{kSide, kSide, {}};
        for (const world::Chunk& chunk : chunks) area.chunks.push_back(&chunk);
        ASSERT_EQ(difference(solver_->solve(area), lightArea(area, light::contentTable())), "");
    }
}

// Light after many edits on the CPU, each change on top of those before, against light from
// scratch on the GPU.
TEST_F(GpuLightSolverTest, EqualsManyEdits) {
    const int kEdits = atDepth(1000, 10'000);
    light::LitArea lit(TestArea(3, 3, light::caves(90)), {-1, 4});
    light::Random random(90);
    for (int k = 0; k < kEdits; ++k) {
        const world::BlockPos p = randomPlace(random, lit.area());
        lit.set(p.x, p.y, p.z, randomBlock(random));
        lit.relightQuietly();
        if (k % (kEdits / 4) != kEdits / 4 - 1) continue;
        ASSERT_EQ(difference(lit.lights(), solver_->solve(lit.area().view())), "") << k;
    }
    light::expectReference(lit.area(), lit.area().flatten(solver_->solve(lit.area().view())),
                           world::kChunkHeight);
}

}  // namespace
}  // namespace terrane::light_gpu
