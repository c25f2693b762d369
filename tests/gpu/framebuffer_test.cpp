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

TEST_F(FramebufferTest, everyColourIsCleared) {
    const Texture2D first({4, 4}, GL_RGBA8, 1, "first");
    Texture2DArray layers({.size = {8, 8}, .layers = 3, .levels = 2}, GL_RGBA8, "second");
    const Texture2D depth({4, 4}, GL_DEPTH32F_STENCIL8, 1, "depth");
    const Framebuffer target = make({.colors = {first, Attachment(layers, 2, 1)}, .depth = depth});
    EXPECT_TRUE(target.hasDepth());
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

TEST_F(FramebufferTest, resolvesEachColour) {
    const glm::ivec2 size(4, 4);
    const Texture2DMultisample samples0(size, GL_RGBA8, 4, "samples 0");
    const Texture2DMultisample samples1(size, GL_RGBA8, 4, "samples 1");
    const Texture2DMultisample sampleDepth(size, GL_DEPTH_COMPONENT32F, 4, "sample depth");
    const Texture2D color0(size, GL_RGBA8, 1, "color 0");
    const Texture2D color1(size, GL_RGBA8, 1, "color 1");
    const Texture2D depth(size, GL_DEPTH_COMPONENT32F, 1, "depth");
    const Framebuffer from = make({.colors = {samples0, samples1}, .depth = sampleDepth});
    const Framebuffer to = make({.colors = {color0, color1}, .depth = depth});
    EXPECT_EQ(from.samples(), 4);
    from.clearColor(0, {1, 0, 0, 1});
    from.clearColor(1, {0, 1, 0, 1});
    from.clearDepth(0.25F);
    resolve(from, to);
    EXPECT_EQ(pixel(readPixels(to, 0), 2, 1), kRed);
    EXPECT_EQ(pixel(readPixels(to, 1), 2, 1), kGreen);
    std::array<float, 16> depths = {};
    glGetTextureImage(depth.id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, sizeof depths, depths.data());
    EXPECT_EQ(depths[7], 0.25F);
}

TEST_F(FramebufferTest, blitsScaledWithoutFlipping) {
    const Texture2D small({2, 2}, GL_RGBA8, 1, "small");
    const Texture2D large({4, 4}, GL_RGBA8, 1, "large");
    const Framebuffer from = make({.colors = {small}, .depth = {}});
    const Framebuffer to = make({.colors = {large}, .depth = {}});
    from.clearColor(0, {1, 0, 0, 1});
    clearRectangle(from, {1, 1, 1, 1}, {0, 1, 0, 1});  // right top
    blitColor(from, 0, to, GL_NEAREST);
    const base::Image image = readPixels(to);
    EXPECT_EQ(pixel(image, 3, 0), kGreen);
    EXPECT_EQ(pixel(image, 2, 1), kGreen);
    EXPECT_EQ(pixel(image, 1, 1), kRed);
    EXPECT_EQ(pixel(image, 3, 2), kRed);
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
