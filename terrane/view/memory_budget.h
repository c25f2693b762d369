// How much memory of the graphics card is for Terrane, and how far one sees with it. Pure functions; any
// thread.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "terrane/gpu/device_info.h"

namespace terrane::view {

// `mebibytes` where they are given; else half of what the driver says is free, at least 256 MiB, or 2 GiB
// where it does not tell. The other half is for other programs, and for generation and light on the GPU.
std::size_t gpuMemoryBudget(const gpu::DeviceInfo& device, std::optional<int> mebibytes);

// What the chunks on screen take, and what they may take.
struct MemoryNeed {
    std::size_t chunks = 0;
    std::size_t bytes = 0, limitBytes = 0;
};

constexpr int kMinViewDistance = 1;

// The view distance after the one at which memory ran out: the largest smaller one whose chunks take at most
// 15/16 of the limit, each as many bytes as those on screen take as a mean. A sixteenth is left for denser
// places. The chunks include one ring around the view, which stays while the camera moves. At least
// kMinViewDistance; `distance` itself where that is no larger.
int fittingViewDistance(const MemoryNeed& need, int distance);

std::string shortViewNotice(int requested, int reached, std::size_t budgetBytes);

}  // namespace terrane::view
