// Memory that the CPU writes and the GPU reads in the same frame, without copies or waiting: one mapped
// buffer cut into frame slices, one per frame in flight. The renderer uses it on the context's thread,
// between beginFrame and endFrame.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>

#include "terrane/base/result.h"
#include "terrane/gpu/buffer.h"
#include "terrane/gpu/readback_buffer.h"

namespace terrane::gpu {

class MappedRing {
  public:
    static constexpr std::size_t kFrameSlices = 3;  // one being written, two the GPU may still read

    struct Allocation {
        std::span<std::byte> data;    // write only: reading mapped memory may be very slow
        std::size_t offsetBytes = 0;  // in buffer()
    };

    MappedRing() = default;
    // Creates a ring in which one frame may use `frameSliceBytes`, rounded up to the alignment of bindings.
    // The ring takes three times as much memory. Check isMapped() before use.
    MappedRing(std::size_t frameSliceBytes, std::string_view label);

    // Begins a frame. Waits only if the GPU still reads the slice that was written kFrameSlices frames ago.
    void beginFrame();
    // Ends the frame, after the last GL command that reads its allocations.
    void endFrame();

    // Allocates memory of this frame, aligned for every binding. Returns nothing when the frame slice is
    // full.
    [[nodiscard]] std::optional<Allocation> allocate(std::size_t sizeBytes);
    template <class T>
    [[nodiscard]] std::optional<Allocation> write(std::span<const T> values) {
        const std::optional<Allocation> allocation = allocate(values.size_bytes());
        if (allocation) std::memcpy(allocation->data.data(), values.data(), values.size_bytes());
        return allocation;
    }

    void bindUniform(GLuint index, const Allocation& allocation) const;
    // Writes a uniform block and binds it. Throws std::invalid_argument if the frame slice has no room for
    // it.
    template <class T>
    void writeUniform(GLuint index, const T& block) {
        const std::optional<Allocation> allocation = write(std::span(&block, 1));
        base::require(allocation.has_value(), "MappedRing: the frame has no room for a uniform block");
        bindUniform(index, *allocation);
    }

    // Returns whether the ring has memory; false if the driver has none for it.
    [[nodiscard]] bool isMapped() const { return mapped_ != nullptr; }
    [[nodiscard]] const Buffer& buffer() const { return buffer_; }
    [[nodiscard]] GLuint id() const { return buffer_.id(); }
    [[nodiscard]] std::size_t frameSliceBytes() const { return frameSliceBytes_; }

  private:
    Buffer buffer_;
    std::byte* mapped_ = nullptr;  // valid as long as buffer_
    std::size_t frameSliceBytes_ = 0;
    std::size_t alignmentBytes_ = 1;
    std::size_t frameSlice_ = 0;
    std::size_t usedBytes_ = 0;  // of the present frame slice
    bool inFrame_ = false;
    std::array<Fence, kFrameSlices> fences_;
};

}  // namespace terrane::gpu
