#include "terrane/gpu/mapped_ring.h"

#include <algorithm>
#include <cassert>

namespace terrane::gpu {
namespace {

constexpr GLbitfield kMapFlags = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;

// Both limits are powers of two, so their maximum satisfies both.
std::size_t bindingAlignment() {
    GLint uniform = 1;
    GLint storage = 1;
    glGetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &uniform);
    glGetIntegerv(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT, &storage);
    return static_cast<std::size_t>(std::max(uniform, storage));
}

std::size_t roundUp(std::size_t value, std::size_t step) {
    return (value + step - 1) / step * step;
}

}  // namespace

MappedRing::MappedRing(std::size_t frameSliceBytes, std::string_view label)
    : alignmentBytes_(bindingAlignment()) {
    assert(frameSliceBytes > 0 && "a ring without room is of no use");
    frameSliceBytes_ = roundUp(frameSliceBytes, alignmentBytes_);
    const std::size_t allBytes = frameSliceBytes_ * kFrameSlices;
    buffer_ = Buffer(allBytes, kMapFlags, label);
    mapped_ = static_cast<std::byte*>(
        glMapNamedBufferRange(buffer_.id(), 0, static_cast<GLsizeiptr>(allBytes), kMapFlags));
}

void MappedRing::beginFrame() {
    assert(id() != 0 && "an empty ring has no frames");
    assert(!inFrame_ && "endFrame ends every frame");
    frameSlice_ = (frameSlice_ + 1) % kFrameSlices;
    fences_[frameSlice_].wait();
    fences_[frameSlice_] = Fence();
    usedBytes_ = 0;
    inFrame_ = true;
}

void MappedRing::endFrame() {
    assert(inFrame_ && "beginFrame starts every frame");
    fences_[frameSlice_] = Fence::insert();
    inFrame_ = false;
}

std::optional<MappedRing::Allocation> MappedRing::allocate(std::size_t sizeBytes) {
    base::require(inFrame_, "MappedRing::allocate: beginFrame() comes first");
    if (mapped_ == nullptr || sizeBytes > frameSliceBytes_ - usedBytes_) return std::nullopt;
    const std::size_t offset = frameSlice_ * frameSliceBytes_ + usedBytes_;
    usedBytes_ = std::min(roundUp(usedBytes_ + sizeBytes, alignmentBytes_), frameSliceBytes_);
    return Allocation{{mapped_ + offset, sizeBytes}, offset};
}

void MappedRing::bindUniform(GLuint index, const Allocation& allocation) const {
    buffer_.bindUniform(index, allocation.offsetBytes, allocation.data.size());
}

}  // namespace terrane::gpu
