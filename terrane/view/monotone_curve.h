// A smooth curve through values at given times. Between two values it stays between them, without overshoot.
// Any thread.
#pragma once

#include <vector>

namespace terrane::view {

class MonotoneCurve {
  public:
    // As many times as values, at least one; times ascend strictly.
    MonotoneCurve(std::vector<double> times, std::vector<double> values);

    // The first value before the first time, the last one after the last.
    double at(double time) const;

  private:
    std::vector<double> times_, values_, slopes_;
};

}  // namespace terrane::view
