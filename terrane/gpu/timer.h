// GPU time of named parts of a frame, read some frames later so that nothing waits. The renderer uses it on
// the context's thread.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/gpu/handle.h"

namespace terrane::gpu {

struct GpuTiming {
    std::string name;
    double milliseconds = 0.0;
};

class GpuTimer {
  public:
    GpuTimer() = default;
    GpuTimer(GpuTimer&&) = default;
    GpuTimer& operator=(GpuTimer&&) = default;
    GpuTimer(const GpuTimer&) = delete;
    GpuTimer& operator=(const GpuTimer&) = delete;
    ~GpuTimer() = default;

    // Ends the frame before, reads the results of frames that the GPU has finished, and starts the next. A
    // frame is not measured when the GPU is as many frames behind as there are in the ring.
    void nextFrame();

    // Begins a zone. Zones may be nested, and all end within their frame.
    void begin(std::string_view name);
    void end();

    // Times of the newest finished frame, in the order of begin(); empty until there is one.
    [[nodiscard]] const std::vector<GpuTiming>& results() const { return results_; }

  private:
    static constexpr std::size_t kFrames = 4;  // drivers queue up to three

    struct Zone {
        std::string name;
        Handle<ObjectKind::Query> begin;
        Handle<ObjectKind::Query> end;
    };
    struct Frame {
        std::vector<Zone> zones;  // reused with their queries
        std::size_t usedZones = 0;
        std::size_t lastEnded = 0;  // the zone that ended last
        bool pending = false;
    };

    [[nodiscard]] static bool finished(const Frame& frame);
    void readResults(const Frame& frame);

    std::array<Frame, kFrames> frames_;
    std::size_t current_ = 0;
    bool recording_ = false;
    std::vector<std::size_t> open_;  // zones begun and not ended
    std::vector<GpuTiming> results_;
};

}  // namespace terrane::gpu
