// How long frames take: the last one, and the range over the last second.
#pragma once

#include <algorithm>
#include <deque>

namespace terrane::app {

class FrameMeter {
  public:
    void add(double seconds) {
        frames_.push_back(seconds);
        total_ += seconds;
        while (frames_.size() > 1 && total_ - frames_.front() >= 1) {
            total_ -= frames_.front();
            frames_.pop_front();
        }
    }
    // Frames a second.
    double now() const { return total_ > 0 ? static_cast<double>(frames_.size()) / total_ : 0; }
    double min() const { return frames_.empty() ? 0 : 1 / *std::ranges::max_element(frames_); }
    double max() const {
        return frames_.empty() ? 0 : 1 / std::max(*std::ranges::min_element(frames_), 1e-9);
    }

  private:
    std::deque<double> frames_;  // seconds each
    double total_ = 0;
};

}  // namespace terrane::app
