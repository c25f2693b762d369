// Images of a world whose quads lie in one arena, and in many: the same, with every way of culling and
// drawing.
#include <map>

#include "terrane/render/frame/renderer.h"
#include "tests/golden/scenes.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/render/content.h"

namespace terrane::render {
namespace {

constexpr glm::ivec2 kSize{160, 90};

class ArenasTest : public gpu::GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        if (IsSkipped()) return;
        world::World world = golden::flatWorld(4);
        golden::placeGallery(world);
        golden::placePool(world);
        meshes_ = golden::meshWorld(world, {mesh::MergeMethod::None});
        for (const auto& [pos, mesh] : meshes_)
            largest_ = std::max(largest_, static_cast<std::uint32_t>(mesh.quads.size()));
    }
    void TearDown() override {
        meshes_.clear();
        GlTest::TearDown();
    }

    Renderer makeRenderer(const QuadStoreSizes& sizes) {
        auto made =
            Renderer::create(contentShaders(), contentBlocks(), contentTexture, gpu::queryDevice(), sizes);
        EXPECT_TRUE(made) << made.error().message;
        for (const auto& [pos, mesh] : meshes_) EXPECT_TRUE(made->setChunk(pos, mesh));
        return std::move(*made);
    }
    // As small as they may be.
    QuadStoreSizes tinyArenas() const { return {.arenaQuads = largest_ + 8, .firstQuads = largest_ + 8}; }

    golden::Meshes meshes_;
    std::uint32_t largest_ = 0;
};

std::vector<FrameInput> frames() {
    std::vector<FrameInput> inputs;
    for (const Camera& camera :
         {Camera{{-20, 8, 90}, 5, -15}, Camera{{8, 40, 84}, -80, -8}, Camera{{12, 3, 83}, 140, -20}})
        inputs.push_back({camera, world::environmentAt(0.4f), 100, 1.5f, View::Color});
    return inputs;
}

// Quads of two mesh sections that grow over the same edge are at equal depth, and which is drawn first
// depends on the arena: such pixels are left out by options where quads do not grow.
TEST_F(ArenasTest, ManyArenasMakeTheSameImages) {
    Renderer one = makeRenderer({}), many = makeRenderer(tinyArenas());
    EXPECT_EQ(one.quadBuffers().buffers.size(), 1u);
    EXPECT_GT(many.quadBuffers().buffers.size(), 4u);
    const auto compare = [&](const RenderOptions& options, const char* name) {
        ASSERT_TRUE(one.configure(kSize, options) && many.configure(kSize, options));
        for (int round = 0; round < 2; ++round) {
            for (const FrameInput& input : frames()) {
                one.draw(input);
                many.draw(input);
                ASSERT_EQ(one.readImage().rgba, many.readImage().rgba) << name << ", round " << round;
            }
        }
        const FrameStatistics a = one.statistics(), b = many.statistics();
        EXPECT_GT(a.quads, 0u) << name;
        EXPECT_EQ(a.shadowTriangles, b.shadowTriangles) << name;
    };
    RenderOptions options = plainOptions(1);
    options.tJunctions = TJunctions::Open;
    options.occlusionCulling = false;
    compare(options, "plain");
    options.occlusionCulling = true;
    compare(options, "occlusion culling");
    options.shadows = ShadowReach::Far;
    options.shadowSize = 512;
    compare(options, "shadows");
    options.transparencyLayers = 1;
    compare(options, "one layer");
    options.transparencyLayers = 3;
    compare(options, "three layers");
    options.msaaSamples = 4;
    options.msaaAlphaTest = true;
    compare(options, "several samples");
}

// Chunks that are removed and added while frames are drawn move to other arenas.
TEST_F(ArenasTest, ChunksMoveBetweenArenas) {
    Renderer one = makeRenderer({}), many = makeRenderer(tinyArenas());
    RenderOptions options = plainOptions(1);
    options.tJunctions = TJunctions::Open;
    ASSERT_TRUE(one.configure(kSize, options) && many.configure(kSize, options));
    int step = 0;
    for (const auto& [pos, mesh] : meshes_) {
        for (Renderer* renderer : {&one, &many}) {
            renderer->removeChunk(pos);
            renderer->removeChunk({-pos.x, -pos.y});
            EXPECT_TRUE(renderer->setChunk({-pos.x, -pos.y}, meshes_.at({-pos.x, -pos.y})));
            if (step % 2 == 0) {
                EXPECT_TRUE(renderer->setChunk(pos, mesh));
            }
        }
        if (++step % 10 > 0) continue;
        const FrameInput input = frames()[static_cast<std::size_t>(step / 10) % 3];
        one.draw(input);
        many.draw(input);
        ASSERT_EQ(one.readImage().rgba, many.readImage().rgba) << step;
    }
}

TEST_F(ArenasTest, ABudgetIsNeverPassed) {
    Renderer renderer = makeRenderer({});
    constexpr std::size_t kBudget = std::size_t{24} << 20;
    renderer.setMemoryBudget(kBudget);
    ASSERT_TRUE(renderer.configure(kSize, plainOptions(1)));
    renderer.setViewDistance(16);
    int chunks = 0;
    const mesh::ChunkMesh& mesh = meshes_.at({0, 0});
    while (renderer.setChunk({chunks % 100, chunks / 100}, mesh)) {
        ASSERT_LT(++chunks, 1'000'000);
        if (chunks % 100 == 0) renderer.draw(frames()[0]);
        ASSERT_LE(renderer.peakMemory(), kBudget);
    }
    EXPECT_GT(renderer.quadBytes(), kBudget / 10);
    renderer.draw(frames()[0]);
    EXPECT_LE(renderer.memory().total(), kBudget);
    renderer.clearChunks();
    EXPECT_LT(renderer.memory().quads, kBudget / 8) << "room is given back";
    EXPECT_EQ(renderer.quadBytes(), 0u);
}

}  // namespace
}  // namespace terrane::render
