// Draws a map of a new world on its own thread, coarse at first, then finer. A request for another world
// cancels the work on the last one. Used on the thread of the OpenGL context.
#pragma once

#include <memory>
#include <string>

#include "terrane/gpu/texture.h"
#include "terrane/pack/content.h"

namespace terrane::app {

class MapPreview {
  public:
    static constexpr int kPixels = 256;  // per side, 16 blocks each

    struct World {
        std::string generator;
        std::uint64_t seed = 0;
        bool operator==(const World&) const = default;
    };

    explicit MapPreview(const pack::Content& content);  // outlives this
    ~MapPreview();                                      // waits for a row of chunks
    MapPreview(const MapPreview&) = delete;
    MapPreview& operator=(const MapPreview&) = delete;

    // Call each frame with the world to show. Uploads what the thread has drawn.
    void show(const World& world);
    // The OpenGL texture, 0 before the first one; the first row is the northern one.
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
