// Golden images of figures, by day and beside a torch at night, and the proof that they detect errors.
#include "tests/golden/figure_scene.h"

namespace terrane::golden {
namespace {

const render::Camera kYard{{-2.2, -0.4, 82.5}, 0, -7, 55};
constexpr float kDay = 0.42f, kNight = 0.0f;

// The yard: figures stand in front of a wall, one behind glass.
world::World yard() {
    world::World world = flatWorld(3);
    fillBlocks(world, {6, -4, 81}, {6, 2, 84}, "stone_bricks");
    fillBlocks(world, {3, 3, 81}, {3, 4, 82}, "cyan_glass");
    world::putBlock(world, {3, -1, 81}, contentBlock("torch"));
    return world;
}

// Figures that stand, walk, run, look up, swing an arm, turn away.
std::vector<world::Figure> figuresInTheYard() {
    std::vector<world::Figure> figures{figureAt(2.6, -2.6, 160, 1), figureAt(3.0, -1.6, 235, 2),
                                       figureAt(2.2, 0.3, 190, 3),  figureAt(3.2, 1.5, 180, 4),
                                       figureAt(2.5, 2.4, 20, 5),   figureAt(4.6, 4.5, 200, 6)};
    figures[1].stride = 1.2f;
    figures[1].strideSize = 0.8f;
    figures[2].yaw = 150;
    figures[2].pitch = 35;
    figures[3].swing = 0.3f;
    figures[4].stride = 4.4f;
    figures[4].strideSize = 1;
    return figures;
}

class Figures : public GoldenTest {
  protected:
    void SetUp() override {
        GoldenTest::SetUp();
        if (IsSkipped()) return;
        renderer_ = &emptyRenderer();
        renderer_->setViewDistance(3);
        showLit(*renderer_, yard(), 3);
    }

    base::Image imageOf(const std::vector<world::Figure>& figures, float time = kDay) {
        render::FrameInput input{kYard, world::environmentAt(time), 200, 0, render::View::Color};
        input.figures = figures;
        return drawBothWays(*renderer_, input);
    }

    render::Renderer* renderer_ = nullptr;
};

TEST_F(Figures, ByDay) {
    EXPECT_TRUE(matchesGolden("figures_day", imageOf(figuresInTheYard())));
}

TEST_F(Figures, BesideATorch) {
    EXPECT_TRUE(matchesGolden("figures_night", imageOf(figuresInTheYard(), kNight)));
}

TEST_F(Figures, MistakesAreNoticed) {
    const std::vector<world::Figure> right = figuresInTheYard();
    const base::Image expected = imageOf(right);
    EXPECT_TRUE(isSame(expected, imageOf(right)));
    using Change = std::function<void(world::Figure&)>;
    const std::pair<const char*, Change> changes[] = {
        {"gone", [](world::Figure& f) { f.eyes.x -= 100; }},
        {"a tenth of a block higher", [](world::Figure& f) { f.eyes.z += 0.1; }},
        {"turned", [](world::Figure& f) { f.yaw = f.bodyYaw += 45; }},
        {"head turned", [](world::Figure& f) { f.yaw += 45; }},
        {"another", [](world::Figure& f) { ++f.look; }},
        {"another step", [](world::Figure& f) { f.stride += 3, f.strideSize = 1.2f - f.strideSize; }},
        {"another swing", [](world::Figure& f) { f.swing = f.swing > 0 ? 0.0f : 0.4f; }},
    };
    for (std::size_t k = 0; k + 1 < right.size(); ++k) {  // the last one is behind glass
        for (const auto& [name, change] : changes) {
            std::vector<world::Figure> wrong = right;
            change(wrong[k]);
            EXPECT_FALSE(isSame(expected, imageOf(wrong))) << "figure " << k << ' ' << name;
        }
    }
}

}  // namespace
}  // namespace terrane::golden
