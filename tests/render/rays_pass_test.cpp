// Rays see what quads draw: each block type in each state, liquids that flow, layers, after edits.
#include "terrane/render/rays/rays_pass.h"

#include <fmt/format.h>

#include <glm/trigonometric.hpp>
#include <optional>
#include <random>

#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/changes/liquid_flow.h"
#include "tests/golden/scenes.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/render/content.h"
#include "tests/render/gbuffer_compare.h"
#include "tests/support/depth.h"
#include "tests/world/dam.h"

namespace terrane::render {
namespace {

constexpr glm::ivec2 kQuadsSize{96, 54};

class RaysPassTest : public gpu::GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        if (!hasContext()) return;
        quads_ = makeRenderer(SurfaceMethod::Quads);
        rays_ = makeRenderer(SurfaceMethod::Rays);
        fine_ = makeRenderer(SurfaceMethod::Rays, kRaysAcrossPixel);
    }

    static Renderer makeRenderer(SurfaceMethod method, int times = 1) {
        Renderer renderer =
            Renderer::create(contentShaders(), contentBlocks(), contentTexture, gpu::queryDevice()).value();
        RenderOptions options = plainOptions(1);
        options.surfaces = method;
        EXPECT_TRUE(renderer.configure(times * kQuadsSize, options));
        return renderer;
    }

    void show(const world::World& world) {
        for (const auto& [pos, mesh] : golden::meshWorld(world)) {
            EXPECT_TRUE(quads_->setChunk(pos, mesh));
            const auto chunk = std::make_shared<const world::Chunk>(*world.maybeChunkAt(pos));
            EXPECT_TRUE(rays_->setBlocks(pos, chunk) && fine_->setBlocks(pos, chunk));
        }
    }

    FaceAgreement compare(const Camera& camera) {
        const FrameInput input{camera, world::environmentAt(0.5f), 1e6f};
        clearLayers(*quads_);
        quads_->draw(input);
        rays_->draw(input);
        fine_->draw(input);
        FaceAgreement sum = compareFaces(seenSurfaces(*quads_), seenSurfaces(*rays_), seenSurfaces(*fine_));
        for (std::size_t k = 0; k < 3; ++k) {
            const FaceAgreement layer =
                compareFaces(seenLayer(*quads_, k), seenLayer(*rays_, k), seenLayer(*fine_, k));
            sum += layer;
            layers_ += layer.shown;
        }
        return sum;
    }

    // On zink over lavapipe of Mesa 22.3 up to 0.7 % of pixels differ; why is not known.
    static bool isZink() { return gpu::queryDevice().renderer.find("zink") != std::string::npos; }

    FaceAgreement compareAround(glm::dvec3 middle, double radius, int cameras) {
        std::uniform_real_distribution<double> unit(-1, 1);
        FaceAgreement sum;
        for (int k = 0; k < cameras; ++k) {
            const glm::dvec3 away{unit(random_), unit(random_), 0.15 + 0.8 * std::abs(unit(random_))};
            const glm::dvec3 from = middle + radius * away;
            const glm::dvec3 look = middle + 4.0 * glm::dvec3(unit(random_), unit(random_), 0) - from;
            const double yaw = std::atan2(look.y, look.x),
                         pitch = std::atan2(look.z, std::hypot(look.x, look.y));
            const FaceAgreement found = compare(
                {from, static_cast<float>(glm::degrees(yaw)), static_cast<float>(glm::degrees(pitch))});
            EXPECT_LE(found.others, found.pixels / (isZink() ? 100 : 500))
                << fmt::format("camera {},{},{} yaw {} pitch {}", from.x, from.y, from.z, glm::degrees(yaw),
                               glm::degrees(pitch));
            sum += found;
        }
        fmt::print("{}\n", textOf(sum));
        // Where each block differs from those beside it, edges are in nearly every pixel.
        EXPECT_LE(sum.others, sum.pixels / (isZink() ? 100 : 1000));
        EXPECT_GT(sum.centers, sum.pixels * 98 / 100);
        EXPECT_GT(sum.shown, sum.pixels / 8);
        return sum;
    }

    std::optional<Renderer> quads_, rays_, fine_;  // made in the context
    std::mt19937 random_{5};
    int layers_ = 0;
};

// All types beside each other and in all states that matter: 32 × 32 columns, two blocks high.
world::World everyBlock(std::mt19937& random) {
    world::World world = golden::flatWorld(3);
    const auto types = contentBlocks().types();
    for (int z = golden::kGalleryZ; z < golden::kGalleryZ + 2; ++z) {
        for (int y = -16; y < 16; ++y) {
            for (int x = -16; x < 16; ++x) {
                if (random() % 4 == 0) continue;
                const world::BlockType& type = types[random() % types.size()];
                if (!world::putBlock(world, {x, y, z}, type.id))
                    throw std::runtime_error("outside of the world");
                std::size_t states = type.growth.size() + 1;
                if (type.model) states = type.model->stateMask + 1u;
                if (type.shape == world::Shape::Liquid) states = 16;
                world::putState(world, {x, y, z}, static_cast<std::uint16_t>(random() % states));
            }
        }
    }
    return world;
}

TEST_F(RaysPassTest, EveryBlockInEveryState) {
    for (int k = 0; k < atDepth(2, 8); ++k) {
        quads_->clearChunks();
        rays_->clearChunks();
        fine_->clearChunks();
        show(everyBlock(random_));
        compareAround({0, 0, golden::kGalleryZ + 1}, 14, atDepth(4, 12));
    }
    EXPECT_GT(layers_, 1000);
}

TEST_F(RaysPassTest, FlowingWater) {
    world::World world;
    for (const world::ChunkPos pos : world::damChunks())
        world.insert(pos, world::damChunk(pos, contentBlocks()));
    std::vector<world::BlockEdit> edits;
    world::breakDam(world, contentBlocks(), edits);
    for (int tick = 0; tick < 30; ++tick) world::flowLiquids(world, contentBlocks(), world::kDamArea, edits);
    show(world);
    compareAround({32, 31, 50}, 18, atDepth(6, 24));
    EXPECT_GT(layers_, 1000);
}

// The store compares sections with those before.
TEST_F(RaysPassTest, EditsAreSeen) {
    world::World world = golden::flatWorld(3);
    golden::placePool(world);
    show(world);
    const auto types = contentBlocks().types();
    for (int k = 0; k < atDepth(5, 20); ++k) {
        for (int n = 0; n < 40; ++n) {
            const auto at = [&](int low, int high) {
                return std::uniform_int_distribution<int>(low, high)(random_);
            };
            world::putBlock(world, {at(-4, 18), at(-4, 18), at(76, 84)}, types[random_() % types.size()].id);
        }
        show(world);
        compareAround({7, 7, golden::kGalleryZ}, 14, 1);
    }
}

}  // namespace
}  // namespace terrane::render
