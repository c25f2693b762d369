// Caches a value that is expensive to compute and computes it again after a pause. Any thread, one at a time.
#pragma once

namespace terrane::base {

template <class T>
class TimedValue {
  public:
    explicit TimedValue(double pauseSeconds) : pauseSeconds_(pauseSeconds) {}

    // Calls `find()` if there is no value yet or the last one is older than the pause.
    template <class Find>
    const T& at(double seconds, Find find) {
        if (!isFound_ || seconds - foundAt_ >= pauseSeconds_) {
            value_ = find();
            foundAt_ = seconds;
            isFound_ = true;
        }
        return value_;
    }

  private:
    double pauseSeconds_, foundAt_ = 0;
    bool isFound_ = false;
    T value_{};
};

}  // namespace terrane::base
