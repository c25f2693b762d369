// Measures frames that show the same image again and again.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "terrane/render/renderer.h"

namespace terrane::view {

struct FrameTimes {
    std::vector<double> milliseconds;                   // of each frame, until the GPU has drawn it
    double cpuMilliseconds = 0;                         // a frame, of all threads, as a mean
    std::map<std::string, std::vector<double>> passes;  // GPU milliseconds of frames, by name
};

// Draws `count` frames, on the thread of the context.
FrameTimes measureFrames(render::Renderer& renderer, const render::FrameInput& input, int count);

std::map<std::string, double> passMedians(const FrameTimes& times);  // milliseconds by name

}  // namespace terrane::view
