// The image drawn directly equals the one drawn through the scene image.
#include "terrane/render/frame/target.h"

#include "tests/render/sunlit_fixture.h"

namespace terrane::render {
namespace {

class DirectImageTest : public SunlitTest {};

TEST_F(DirectImageTest, LooksAsTheLongWay) {
    constexpr glm::ivec2 kDirectSize{240, 160};
    world::World world = golden::flatWorld(6);
    golden::placeGallery(world);
    golden::placePool(world);
    show(world);
    RenderOptions direct = findPreset("low", true)->options, longWay = direct;
    longWay.godRays = true;  // none are seen where the sun is behind the camera
    ASSERT_TRUE(isDirectImage(direct, 1));
    ASSERT_FALSE(isDirectImage(longWay, 1));
    const Camera cameras[] = {{{-10, 6, 92}, 10, -25}, {{6, -12, 86}, 90, -8}, {{7, 7, 95}, 30, 12}};
    for (const float time : {0.1f, 0.25f, 0.5f, 0.76f}) {
        for (Camera camera : cameras) {
            const world::Environment light = world::environmentAt(time);
            if (glm::dot(lookDirection(camera), light.lightDirection) > 0) camera.yaw += 180;
            const FrameInput input{camera, light, 90, 0, View::Color};
            ASSERT_TRUE(renderer_->configure(kDirectSize, direct));
            const base::Image a = draw(input);
            ASSERT_TRUE(renderer_->configure(kDirectSize, longWay));
            const base::Image b = draw(input);
            int most = 0;
            double sum = 0;
            for (std::size_t k = 0; k < a.rgba.size(); ++k) {
                const int off = std::abs(int{a.rgba[k]} - int{b.rgba[k]});
                most = std::max(most, off);
                sum += off;
            }
            EXPECT_LE(most, 3) << time << " yaw " << camera.yaw;
            EXPECT_LE(sum / static_cast<double>(3 * a.rgba.size() / 4), 1) << time;
        }
    }
}

}  // namespace
}  // namespace terrane::render
