#include "terrane/gpu/framebuffer.h"

#include <array>
#include <type_traits>

#include "tests/gpu/gl_fixture.h"

namespace terrane::gpu {
namespace {

static_assert(!std::is_copy_constructible_v<Framebuffer> && std::is_nothrow_move_assignable_v<Framebuffer>);

class FramebufferTest : public GlTest {};

using Rgba = std::array<int, 4>;

Rgba pixel(const base::Image& image, int x, int y) {
    const std::size_t at = static_cast<std::size_t>(y * image.width + x) * 4;
    return {image.rgba[at], image.rgba[at + 1], image.rgba[at + 2], image.rgba[at + 3]};
}

Framebuffer make(const FramebufferOptions& options) {
    base::Result<Framebuffer> made = Framebuffer::create(options, "test");
    EXPECT_TRUE(made) << made.error().message;
    return made ? *std::move(made) : Framebuffer();
}

constexpr Rgba kRed = {255, 0, 0, 255};
constexpr Rgba kGreen = {0, 255, 0, 255};

void clearRectangle(const Framebuffer& target, glm::ivec4 box, glm::vec4 color) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(box.x, box.y, box.z, box.w);
    target.clearColor(0, color);
    glDisable(GL_SCISSOR_TEST);
}

TEST_F(FramebufferTest, readsTheTopRowFirst) {
    const Texture2D color({5, 3}, GL_RGBA8, 1, "color");
    const Framebuffer target = make({.colors = {color}, .depth = {}});
    target.clearColor(0, {1, 0, 0, 1});
    clearRectangle(target, {0, 2, 1, 1}, {0, 1, 0, 1});  // OpenGL counts rows upwards: the left top pixel
    const base::Image image = readPixels(target);
    ASSERT_EQ(image.width, 5);
    ASSERT_EQ(image.height, 3);
    EXPECT_EQ(pixel(image, 0, 0), kGreen);
    EXPECT_EQ(pixel(image, 1, 0), kRed);
    EXPECT_EQ(pixel(image, 0, 1), kRed);
    EXPECT_EQ(pixel(image, 4, 2), kRed);
}

TEST_F(FramebufferTest, everyColorIsCleared) {
    const Texture2D first({4, 4}, GL_RGBA8, 1, "first");
    const Texture2D second({4, 4}, GL_RGBA8, 1, "second");
    const Texture2D depth({4, 4}, GL_DEPTH_COMPONENT32F, 1, "depth");
    const Framebuffer target = make({.colors = {first, second}, .depth = depth});
    EXPECT_EQ(target.colorCount(), 2);
    target.bind();
    target.clearColor(0, {1, 0, 0, 1});
    target.clearColor(1, {0, 1, 0, 1});
    target.clearDepth(0.5F);
    EXPECT_EQ(pixel(readPixels(target, 0), 3, 3), kRed);
    EXPECT_EQ(pixel(readPixels(target, 1), 3, 3), kGreen);
    std::array<GLint, 4> viewport = {};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    EXPECT_EQ(viewport, (std::array<GLint, 4>{0, 0, 4, 4}));
}

TEST_F(FramebufferTest, incompleteOnesSayWhy) {
    const Texture2D notDrawable({4, 4}, GL_RGB9_E5, 1, "shared exponent");
    const base::Result<Framebuffer> made =
        Framebuffer::create({.colors = {notDrawable}, .depth = {}}, "lamp");
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().message.find("framebuffer lamp (4 x 4, 0 samples)"), std::string::npos)
        << made.error().message;
}

TEST_F(FramebufferTest, movesAndLeavesAnEmptyOne) {
    const Texture2D depth({4, 4}, GL_DEPTH_COMPONENT32F, 1, "depth");
    Framebuffer first = make({.colors = {}, .depth = depth});
    const GLuint id = first.id();
    const Framebuffer second = std::move(first);
    EXPECT_EQ(first.id(), 0U);
    EXPECT_EQ(second.id(), id);
}

}  // namespace
}  // namespace terrane::gpu
