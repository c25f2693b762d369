// A map of a world that is not made yet, drawn on a thread of its own: coarse at first, then finer. Asking
// for another world ends the work on the one before. Used on the thread of the OpenGL context.
#pragma once

#include <memory>
#include <string>

#include "terrane/gpu/texture.h"
#include "terrane/pack/content.h"

namespace terrane::app {

class MapPreview {
  public:
    static constexpr int kPixels = 256;  // along a side, of 16 blocks each

    struct World {
        std::string generator;
        std::uint64_t seed = 0;
        bool operator==(const World&) const = default;
    };

    explicit MapPreview(const pack::Content& content);  // outlives this
    ~MapPreview();                                      // ends the work, within the time of a row of chunks
    MapPreview(const MapPreview&) = delete;
    MapPreview& operator=(const MapPreview&) = delete;

    // Each frame. Takes over what the thread has drawn.
    void show(const World& world);
    // The OpenGL texture, 0 before there is one; its first row is the northern one.
    unsigned image() const { return texture_ ? texture_->id() : 0; }
    bool isComplete() const { return isComplete_; }
    const std::string& problem() const { return problem_; }

  private:
    struct Work;

    std::unique_ptr<Work> work_;
    std::unique_ptr<gpu::Texture2D> texture_;
    bool isComplete_ = false;
    std::string problem_;
};

}  // namespace terrane::app
