#include "terrane/gpu/buffer.h"

#include <cstdint>
#include <numeric>
#include <type_traits>

#include "tests/gpu/gl_fixture.h"

namespace terrane::gpu {
namespace {

static_assert(!std::is_copy_constructible_v<Buffer> && std::is_nothrow_move_assignable_v<Buffer>);

class BufferTest : public GlTest {};

std::vector<std::uint32_t> counting(std::size_t count) {
    std::vector<std::uint32_t> values(count);
    std::iota(values.begin(), values.end(), 1U);
    return values;
}

std::vector<std::uint32_t> readAll(const Buffer& buffer) {
    std::vector<std::uint32_t> values(buffer.sizeBytes() / 4);
    buffer.download(0, std::as_writable_bytes(std::span(values)));
    return values;
}

TEST_F(BufferTest, holdsTheDataItWasMadeFrom) {
    const std::vector<std::uint32_t> values = counting(100);
    const Buffer buffer(std::as_bytes(std::span(values)), 0, "test");
    EXPECT_EQ(buffer.sizeBytes(), 400U);
    EXPECT_EQ(readAll(buffer), values);
}

TEST_F(BufferTest, uploadsAtAnOffset) {
    const std::vector<std::uint32_t> values = counting(4);
    Buffer buffer(std::as_bytes(std::span(values)), GL_DYNAMIC_STORAGE_BIT, "test");
    buffer.uploadVector(4, std::vector<std::uint32_t>{70, 80});
    buffer.uploadVector(16, std::vector<std::uint32_t>{});  // nothing, at the very end
    EXPECT_EQ(readAll(buffer), (std::vector<std::uint32_t>{1, 70, 80, 4}));
}

TEST_F(BufferTest, bindsWholeAndInParts) {
    const Buffer buffer(4096, 0, "test");
    buffer.bindStorage(1);
    buffer.bindUniform(2, 1024, 256);
    GLint bound = 0;
    GLint64 offset = 0;
    glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, 1, &bound);
    EXPECT_EQ(static_cast<GLuint>(bound), buffer.id());
    glGetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, 2, &bound);
    glGetInteger64i_v(GL_UNIFORM_BUFFER_START, 2, &offset);
    EXPECT_EQ(static_cast<GLuint>(bound), buffer.id());
    EXPECT_EQ(offset, 1024);
}

TEST_F(BufferTest, movesAndLeavesAnEmptyOne) {
    Buffer first(16, 0, "first");
    const GLuint id = first.id();
    Buffer second(16, 0, "second");
    const GLuint replaced = second.id();
    second = std::move(first);
    EXPECT_EQ(first.id(), 0U);
    EXPECT_EQ(second.id(), id);
    EXPECT_EQ(glIsBuffer(replaced), GL_FALSE);
    const Buffer third = std::move(second);
    EXPECT_EQ(second.id(), 0U);
    EXPECT_EQ(third.id(), id);
}

TEST_F(BufferTest, growsToTwiceTheNeedWithinTheLimit) {
    EXPECT_EQ(grownBytes(100, 0), 0U);
    EXPECT_EQ(grownBytes(100, 100), 0U) << "large enough";
    EXPECT_EQ(grownBytes(100, 101), 202U);
    EXPECT_EQ(grownBytes(100, 101, 150), 150U);
    EXPECT_EQ(grownBytes(100, 150, 150), 150U) << "all that there is";
    EXPECT_LE(maxBufferBytes(), kMaxBufferBytes);
    EXPECT_GE(maxBufferBytes(), std::size_t{1} << 24) << "OpenGL 4.5 guarantees it";
    EXPECT_EQ(grownBytes(0, maxBufferBytes()), maxBufferBytes());
}

// Sizes of 2 GiB are negative in 32 bits.
TEST_F(BufferTest, hasNoTwoGibibytes) {
    static_assert(static_cast<std::int32_t>(kMaxBufferBytes) > 0);
    EXPECT_THROW(Buffer(std::size_t{1} << 31, 0, "test"), std::invalid_argument);
    EXPECT_THROW(Buffer((std::size_t{1} << 32) + 16, 0, "test"), std::invalid_argument) << "16 in 32 bits";
}

}  // namespace
}  // namespace terrane::gpu
