#include "terrane/gpu/context.h"

#include <epoxy/gl.h>

#include <array>
#include <type_traits>

#include "tests/gpu/gl_fixture.h"

namespace terrane::gpu {
namespace {

static_assert(!std::is_copy_constructible_v<HeadlessContext> &&
              std::is_nothrow_move_assignable_v<HeadlessContext>);

class ContextTest : public GlTest {};

TEST_F(ContextTest, offersWhatIsNeeded) {
    EXPECT_TRUE(checkRequirements()) << checkRequirements().error().message;
    const DeviceInfo info = queryDevice();
    EXPECT_FALSE(info.vendor.empty());
    EXPECT_FALSE(info.renderer.empty());
    EXPECT_FALSE(info.version.empty());
    EXPECT_FALSE(info.glsl.empty());
    EXPECT_GE(info.maxTextureSize, 16384);  // the least that OpenGL 4.5 allows, and so on
    EXPECT_GE(info.maxTexture3dSize, 2048);
    EXPECT_GE(info.maxArrayLayers, 2048);
    EXPECT_GE(info.maxStorageBlockBytes, 1 << 24);
    EXPECT_GE(info.maxAnisotropy, 1.0F);
    EXPECT_EQ(info.software, info.renderer.find("llvmpipe") != std::string::npos) << info.renderer;
}

// OpenGL has a limit for each use: textures of maxSamples samples can be made for both.
TEST_F(ContextTest, SamplesAreThoseOfColorsAndDepth) {
    const int samples = queryDevice().maxSamples;
    EXPECT_GE(samples, 1);
    for (const GLenum limit : {GL_MAX_SAMPLES, GL_MAX_COLOR_TEXTURE_SAMPLES, GL_MAX_DEPTH_TEXTURE_SAMPLES}) {
        GLint most = 0;
        glGetIntegerv(limit, &most);
        EXPECT_LE(samples, most);
    }
    for (const GLenum format : {GL_RGBA8, GL_DEPTH_COMPONENT32F}) {
        GLuint texture = 0;
        glCreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &texture);
        glTextureStorage2DMultisample(texture, samples, format, 4, 4, GL_TRUE);
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
        glDeleteTextures(1, &texture);
    }
}

TEST_F(ContextTest, movesAndLeavesAnEmptyOne) {
    HeadlessContext moved = std::move(context());
    EXPECT_FALSE(context().valid());
    EXPECT_TRUE(moved.valid());
    EXPECT_FALSE(queryDevice().renderer.empty());
    context() = std::move(moved);
    EXPECT_TRUE(context().valid());
}

TEST_F(ContextTest, DrawsIntoItsSurface) {
    for (const int width : {4, 7}) {
        ASSERT_TRUE(context().setSurface(width, 3));
        glViewport(0, 0, width, 3);
        glClearColor(1, 0, 0, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        std::array<unsigned char, 4> last{};
        glReadPixels(width - 1, 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, last.data());
        EXPECT_EQ(last[0], 255);
        EXPECT_EQ(last[1], 0);
    }
}

TEST_F(ContextTest, endingAnotherContextLeavesThisOne) {
    {
        const base::Result<HeadlessContext> other = HeadlessContext::create({});
        ASSERT_TRUE(other) << other.error().message;
        EXPECT_EQ(other->debugLog(), nullptr);
    }
    context().makeCurrent();
    EXPECT_FALSE(queryDevice().renderer.empty());
}

}  // namespace
}  // namespace terrane::gpu
