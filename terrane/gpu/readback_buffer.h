// Memory that the GPU copies results into and the CPU reads once a fence has passed. Used on the context's
// thread.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "terrane/gpu/buffer.h"

namespace terrane::gpu {

class ReadbackBuffer {
  public:
    ReadbackBuffer() = default;
    ReadbackBuffer(std::size_t sizeBytes, std::string_view label);

    // Queues a copy of the first `sizeBytes` of `from`. Nothing waits; a Fence inserted behind it tells when
    // data() holds it.
    void copyFrom(const Buffer& from, std::size_t sizeBytes);
    // For shaders that write here themselves: before the fence comes
    // glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT).
    void bindStorage(GLuint index) const { buffer_.bindStorage(index); }
    [[nodiscard]] std::span<const std::byte> data() const { return {mapped_, buffer_.sizeBytes()}; }

  private:
    Buffer buffer_;
    const std::byte* mapped_ = nullptr;  // valid as long as buffer_
};

}  // namespace terrane::gpu
