// Timer zone of a part of a frame. Used by the renderer on the context's thread.
#pragma once

#include <string_view>

#include "terrane/gpu/timer.h"

namespace terrane::render {

// Measures the GPU time of commands during its life.
class TimerZone {
  public:
    TimerZone(gpu::GpuTimer& timer, std::string_view name) : timer_(timer) { timer_.begin(name); }
    ~TimerZone() { timer_.end(); }
    TimerZone(const TimerZone&) = delete;
    TimerZone& operator=(const TimerZone&) = delete;

  private:
    gpu::GpuTimer& timer_;
};

}  // namespace terrane::render
