#include "terrane/gpu/readback_buffer.h"

#include <cassert>
#include <new>

namespace terrane::gpu {

Fence Fence::insert() {
    Fence fence;
    fence.sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    return fence;
}

Fence& Fence::operator=(Fence&& other) noexcept {
    std::swap(sync_, other.sync_);
    return *this;
}

Fence::~Fence() {
    if (sync_ != nullptr) glDeleteSync(sync_);
}

bool Fence::passed() const {
    if (sync_ == nullptr) return true;
    const GLenum state = glClientWaitSync(sync_, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
    return state != GL_TIMEOUT_EXPIRED;
}

void Fence::wait() const {
    if (sync_ == nullptr) return;
    constexpr GLuint64 kStepNanoseconds = 100'000'000;  // drivers bound one wait; the loop does not
    while (glClientWaitSync(sync_, GL_SYNC_FLUSH_COMMANDS_BIT, kStepNanoseconds) == GL_TIMEOUT_EXPIRED) {
    }
}

namespace {

constexpr GLbitfield kMapping = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;

}  // namespace

ReadbackBuffer::ReadbackBuffer(std::size_t sizeBytes, std::string_view label)
    : buffer_(sizeBytes, kMapping | GL_CLIENT_STORAGE_BIT, label) {
    const void* mapped = glMapNamedBufferRange(buffer_.id(), 0, static_cast<GLsizeiptr>(sizeBytes), kMapping);
    if (!mapped) throw std::bad_alloc();  // of the GPU
    mapped_ = static_cast<const std::byte*>(mapped);
}

void ReadbackBuffer::copyFrom(const Buffer& from, std::size_t sizeBytes) {
    assert(sizeBytes <= buffer_.sizeBytes() && sizeBytes <= from.sizeBytes() &&
           "both buffers have the bytes");
    glCopyNamedBufferSubData(from.id(), buffer_.id(), 0, 0, static_cast<GLsizeiptr>(sizeBytes));
}

}  // namespace terrane::gpu
