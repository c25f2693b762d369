// GPU memory budget, and the view distance that fits it. Pure functions; any thread.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "terrane/gpu/device_info.h"

namespace terrane::view {

// `mebibytes` if given; else half of the free memory that the driver reports, at least 256 MiB, or 2 GiB if
// it reports none. The other half is for other programs, and for generation and light on the GPU.
std::size_t gpuMemoryBudget(const gpu::DeviceInfo& device, std::optional<int> mebibytes);

// Memory of the chunks on screen, and its limit.
struct MemoryNeed {
    std::size_t chunks = 0;
    std::size_t bytes = 0, limitBytes = 0;
};

constexpr int kMinViewDistance = 1;

// Returns the view distance to use after memory ran out: the largest smaller one whose chunks take at most
// 15/16 of the limit, if each takes the mean of those on screen. A sixteenth is left for denser places. The
// chunks include one ring around the view, which stays while the camera moves. At least kMinViewDistance;
// `distance` itself if that is no larger.
int fittingViewDistance(const MemoryNeed& need, int distance);

std::string shortViewNotice(int requested, int reached, std::size_t budgetBytes);

}  // namespace terrane::view
