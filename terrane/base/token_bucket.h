// A token bucket, which limits what a client may do: `perSecond` on average, `most` at once. A plain value.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

namespace terrane::base {

class TokenBucket {
  public:
    using Time = std::chrono::steady_clock::time_point;

    // Starts full.
    TokenBucket(double perSecond, double most) : perSecond_(perSecond), most_(most), tokens_(most) {}

    // Takes `count` tokens, or returns false and takes nothing if there are fewer. `now` never decreases.
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

    // Takes tokens even if there are too few: take() then fails until they are refilled.
    void spend(double count) { tokens_ -= count; }

  private:
    double perSecond_, most_, tokens_;
    std::optional<Time> last_;
};

}  // namespace terrane::base
