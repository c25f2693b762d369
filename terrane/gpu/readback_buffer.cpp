#include "terrane/gpu/readback_buffer.h"

#include <cassert>
#include <new>

namespace terrane::gpu {
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
