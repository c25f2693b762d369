// A renderer with little but light, textures and blended faces, for tests that compare its images.
#pragma once

#include <array>

#include "tests/gpu/gl_fixture.h"
#include "tests/render/shared_renderer.h"

namespace terrane::render {

constexpr glm::ivec2 kImageSize{96, 64};

class RendererTest : public gpu::GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        if (IsSkipped()) return;
        renderer_ = &emptyRenderer(gpu::queryDevice());
        resize(kImageSize, 1);
    }

    void resize(glm::ivec2 size, int samples) {
        const auto resized = renderer_->configure(size, plainOptions(samples));
        ASSERT_TRUE(resized) << resized.error().message;
        EXPECT_EQ(renderer_->size(), size);
    }

    base::Image draw(const FrameInput& input) {
        renderer_->draw(input);
        base::Image image = renderer_->readImage();
        EXPECT_EQ(glm::ivec2(image.width, image.height), renderer_->size());
        EXPECT_EQ(image.rgba.size(), static_cast<std::size_t>(4 * image.width * image.height));
        return image;
    }

    static FrameInput noon(const Camera& camera, View view = View::Color) {
        return {camera, world::environmentAt(0.5f), 256, 0, view};
    }

    Renderer* renderer_ = nullptr;  // shared by all tests
};

using Color = std::array<int, 3>;

inline Color pixel(const base::Image& image, int x, int y) {
    const std::size_t at = 4 * static_cast<std::size_t>(x + y * image.width);
    return {image.rgba[at], image.rgba[at + 1], image.rgba[at + 2]};
}

}  // namespace terrane::render
