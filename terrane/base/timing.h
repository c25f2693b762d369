// Values that depend on time: values computed again after a pause, rates, reports of failures. Times are of
// the steady clock and come from the caller. One thread at a time may use an object.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

namespace terrane::base {

// Caches a value that is expensive to compute and computes it again after a pause.
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

// Decides what a log tells of something that is tried again and again, such as writing to a full disk: its
// first failure, and that it works again once it has not failed for a while. Without the while, a disk that
// takes every second write would fill the log.
class FailureReport {
  public:
    using Time = std::chrono::steady_clock::time_point;

    explicit FailureReport(std::chrono::milliseconds quiet) : quiet_(quiet) {}

    // Call after each failure. Returns whether to report it.
    [[nodiscard]] bool hasBegun() {
        reportAt_ = Time::max();
        return !std::exchange(isFailing_, true);
    }
    // Call after each success, and at reportAt(). Returns whether to report that it works again.
    [[nodiscard]] bool hasEnded(Time now) {
        if (!isFailing_) return false;
        if (reportAt_ == Time::max()) reportAt_ = now + quiet_;
        if (now < reportAt_) return false;
        reportAt_ = Time::max();
        isFailing_ = false;
        return true;
    }
    Time reportAt() const { return reportAt_; }  // max: nothing is to be reported without a further attempt

  private:
    std::chrono::milliseconds quiet_;
    Time reportAt_ = Time::max();
    bool isFailing_ = false;
};

// How long something must work before a log tells so.
constexpr std::chrono::seconds kQuietAfterFailure{10};

}  // namespace terrane::base
