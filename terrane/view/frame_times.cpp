#include "terrane/view/frame_times.h"

#include <chrono>

#include "terrane/base/machine.h"
#include "terrane/base/statistics.h"

namespace terrane::view {

FrameTimes measureFrames(render::Renderer& renderer, const render::FrameInput& input, int count) {
    using FrameClock = std::chrono::steady_clock;
    FrameTimes times;
    const double cpuBefore = base::cpuSeconds();
    for (int k = 0; k < count; ++k) {
        const auto start = FrameClock::now();
        renderer.draw(input);
        glFinish();
        times.milliseconds.push_back(
            std::chrono::duration<double, std::milli>(FrameClock::now() - start).count());
        // Pass times are those of the previous frame, which the GPU has finished. The one before the first
        // frame does not count.
        if (k == 0 && count > 1) continue;
        for (const gpu::GpuTiming& pass : renderer.passTimes())
            times.passes[pass.name].push_back(pass.milliseconds);
    }
    if (count > 0) times.cpuMilliseconds = 1000 * (base::cpuSeconds() - cpuBefore) / count;
    return times;
}

std::map<std::string, double> passMedians(const FrameTimes& times) {
    std::map<std::string, double> medians;
    for (const auto& [name, milliseconds] : times.passes) medians[name] = base::medianOf(milliseconds);
    return medians;
}

}  // namespace terrane::view
