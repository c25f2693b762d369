// Memory that the GPU copies results into and the CPU reads once a fence has passed. It is used on the
// context's thread.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

#include "terrane/gpu/buffer.h"

namespace terrane::gpu {

// A point in the stream of GL commands; passed() tests whether the GPU has reached it. It is used on the
// context's thread.
class Fence {
  public:
    Fence() = default;
    // Inserts a fence after all commands given so far.
    [[nodiscard]] static Fence insert();

    Fence(Fence&& other) noexcept : sync_(std::exchange(other.sync_, nullptr)) {}
    Fence& operator=(Fence&& other) noexcept;
    Fence(const Fence&) = delete;
    Fence& operator=(const Fence&) = delete;
    ~Fence();

    [[nodiscard]] bool valid() const { return sync_ != nullptr; }
    // Returns whether the GPU has passed the fence, without waiting. An empty fence counts as passed.
    [[nodiscard]] bool passed() const;
    void wait() const;

  private:
    GLsync sync_ = nullptr;
};

class ReadbackBuffer {
  public:
    ReadbackBuffer() = default;
    ReadbackBuffer(std::size_t sizeBytes, std::string_view label);

    // Queues a copy of the first `sizeBytes` of `from`, without waiting. data() holds it once a Fence
    // inserted afterwards has passed.
    void copyFrom(const Buffer& from, std::size_t sizeBytes);
    // Binds the buffer for shaders that write to it; they need
    // glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT) before the fence.
    void bindStorage(GLuint index) const { buffer_.bindStorage(index); }
    [[nodiscard]] std::span<const std::byte> data() const { return {mapped_, buffer_.sizeBytes()}; }

  private:
    Buffer buffer_;
    const std::byte* mapped_ = nullptr;  // valid as long as buffer_
};

}  // namespace terrane::gpu
