#include "terrane/gpu/texture.h"

#include <cstdint>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "tests/gpu/gl_fixture.h"

namespace terrane::gpu {
namespace {

static_assert(!std::is_copy_constructible_v<Texture2D> && std::is_nothrow_move_assignable_v<Texture2D>);
static_assert(!std::is_copy_constructible_v<Texture2DArray> &&
              std::is_nothrow_move_assignable_v<Texture2DArray>);
static_assert(!std::is_copy_constructible_v<Texture2DMultisample>);
static_assert(std::is_nothrow_move_assignable_v<Texture2DMultisample>);
static_assert(!std::is_copy_constructible_v<Sampler> && std::is_nothrow_move_assignable_v<Sampler>);

class TextureTest : public GlTest {};

using Bytes = std::vector<std::uint8_t>;

Bytes pattern(std::size_t count, std::uint8_t seed) {
    Bytes bytes(count);
    for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>(i * 7 + seed);
    return bytes;
}

Bytes readLevel(GLuint texture, int level, std::size_t sizeBytes) {
    Bytes bytes(sizeBytes);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(texture, level, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(sizeBytes),
                      bytes.data());
    return bytes;
}

TEST_F(TextureTest, levelsHalveDownToOne) {
    EXPECT_EQ(fullLevels({1, 1}), 1);
    EXPECT_EQ(fullLevels({16, 16}), 5);
    EXPECT_EQ(fullLevels({5, 3}), 3);
    EXPECT_EQ(levelSize({5, 3}, 1), glm::ivec2(2, 1));
    EXPECT_EQ(levelSize({5, 3}, 2), glm::ivec2(1, 1));
}

TEST_F(TextureTest, holdsWhatWasUploaded) {
    Texture2D texture({5, 3}, GL_RGBA8, 2, "texture");
    const Bytes level0 = pattern(5 * 3 * 4, 1);
    const Bytes level1 = pattern(2 * 1 * 4, 2);
    texture.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(level0)));
    texture.upload(1, GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(level1)));
    EXPECT_EQ(readLevel(texture.id(), 0, level0.size()), level0);
    EXPECT_EQ(readLevel(texture.id(), 1, level1.size()), level1);
}

TEST_F(TextureTest, rowsHaveNoPadding) {
    Texture2D texture({3, 2}, GL_R8, 1, "texture");
    const Bytes texels = {10, 20, 30, 40, 50, 60};
    texture.upload(0, GL_RED, GL_UNSIGNED_BYTE, std::as_bytes(std::span(texels)));
    Bytes read(6);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(texture.id(), 0, GL_RED, GL_UNSIGNED_BYTE, 6, read.data());
    EXPECT_EQ(read, texels);
}

TEST_F(TextureTest, arraysHoldEveryLayerAndLevel) {
    Texture2DArray texture({.size = {4, 4}, .layers = 3, .levels = 3}, GL_RGBA8, "array");
    for (int level = 0; level < 3; ++level) {
        const auto layerBytes = static_cast<std::size_t>(64 >> (2 * level));
        Bytes all;
        for (int layer = 0; layer < 3; ++layer) {
            const Bytes bytes = pattern(layerBytes, static_cast<std::uint8_t>(level * 10 + layer));
            texture.upload(level, layer, GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(bytes)));
            all.insert(all.end(), bytes.begin(), bytes.end());
        }
        EXPECT_EQ(readLevel(texture.id(), level, all.size()), all) << "level " << level;
    }
}

TEST_F(TextureTest, mipmapsAverage) {
    Texture2D texture({2, 2}, GL_RGBA8, 2, "texture");
    const Bytes texels = {0, 0, 0, 0, 100, 0, 0, 0, 0, 200, 0, 0, 100, 200, 0, 40};
    texture.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(texels)));
    texture.generateMipmaps();
    EXPECT_EQ(readLevel(texture.id(), 1, 4), (Bytes{50, 100, 0, 10}));
}

TEST_F(TextureTest, samplersTakeTheirSettings) {
    const Sampler sampler({.minFilter = GL_NEAREST_MIPMAP_LINEAR, .wrapS = GL_REPEAT, .compare = GL_LEQUAL},
                          "sampler");
    sampler.bind(0);
    GLint value = 0;
    glGetSamplerParameteriv(sampler.id(), GL_TEXTURE_MIN_FILTER, &value);
    EXPECT_EQ(value, GL_NEAREST_MIPMAP_LINEAR);
    glGetSamplerParameteriv(sampler.id(), GL_TEXTURE_WRAP_S, &value);
    EXPECT_EQ(value, GL_REPEAT);
    glGetSamplerParameteriv(sampler.id(), GL_TEXTURE_WRAP_T, &value);
    EXPECT_EQ(value, GL_CLAMP_TO_EDGE);
    glGetSamplerParameteriv(sampler.id(), GL_TEXTURE_COMPARE_FUNC, &value);
    EXPECT_EQ(value, GL_LEQUAL);
}

TEST_F(TextureTest, moveAndLeaveEmptyOnes) {
    Texture2D plain({1, 1}, GL_RGBA8, 1, "plain");
    Texture2DArray array({.size = {1, 1}, .layers = 1, .levels = 1}, GL_RGBA8, "array");
    Texture2DMultisample samples({1, 1}, GL_RGBA8, 4, "samples");
    Sampler sampler({}, "sampler");
    const Texture2D plain2 = std::move(plain);
    const Texture2DArray array2 = std::move(array);
    const Texture2DMultisample samples2 = std::move(samples);
    const Sampler sampler2 = std::move(sampler);
    EXPECT_EQ(plain.id() + array.id() + samples.id() + sampler.id(), 0U);
    EXPECT_TRUE(plain2.id() != 0 && array2.id() != 0 && samples2.id() != 0 && sampler2.id() != 0);
}

// OpenGL would read past the end of the data.
TEST_F(TextureTest, UploadsAreOfAllTexels) {
    const Bytes bytes = pattern(4 * 4 * 4 * 4 - 1, 1);
    const auto data = std::as_bytes(std::span(bytes));
    Texture2D texture({8, 8}, GL_RGBA8, 1, "texture");
    EXPECT_THROW(texture.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, data), std::invalid_argument);
    Texture2DArray layers({.size = {8, 8}, .layers = 1, .levels = 1}, GL_RGBA8, "layers");
    EXPECT_THROW(layers.upload(0, 0, GL_RGBA, GL_UNSIGNED_BYTE, data), std::invalid_argument);
    EXPECT_THROW(layers.uploadPart(0, {{0, 0}, {8, 8}}, GL_RGBA, GL_UNSIGNED_BYTE, data),
                 std::invalid_argument);
    Texture3D box({4, 4, 4}, GL_RGBA8, "box");
    EXPECT_THROW(box.uploadPart({0, 0, 0}, {4, 4, 4}, GL_RGBA, GL_UNSIGNED_BYTE, data),
                 std::invalid_argument);
    EXPECT_THROW(
        box.uploadPart({0, 0, 0}, {4, 4, 4}, GL_BGRA, GL_UNSIGNED_SHORT_4_4_4_4_REV, data.first(127)),
        std::invalid_argument);
    EXPECT_THROW(texture.upload(0, GL_RGBA, GL_UNSIGNED_INT_8_8_8_8, data), std::invalid_argument)
        << "a type whose size is not known";
}

}  // namespace
}  // namespace terrane::gpu
