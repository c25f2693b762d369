// The tests of quads on vector units against the rules of culling.h, one quad after the other.
#include "terrane/render/cull/quad_kernels.h"

#include <gtest/gtest.h>

#include <random>

#include "terrane/mesh/shape_faces.h"
#include "terrane/render/frame/camera.h"
#include "tests/render/content.h"

namespace terrane::render {
namespace {

class QuadKernelsTest : public ::testing::Test {
  protected:
    int within(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
    float real(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }

    DepthPyramid randomPyramid(glm::ivec2 pixels) {
        DepthPyramid pyramid;
        pyramid.resize((pixels + 1) / 2);
        for (std::int32_t k = 0; k < pyramid.levels[1].first; ++k)
            pyramid.texels[static_cast<std::size_t>(k)] = within(0, 1) == 0 ? real(0, 0.02f) : 0;
        pyramid.build();
        return pyramid;
    }

    shared::Quad randomQuad(std::size_t shapes) {
        shared::QuadFields fields;
        fields.x = static_cast<shared::uint>(within(0, 15));
        fields.y = static_cast<shared::uint>(within(0, 15));
        fields.z = static_cast<shared::uint>(within(0, 255));
        // Most are cubes of one direction, as in the ranges of a mesh section.
        fields.shapeFace =
            within(0, 3) > 0 ? 3 : static_cast<shared::uint>(within(0, static_cast<int>(shapes) - 1));
        fields.extentU = static_cast<shared::uint>(within(1, 16));
        fields.extentV = static_cast<shared::uint>(within(1, 16));
        fields.material = static_cast<shared::uint>(within(0, 3));
        shared::Quad quad = shared::packQuad(fields);
        if (within(0, 1) == 1) quad.word1 |= shared::kQuadSeen;
        if (within(0, 3) == 0) quad.word1 |= shared::kQuadNew;
        return quad;
    }

    std::mt19937 random_{11};
};

TEST_F(QuadKernelsTest, ThePyramidHasTheFarthestDepths) {
    for (const glm::ivec2 pixels : {glm::ivec2(64, 36), glm::ivec2(7, 5), glm::ivec2(129, 3)}) {
        const DepthPyramid pyramid = randomPyramid(pixels);
        const glm::ivec2 finest = pyramid.levels[0].size;
        EXPECT_EQ(pyramid.levels.back().size, glm::ivec2(1));
        for (std::size_t level = 1; level < pyramid.levels.size(); ++level) {
            for (int k = 0; k < 20; ++k) {
                const glm::ivec2 size = pyramid.levels[level].size;
                const glm::ivec2 at{within(0, size.x - 1), within(0, size.y - 1)};
                const int width = 1 << level;
                const glm::ivec2 first = at * width, last = glm::min(first + width, finest) - 1;
                EXPECT_EQ(pyramid.farthestIn({at, at, static_cast<int>(level), 0}),
                          pyramid.farthestIn({first, last, 0, 0}));
            }
        }
    }
}

TEST_F(QuadKernelsTest, QuadsAreTestedAsOneByOne) {
    const std::vector<shared::ShapeFace> shapes = mesh::shapeFaces(contentBlocks());
    const std::vector<std::uint32_t> isWaving = {0, 1, 0, 1};
    std::size_t seen = 0, added = 0, tested = 0, differing = 0;
    for (int round = 0; round < 300; ++round) {
        const glm::ivec2 pixels{within(1, 300), within(1, 200)};
        const DepthPyramid pyramid = randomPyramid(pixels);
        const Camera camera{{real(0, 16), real(0, 16), real(-40, 300)}, real(0, 360), real(-90, 90)};
        const ViewMatrices matrices =
            viewMatrices(camera, static_cast<float>(pixels.x) / static_cast<float>(pixels.y));
        QuadTest test{.view = {}, .pyramid = &pyramid, .shapeFaces = shapes, .isWaving = isWaving};
        test.slabCorner = {16.0f * within(-3, 3), 16.0f * within(-3, 3), 0};
        test.columnWidth = static_cast<float>(1 << within(0, 3));
        test.view.viewProjection = matrices.viewProjection;
        test.view.viewportSize = glm::vec2(pixels);
        test.view.nearPlane = kNearPlane;
        test.view.edgeExpansion = 1.0f / 64;
        test.view.blockPixels = 0.5f * static_cast<float>(pixels.y);
        test.view.samples = within(0, 1) == 0 ? 1 : 4;
        test.view.hidesBacks = static_cast<shared::uint>(within(0, 1));
        test.isTwoSided = within(0, 1) == 1;
        test.view.hiZLevels = static_cast<int>(pyramid.levels.size());

        std::vector<shared::Quad> quads(static_cast<std::size_t>(within(1, 100)));
        for (shared::Quad& quad : quads) quad = randomQuad(shapes.size());
        const auto all = static_cast<std::uint32_t>(quads.size());
        const auto first = static_cast<std::uint32_t>(within(0, static_cast<int>(all) - 1));
        const std::uint32_t count = all - first;
        const bool isDrawnEarly = within(0, 1) == 1;
        const std::vector<shared::Quad> before = quads;
        std::vector<std::uint32_t> listed(count + kQuadLanes);
        listed.resize(listSeen(quads, first, count, listed.data()));
        std::vector<std::uint32_t> expectedList;
        for (std::uint32_t k = first; k < all; ++k)
            if ((before[k].word1 & shared::kQuadSeen) != 0) expectedList.push_back(k);
        ASSERT_EQ(listed, expectedList);

        std::vector<std::uint32_t> out(count + kQuadLanes), numbers;
        const QuadTestResult result = testQuads(test, quads, first, count, isDrawnEarly, out.data());
        out.resize(result.newQuads);
        bool isAnySeen = false;
        for (std::uint32_t k = 0; k < all; ++k) {
            const shared::Quad& old = before[k];
            ASSERT_EQ(quads[k].word0, old.word0);
            if (k < first) {
                ASSERT_EQ(quads[k].word1, old.word1);
                continue;
            }
            const shared::Footprint print =
                footprintOfQuad(test.view, old, shapes[quadShapeFace(old)], isWaving[quadMaterial(old)] != 0,
                                test.isTwoSided, test.slabCorner, test.columnWidth);
            bool isVisible = true, isSoon = true;
            if (print.isBefore != 0) {
                const float farthest = pyramid.farthestIn(hiZAreaOfQuad(test.view, print));
                isVisible = isQuadVisible(test.view, print, farthest);
                isSoon = isQuadVisibleSoon(test.view, print, farthest);
            }
            const bool isNew = isVisible && !(isDrawnEarly && (old.word1 & shared::kQuadSeen) != 0);
            const shared::uint bits =
                (isVisible || isSoon ? shared::kQuadSeen : 0) | (isNew ? shared::kQuadNew : 0);
            // Rounding may move a footprint over the border of a pixel.
            differing += (quads[k].word1 & (shared::kQuadSeen | shared::kQuadNew)) != bits;
            ASSERT_EQ(quads[k].word1 | shared::kQuadSeen | shared::kQuadNew,
                      old.word1 | shared::kQuadSeen | shared::kQuadNew);
            if ((quads[k].word1 & shared::kQuadNew) != 0) numbers.push_back(k);
            isAnySeen |= (quads[k].word1 & shared::kQuadSeen) != 0;
            seen += (bits & shared::kQuadSeen) != 0;
            added += isNew;
            ++tested;
        }
        ASSERT_EQ(out, numbers);
        ASSERT_EQ(result.isAnySeen, isAnySeen);
    }
    EXPECT_LE(differing, tested / 1000);
    EXPECT_GT(seen, tested / 20);
    EXPECT_LT(seen, tested);
    EXPECT_GT(added, 0u);
}

// A block in front of the camera, which looks toward +y: its side toward -y is seen, that toward +y is not.
TEST(FootprintOfQuad, BacksAreThoseOfFacesThatLookAway) {
    const std::vector<shared::ShapeFace> shapes = mesh::shapeFaces(contentBlocks());
    const ViewMatrices matrices = viewMatrices({{8.5, -4, 8.5}, 90, 0}, 1);
    shared::CullView view{};
    view.viewProjection = matrices.viewProjection;
    view.viewportSize = glm::vec2(200);
    view.nearPlane = kNearPlane;
    view.samples = 1;
    const auto isBack = [&](shared::uint side, bool isWaving, bool isTwoSided) {
        const shared::Quad quad = shared::packQuad({.x = 8, .y = 8, .z = 8, .shapeFace = side});
        return footprintOfQuad(view, quad, shapes[side], isWaving, isTwoSided, glm::vec3(0), 1).isBack != 0;
    };
    constexpr shared::uint kToward = 2, kAway = 3;  // -y, +y
    for (const shared::uint hides : {0u, 1u}) {
        view.hidesBacks = hides;
        EXPECT_FALSE(isBack(kToward, false, false));
        EXPECT_TRUE(isBack(kAway, false, false));
        EXPECT_FALSE(isBack(kAway, true, false)) << "waves may turn it";
        EXPECT_FALSE(isBack(kToward, false, true));
        EXPECT_EQ(isBack(kAway, false, true), hides == 1);
        EXPECT_EQ(isBack(kAway, true, true), hides == 1);
        EXPECT_FALSE(isBack(shared::kShapeFaceCross, false, true)) << "plants are seen from both sides";
    }
}

}  // namespace
}  // namespace terrane::render
