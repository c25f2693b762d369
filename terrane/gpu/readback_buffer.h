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

    // Queues a copy of the first `sizeBytes` of `from`, without waiting. data() holds it once a Fence
    // inserted afterwards has passed.
    void copyFrom(const Buffer& from, std::size_t sizeBytes);
    // For shaders that write here themselves: they need glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT)
    // before the fence.
    void bindStorage(GLuint index) const { buffer_.bindStorage(index); }
    [[nodiscard]] std::span<const std::byte> data() const { return {mapped_, buffer_.sizeBytes()}; }

  private:
    Buffer buffer_;
    const std::byte* mapped_ = nullptr;  // valid as long as buffer_
};

}  // namespace terrane::gpu
