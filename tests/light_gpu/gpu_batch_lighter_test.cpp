#include "terrane/light_gpu/gpu_batch_lighter.h"

#include <optional>

#include "terrane/gen/generator.h"
#include "terrane/gen/generators/catalogue.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/light/batch_lighter_cases.h"
#include "tests/render/content.h"

namespace terrane::light_gpu {
namespace {

using light::LightRequest;
using light::RequestArea;

class GpuBatchLighterTest : public gpu::GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        if (!hasContext()) return;
        auto made = GpuBatchLighter::create(render::contentShaders(), light::contentTable());
        ASSERT_TRUE(made) << made.error().message;
        lighter_.emplace(std::move(*made));
    }
    void TearDown() override {
        lighter_.reset();
        GlTest::TearDown();
    }

    std::optional<GpuBatchLighter> lighter_;
};

TEST_F(GpuBatchLighterTest, DoesWhatEveryBackEndDoes) {
    EXPECT_EQ(lighter_->backend(), "gpu");
    light::expectLighterCases(*lighter_);
}

// Squares as streaming requests them, with all neighbors; and parts of them.
TEST_F(GpuBatchLighterTest, OverworldEqualsCpu) {
    const auto graph = gen::makeGenerator("overworld", contentBlocks());
    ASSERT_TRUE(graph);
    const gen::Generator generator(*graph, 12345);
    for (const world::ChunkPos corner : {world::ChunkPos{-5, 11}, {60, 66}}) {
        RequestArea area(
            8, 8, [](int, int, int) { return world::kAir; }, corner);
        for (int k = 0; k < 64; ++k) {
            area.chunk(k % 8, k / 8) =
                std::make_shared<world::Chunk>(generator.generate(world::offsetBy(corner, k % 8, k / 8)));
        }
        light::expectLit(*lighter_, area.all());
        std::vector<LightRequest> ring;
        for (int k = 0; k < 6; ++k) ring.push_back(area.request(k + 1, 1));
        for (int k = 1; k < 6; ++k) ring.push_back(area.request(6, k + 1));
        light::expectLit(*lighter_, ring);
    }
}

// More rounds than one submission, so that the light is not found at the first check; a batch behind it
// waits. The tunnel crosses a border between light tiles at every third step.
TEST_F(GpuBatchLighterTest, TunnelsTakeSeveralLooks) {
    const world::BlockId stone = contentBlock("stone"), lamp = contentBlock("lamp_white");
    RequestArea tunnel(1, 2, [&](int x, int y, int z) {
        if (z != 50 || x < 7 || x > 8 || y < 2 || y > 30) return stone;
        if (y == 2 && x == 7) return lamp;
        const bool isRung = y % 2 == 0, isLeft = y / 2 % 2 == 1;
        return isRung || (x == 7) == isLeft ? world::kAir : stone;
    });
    RequestArea behind(1, 1, light::caves(5));
    const std::vector<LightRequest> first = tunnel.all(), second = behind.all();
    ASSERT_EQ(lighter_->submit(first), 2u);
    ASSERT_EQ(lighter_->submit(second), 1u);
    std::vector<light::LightResult> found;
    while (found.size() < 3) {
        for (light::LightResult& done : lighter_->take(false)) found.push_back(std::move(done));
    }
    EXPECT_TRUE(found[0].light == light::directLight(first[0]));
    EXPECT_TRUE(found[1].light == light::directLight(first[1]));
    EXPECT_TRUE(found[2].light == light::directLight(second[0]));
    EXPECT_EQ(light::levelOf(found[0].light.get(8, 10, 50), light::kRed), 15 - 11);
}

}  // namespace
}  // namespace terrane::light_gpu
