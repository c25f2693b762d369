// Caches a value that is expensive to compute and computes it again after a pause. One thread at a time may
// use it.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

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

// A token bucket, which limits the rate of a client: `perSecond` tokens on average, `most` at once. It is a
// plain value.
class TokenBucket {
  public:
    using Time = std::chrono::steady_clock::time_point;

    // The bucket starts full.
    TokenBucket(double perSecond, double most) : perSecond_(perSecond), most_(most), tokens_(most) {}

    // Removes `count` tokens and returns true, or returns false and removes none if there are fewer. `now`
    // never decreases.
    [[nodiscard]] bool take(double count, Time now) {
        if (last_) {
            const double seconds = std::chrono::duration<double>(now - *last_).count();
            tokens_ = std::min(most_, tokens_ + seconds * perSecond_);
        }
        last_ = now;
        if (tokens_ < count) return false;
        tokens_ -= count;
        return true;
    }

    // Removes tokens even if there are too few: take() then fails until they are refilled.
    void spend(double count) { tokens_ -= count; }

  private:
    double perSecond_, most_, tokens_;
    std::optional<Time> last_;
};

}  // namespace terrane::base
