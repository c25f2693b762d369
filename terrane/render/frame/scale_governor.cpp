#include "terrane/render/frame/scale_governor.h"

#include <algorithm>
#include <utility>

#include "terrane/base/statistics.h"

namespace terrane::render {
namespace {

constexpr int kScales[] = {50, 60, 67, 75, 85, 100};

// A part of a frame does not depend on its pixels.
double predicted(double milliseconds, int from, int to) {
    constexpr double kFixed = 0.4;
    const double side = static_cast<double>(to) / from;
    return milliseconds * (kFixed + (1 - kFixed) * side * side);
}

}  // namespace

std::vector<int> governedScales(int most) {
    std::vector<int> scales;
    for (const int scale : kScales)
        if (scale < most) scales.push_back(scale);
    scales.push_back(most);
    return scales;
}

int ScaleGovernor::scaleFor(int most) const {
    return scale_ == 0 ? most : std::min(scale_, most);
}

void ScaleGovernor::set(int scale) {
    scale_ = scale;
    quietWindows_ = 0;
}

void ScaleGovernor::add(const Frame& frame, double targetMilliseconds, int most) {
    if (!frame.isComplete) {
        milliseconds_.clear();
        seconds_ = 0;
        return;
    }
    milliseconds_.push_back(frame.milliseconds);
    seconds_ += frame.seconds;
    if (seconds_ < kWindowSeconds || milliseconds_.size() < kLeastFrames) return;
    const double median = base::medianOf(milliseconds_);
    milliseconds_.clear();
    seconds_ = 0;
    judge(median, targetMilliseconds, most);
}

void ScaleGovernor::judge(double milliseconds, double target, int most) {
    const std::vector<int> scales = governedScales(most);
    const int scale = scaleFor(most);
    if (windowsInVain_ > 0) --windowsInVain_;
    if (before_ > 0) {
        // Where pixels are not what takes the time, a smaller image is only worse.
        const bool isInVain = milliseconds > kLeastGain * millisecondsBefore_;
        const int before = std::exchange(before_, 0);
        if (isInVain) {
            windowsInVain_ = kWindowsInVain;
            return set(std::min(before, most));
        }
    }
    const auto here = std::ranges::lower_bound(scales, scale);
    if (milliseconds > kTooLong * target && here != scales.begin() && windowsInVain_ == 0) {
        // As far down as it should take, at least one step.
        auto to = here - 1;
        while (to != scales.begin() && predicted(milliseconds, scale, *to) > target) --to;
        before_ = scale;
        millisecondsBefore_ = milliseconds;
        return set(*to);
    }
    const bool canGrow = here + 1 < scales.end() &&
                         milliseconds * *(here + 1) * *(here + 1) < kRoomToGrow * target * scale * scale;
    quietWindows_ = canGrow ? quietWindows_ + 1 : 0;
    if (quietWindows_ >= kQuietWindows) set(*(here + 1));
}

}  // namespace terrane::render
