// Memory that the CPU writes and the GPU reads in the same frame, without copies or waiting: one mapped
// buffer cut into regions, one per frame in flight. Used by the renderer on the context's thread, between
// beginFrame and endFrame.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>

#include "terrane/gpu/buffer.h"
#include "terrane/gpu/fence.h"

namespace terrane::gpu {

class MappedRing {
  public:
    static constexpr std::size_t kRegions = 3;  // one being written, two the GPU may still read

    struct Slice {
        std::span<std::byte> data;    // write only: reading mapped memory may be very slow
        std::size_t offsetBytes = 0;  // in buffer()
    };

    MappedRing() = default;
    // regionBytes is what one frame may take, rounded up to the alignment that bindings need. Takes three
    // times that.
    MappedRing(std::size_t regionBytes, std::string_view label);

    // Waits only if the GPU still reads what was written kRegions frames ago.
    void beginFrame();
    // After the last GL command that reads this frame's slices.
    void endFrame();

    // Memory of this frame, aligned for every binding. None when the region is full.
    [[nodiscard]] std::optional<Slice> allocate(std::size_t sizeBytes);
    template <class T>
    [[nodiscard]] std::optional<Slice> write(std::span<const T> values) {
        const std::optional<Slice> slice = allocate(values.size_bytes());
        if (slice) std::memcpy(slice->data.data(), values.data(), values.size_bytes());
        return slice;
    }

    void bindUniform(GLuint index, const Slice& slice) const;

    [[nodiscard]] const Buffer& buffer() const { return buffer_; }
    [[nodiscard]] GLuint id() const { return buffer_.id(); }
    [[nodiscard]] std::size_t regionBytes() const { return regionBytes_; }

  private:
    Buffer buffer_;
    std::byte* mapped_ = nullptr;  // valid as long as buffer_
    std::size_t regionBytes_ = 0;
    std::size_t alignmentBytes_ = 1;
    std::size_t region_ = 0;
    std::size_t usedBytes_ = 0;  // of the present region
    bool inFrame_ = false;
    std::array<Fence, kRegions> fences_;
};

}  // namespace terrane::gpu
