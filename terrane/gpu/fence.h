// A point in the stream of GL commands that can be asked whether the GPU has passed it. Used on the context's
// thread.
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace terrane::gpu {

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
    // Does not wait. An empty fence is passed.
    [[nodiscard]] bool passed() const;
    void wait() const;

  private:
    GLsync sync_ = nullptr;
};

}  // namespace terrane::gpu
