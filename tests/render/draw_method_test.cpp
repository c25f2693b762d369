// Images are the same by either way of drawing, within each limit.
#include "terrane/render/quads/draw_commands.h"

#include <initializer_list>

#include "terrane/mesh/mesh_section_quads.h"
#include "terrane/render/frame/renderer.h"
#include "tests/golden/scenes.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/render/content.h"

namespace terrane::render {
namespace {

RenderOptions withEverything(int samples) {
    RenderOptions options;
    options.msaaSamples = samples;
    options.shadows = ShadowReach::Far;
    options.shadowSize = 512;
    options.occlusion = Occlusion::On;
    // Quads that grow over the same edge are at equal depth, and which is drawn first depends on the list,
    // whose order differs from run to run: they do not grow here.
    options.tJunctions = TJunctions::Open;
    return options;
}

RenderOptions looped(RenderOptions options) {
    options.draw = DrawMethod::Loop;
    return options;
}

class DrawMethodTest : public gpu::GlTest {
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

    Renderer makeRenderer(const QuadStoreSizes& sizes = {},
                          const gpu::DeviceInfo& device = gpu::queryDevice()) {
        auto made = Renderer::create(contentShaders(), contentBlocks(), contentTexture, device, sizes);
        EXPECT_TRUE(made) << made.error().message;
        for (const auto& [pos, mesh] : meshes_) EXPECT_TRUE(made->setChunk(pos, mesh));
        return std::move(*made);
    }

    // A walk with figures, each frame drawn by both: what is visible in a frame is drawn first in the next.
    static void expectSameWalk(Renderer& a, Renderer& b, const char* name) {
        const world::Figure figure{.eyes = {-3, 5, 83}};
        for (const Camera& camera :
             {Camera{{-20, 8, 90}, 5, -15}, Camera{{-19, 8, 90}, 9, -15}, Camera{{8, 40, 84}, -80, -8},
              Camera{{12, 3, 83}, 140, -20}, Camera{{12, 3, 83}, 140, -20}}) {
            FrameInput input{camera, world::environmentAt(0.4f), 100, 1.5f, View::Color};
            input.figures = std::span(&figure, 1);
            a.draw(input);
            // Read before `b` draws: lavapipe of Mesa 22.3 limits draws without a count by the count of an
            // earlier draw in the same batch.
            const base::Image image = a.readImage();
            b.draw(input);
            ASSERT_EQ(image.rgba, b.readImage().rgba) << name << ", yaw " << camera.yaw;
        }
        glFinish();
        EXPECT_EQ(a.statistics().shadowTriangles, b.statistics().shadowTriangles) << name;
        for (Renderer* renderer : {&a, &b}) {
            EXPECT_GT(renderer->statistics().quads, 0u) << name;
            EXPECT_GT(renderer->statistics().meshSections, 0u) << name;
        }
    }

    void expectSameLoop(std::initializer_list<int> sampleCounts) {
        const QuadStoreSizes tiny{.arenaQuads = largest_ + 8, .firstQuads = largest_ + 8};
        for (const QuadStoreSizes& sizes : {QuadStoreSizes{}, tiny}) {
            Renderer lists = makeRenderer(sizes), loop = makeRenderer(sizes);
            for (const int samples : sampleCounts) {
                RenderOptions options = withEverything(samples), loopOptions = looped(options);
                ASSERT_TRUE(lists.configure(kWalkSize, options) && loop.configure(kWalkSize, loopOptions));
                expectSameWalk(lists, loop, "occlusion culling");
                options.occlusionCulling = loopOptions.occlusionCulling = false;
                ASSERT_TRUE(lists.configure(kWalkSize, options) && loop.configure(kWalkSize, loopOptions));
                expectSameWalk(lists, loop, "everything in view");
            }
        }
    }

    static constexpr glm::ivec2 kWalkSize{160, 90};
    golden::Meshes meshes_;
    std::uint32_t largest_ = 0;
};

TEST_F(DrawMethodTest, TheLoopDrawsTheSameImages) {
    expectSameLoop({2, 4});
}

TEST_F(DrawMethodTest, TheLoopDrawsTheSameImagesOfOneSample) {
    expectSameLoop({1});
}

TEST_F(DrawMethodTest, DriversWithoutCountsOrListsDrawTheSame) {
    gpu::DeviceInfo device = gpu::queryDevice();
    device.indirectCount = false;
    Renderer best = makeRenderer(), withoutCounts = makeRenderer({}, device);
    device.indirectDraws = false;
    Renderer withoutLists = makeRenderer({}, device);
    const RenderOptions options = withEverything(2);
    for (Renderer* renderer : {&best, &withoutCounts, &withoutLists})
        ASSERT_TRUE(renderer->configure(kWalkSize, options));
    expectSameWalk(best, withoutCounts, "no counts");
    best.clearChunks();
    for (const auto& [pos, mesh] : meshes_) EXPECT_TRUE(best.setChunk(pos, mesh));
    expectSameWalk(best, withoutLists, "no lists");
}

// Short lists of quads, few work groups, shadows in small uploads.
TEST_F(DrawMethodTest, LimitsChangeNoImage) {
    const RenderOptions options = withEverything(2);
    Renderer whole = makeRenderer();
    std::uint32_t commands = 0;  // the least with which all chunks are shown
    for (const auto& [pos, mesh] : meshes_)
        for (const mesh::MeshSection& meshSection : mesh.meshSections)
            for (const std::uint32_t most : mostCommands(mesh::rangesOf(meshSection))) commands += most;
    for (const DrawLimits limits :
         {DrawLimits{.listedQuads = 1}, DrawLimits{.listedQuads = 300}, DrawLimits{.testGroups = 1},
          DrawLimits{.testGroups = 7}, DrawLimits{.commands = commands}}) {
        Renderer limited = makeRenderer({.limits = limits});
        whole.clearChunks();
        for (const auto& [pos, mesh] : meshes_) EXPECT_TRUE(whole.setChunk(pos, mesh));
        for (const RenderOptions& either : {options, looped(options)}) {
            ASSERT_TRUE(whole.configure(kWalkSize, options) && limited.configure(kWalkSize, either));
            expectSameWalk(whole, limited, either.draw == DrawMethod::Loop ? "loop" : "lists");
        }
    }
}

TEST_F(DrawMethodTest, ChunksBeyondALimitAreRefused) {
    Renderer renderer = makeRenderer();
    renderer.clearChunks();
    auto made = Renderer::create(contentShaders(), contentBlocks(), contentTexture, gpu::queryDevice(),
                                 {.limits = {.meshSections = 20}});
    ASSERT_TRUE(made) << made.error().message;
    ASSERT_TRUE(made->configure(kWalkSize, withEverything(2)));
    std::size_t shown = 0;
    for (const auto& [pos, mesh] : meshes_) shown += made->setChunk(pos, mesh);
    EXPECT_GT(shown, 0u);
    EXPECT_LT(shown, meshes_.size());
    for (int frame = 0; frame < 2; ++frame)
        made->draw({{{-20, 8, 90}, 5, -15}, world::environmentAt(0.4f), 100, 1.5f, View::Color});
    EXPECT_TRUE(made->setChunk(meshes_.begin()->first, {}));
}

}  // namespace
}  // namespace terrane::render
