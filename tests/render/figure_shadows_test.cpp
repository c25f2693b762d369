// Which tiles figures touch, and their shadows in images of frames that follow each other.
#include "terrane/render/figures/figure_shadows.h"

#include <algorithm>

#include "terrane/world/character.h"
#include "tests/render/sunlit_fixture.h"

namespace terrane::render {
namespace {

constexpr int kSlotsOfRow = static_cast<int>(shared::kShadowTiles);

// A map with all tiles around a camera.
NearestShadowMap mapAround(const Camera& camera, std::uint64_t updates = 1) {
    ShadowClipmap clipmap(3);
    for (std::uint64_t k = 0; k < updates; ++k)
        clipmap.update(camera, towardSun(30, 50), ShadowClipmap::kAllTiles);
    return clipmap.nearest();
}

const Camera kMiddle{.position = {8, 8, 100}};
const std::vector<glm::dvec3> kOneFigure{{9, 9, 98}};

TEST(FigureShadows, TheWholeMapIsCopiedOnceThenTilesWithFigures) {
    const NearestShadowMap map = mapAround(kMiddle);
    FigureShadows shadows;
    const FigureShadowPlan first = shadows.plan(map, kOneFigure);
    EXPECT_EQ(first.copies.size(), kShadowSlots);
    ASSERT_FALSE(first.draws.empty());
    const FigureShadowPlan second = shadows.plan(map, kOneFigure);
    std::size_t tiles = 0;
    for (const ShadowTiles& rectangle : second.draws)
        tiles += static_cast<std::size_t>(rectangle.size.x * rectangle.size.y);
    EXPECT_EQ(second.copies.size(), tiles) << "one figure: no tile of a rectangle is without it";
    EXPECT_LE(tiles, 4u);
}

TEST(FigureShadows, WhereAFigureWasTheMapIsCopiedAgain) {
    const NearestShadowMap map = mapAround(kMiddle);
    FigureShadows shadows;
    shadows.plan(map, kOneFigure);
    const std::size_t touched = shadows.plan(map, kOneFigure).copies.size();
    const std::vector<glm::dvec3> elsewhere{{-20, -12, 98}};
    EXPECT_EQ(shadows.plan(map, elsewhere).copies.size(), touched);
    EXPECT_LE(shadows.plan(map, elsewhere).copies.size(), 4u) << "and then no more";
}

TEST(FigureShadows, TilesThatTheMapDrewAgainAreCopied) {
    NearestShadowMap map = mapAround(kMiddle);
    FigureShadows shadows;
    shadows.plan(map, kOneFigure);
    const std::size_t touched = shadows.plan(map, kOneFigure).copies.size();
    const FigureShadowPlan plan = shadows.plan(map, kOneFigure);
    const auto isTouched = [&](int slot) {
        return std::ranges::find(plan.copies, glm::ivec2(slot % kSlotsOfRow, slot / kSlotsOfRow)) !=
               plan.copies.end();
    };
    for (int slot = 0; slot < 3; ++slot) {
        ++map.tiles[static_cast<std::size_t>(slot)].drawn;
        EXPECT_EQ(shadows.plan(map, kOneFigure).copies.size(), touched + (isTouched(slot) ? 0 : 1));
    }
    map.layer = 3;
    EXPECT_EQ(shadows.plan(map, kOneFigure).copies.size(), kShadowSlots) << "another map";
}

TEST(FigureShadows, NothingIsDoneWithoutFiguresOnTheMap) {
    FigureShadows shadows;
    const NearestShadowMap map = mapAround(kMiddle);
    for (const std::vector<glm::dvec3>& feet :
         {std::vector<glm::dvec3>{}, std::vector<glm::dvec3>{{500, 8, 98}}}) {
        const FigureShadowPlan plan = shadows.plan(map, feet);
        EXPECT_TRUE(plan.copies.empty());
        EXPECT_TRUE(plan.draws.empty());
    }
    NearestShadowMap empty = map;
    for (auto& tile : empty.tiles) tile = {};
    EXPECT_TRUE(shadows.plan(empty, kOneFigure).draws.empty()) << "no tile is drawn yet";
}

// A map wraps around: figures on both sides of the seam need rectangles of their own.
TEST(FigureShadows, RectanglesNeverCrossTheSeam) {
    for (int step = 0; step < 40; ++step) {
        const Camera camera{.position = {5.0 * step, -7.0 * step, 100}};
        FigureShadows shadows;
        std::vector<glm::dvec3> feet;
        for (const glm::dvec2 aside : {glm::dvec2(30, 20), {-30, 20}, {0, -40}, {40, 0}})
            feet.push_back(camera.position + glm::dvec3(aside, -2));
        const FigureShadowPlan plan = shadows.plan(mapAround(camera), feet);
        EXPECT_GE(plan.draws.size(), 1u);
        EXPECT_LE(plan.draws.size(), 4u);
        for (const ShadowTiles& r : plan.draws) {
            EXPECT_LE(r.slot().x + r.size.x, kSlotsOfRow);
            EXPECT_LE(r.slot().y + r.size.y, kSlotsOfRow);
        }
    }
}

class FigureShadowImages : public SunlitTest {
  protected:
    static constexpr int kGround = 80;

    void SetUp() override {
        SunlitTest::SetUp();
        if (IsSkipped()) return;
        configure(ShadowReach::Far, true, 1024);
        showGround({});
    }
    void showGround(std::optional<BlockBox> tower) {
        std::vector<StoneBox> boxes{{{{-32, -32, 70}, {47, 47, kGround - 1}}}};
        if (tower) boxes.push_back({*tower});
        for (const auto& [pos, mesh] : golden::meshWorld(stoneWorld({-2, -2}, {2, 2}, boxes)))
            renderer_->setChunk(pos, mesh);
    }
    static world::Figure figureOnGround(double x, double y) {
        return {.eyes = {x, y, kGround + world::kEyeHeight}, .yaw = 40, .bodyYaw = 40, .look = 3};
    }
    base::Image drawFigures(const std::vector<world::Figure>& figures) {
        FrameInput input{camera_, sunAt(towardSun(180, 20)), 1e5f, 0, View::Color};
        input.figures = figures;
        return draw(input);
    }
    void forgetMaps() { configure(ShadowReach::Off), configure(ShadowReach::Far, true, 1024); }

    const Camera camera_{.position = {2, 8, kGround + 6}, .yaw = 0, .pitch = -35};
};

TEST_F(FigureShadowImages, TheyFallOnTheGround) {
    const base::Image without = drawFigures({});
    const base::Image with = drawFigures({figureOnGround(1.2, 8)});  // behind the camera
    EXPECT_GT(pixelsAbove(stepsBrighter(without, with), 25), 0) << "its shadow is in view";
    EXPECT_EQ(drawFigures({}).rgba, without.rgba) << "and goes with it";
}

TEST_F(FigureShadowImages, WhoWalksLeavesNoTrace) {
    for (int step = 0; step < 12; ++step)
        drawFigures({figureOnGround(4 + step, 8), figureOnGround(9, 20 - 2 * step)});
    const std::vector<world::Figure> last{figureOnGround(8, 6), figureOnGround(11, 9)};
    const base::Image walked = drawFigures(last);
    forgetMaps();
    EXPECT_EQ(drawFigures(last).rgba, walked.rgba);
}

TEST_F(FigureShadowImages, ShadowsOfBlocksChangeBesideThem) {
    const std::vector<world::Figure> figures{figureOnGround(8, 6)};
    drawFigures(figures);
    showGround(BlockBox{{6, 9, kGround}, {6, 9, kGround + 3}});
    const base::Image changed = drawFigures(figures);
    forgetMaps();
    EXPECT_EQ(drawFigures(figures).rgba, changed.rgba);
}

}  // namespace
}  // namespace terrane::render
