#include "terrane/gpu/mapped_ring.h"

#include <cstdint>
#include <set>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "tests/gpu/gl_fixture.h"

namespace terrane::gpu {
namespace {

static_assert(!std::is_copy_constructible_v<MappedRing> && std::is_nothrow_move_assignable_v<MappedRing>);
static_assert(!std::is_copy_constructible_v<Fence> && std::is_nothrow_move_assignable_v<Fence>);

class MappedRingTest : public GlTest {};

TEST_F(MappedRingTest, theGpuReadsWhatEachFrameWrote) {
    MappedRing ring(64, "ring");
    const Buffer copy(4, 0, "copy");
    std::set<std::size_t> offsets;
    for (std::uint32_t frame = 0; frame < 10; ++frame) {
        ring.beginFrame();
        const std::optional<MappedRing::Allocation> allocation =
            ring.write(std::span<const std::uint32_t>(&frame, 1));
        ASSERT_TRUE(allocation);
        offsets.insert(allocation->offsetBytes);
        glCopyNamedBufferSubData(ring.id(), copy.id(), static_cast<GLintptr>(allocation->offsetBytes), 0, 4);
        ring.endFrame();
        std::uint32_t read = 0;
        copy.download(0, std::as_writable_bytes(std::span(&read, 1)));
        EXPECT_EQ(read, frame);
    }
    EXPECT_EQ(offsets.size(), MappedRing::kFrameSlices);
}

TEST_F(MappedRingTest, slicesAreAlignedAndEnd) {
    MappedRing ring(1000, "ring");
    ring.beginFrame();
    const auto first = ring.allocate(3);
    const auto second = ring.allocate(5);
    ASSERT_TRUE(first && second);
    EXPECT_EQ(second->data.size(), 5U);
    GLint alignment = 0;
    glGetIntegerv(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT, &alignment);
    EXPECT_EQ(second->offsetBytes % static_cast<std::size_t>(alignment), 0U);
    EXPECT_GE(second->offsetBytes, first->offsetBytes + 3);
    EXPECT_FALSE(ring.allocate(ring.frameSliceBytes()));
    ring.bindUniform(0, *second);
    ring.endFrame();
    ring.beginFrame();
    EXPECT_TRUE(ring.allocate(ring.frameSliceBytes()));
    EXPECT_FALSE(ring.allocate(1));
    ring.endFrame();
}

TEST_F(MappedRingTest, movesAndLeavesAnEmptyOne) {
    MappedRing first(64, "ring");
    const GLuint id = first.id();
    MappedRing second = std::move(first);
    EXPECT_EQ(first.id(), 0U);
    EXPECT_EQ(second.id(), id);
    second.beginFrame();
    EXPECT_TRUE(second.allocate(64));
    second.endFrame();
}

TEST_F(MappedRingTest, fencesArePassedInTheEnd) {
    Fence fence;
    EXPECT_FALSE(fence.valid());
    EXPECT_TRUE(fence.passed());
    fence = Fence::insert();
    EXPECT_TRUE(fence.valid());
    fence.wait();
    EXPECT_TRUE(fence.passed());
    const Fence moved = std::move(fence);
    EXPECT_FALSE(fence.valid());
    EXPECT_TRUE(moved.passed());
}

TEST_F(MappedRingTest, AUniformThatDoesNotFitIsRefused) {
    MappedRing ring(64, "ring");
    EXPECT_THROW((void)ring.allocate(1), std::invalid_argument) << "outside of a frame";
    ring.beginFrame();
    const std::vector<std::byte> most(ring.frameSliceBytes());
    EXPECT_TRUE(ring.write(std::span(most)));
    EXPECT_THROW(ring.writeUniform(0, std::uint32_t{1}), std::invalid_argument);
    ring.endFrame();
}

}  // namespace
}  // namespace terrane::gpu
