// Measures frames that show the same image again and again.
#pragma once

#include <algorithm>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "terrane/render/frame/renderer.h"

namespace terrane::view {

// Measures frame rates: the range over the last second, and the frames in each second.
class FrameMeter {
  public:
    void add(double seconds) {
        frames_.push_back(seconds);
        total_ += seconds;
        while (frames_.size() > 1 && total_ - frames_.front() >= 1) {
            total_ -= frames_.front();
            frames_.pop_front();
        }
        count(seconds);
    }
    // Frames per second.
    double now() const { return total_ > 0 ? static_cast<double>(frames_.size()) / total_ : 0; }
    double min() const { return frames_.empty() ? 0 : 1 / *std::ranges::max_element(frames_); }
    double max() const {
        return frames_.empty() ? 0 : 1 / std::max(*std::ranges::min_element(frames_), 1e-9);
    }
    // Frames that began in the last whole second; 0 in the first.
    int lastSecond() const { return lastSecond_; }
    // Returns the most frequent count of frames in a second, the higher if equal, as the thesis measures; 0
    // in the first second.
    int mode() const {
        const auto most = std::max_element(seconds_.rbegin(), seconds_.rend(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
        return most == seconds_.rend() ? 0 : most->first;
    }

  private:
    void count(double seconds) {
        ++thisSecond_;
        passed_ += seconds;
        for (; passed_ >= 1; passed_ -= 1) {
            lastSecond_ = thisSecond_;
            ++seconds_[thisSecond_];
            thisSecond_ = 0;
        }
    }

    std::deque<double> frames_;  // seconds each
    double total_ = 0;
    double passed_ = 0;  // of this second
    int thisSecond_ = 0, lastSecond_ = 0;
    std::map<int, int> seconds_;  // how many, by the count of their frames
};

struct FrameTimes {
    std::vector<double> milliseconds;                   // of each frame, until the GPU has drawn it
    double cpuMilliseconds = 0;                         // a frame, of all threads, as a mean
    std::map<std::string, std::vector<double>> passes;  // GPU milliseconds of frames, by name
};

// Draws `count` frames on the thread of the context and returns their times.
FrameTimes measureFrames(render::Renderer& renderer, const render::FrameInput& input, int count);

std::map<std::string, double> passMedians(const FrameTimes& times);  // milliseconds by name

}  // namespace terrane::view
