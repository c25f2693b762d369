// How much of something a client may do: `perSecond` on average, `most` at once. A plain value.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

namespace terrane::base {

class TokenBucket {
  public:
    using Time = std::chrono::steady_clock::time_point;

    // Full at first.
    TokenBucket(double perSecond, double most) : perSecond_(perSecond), most_(most), tokens_(most) {}

    // Takes `count` tokens where there are as many; false, and nothing is taken, where not. `now` never goes
    // back.
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

    // Takes tokens that may not be there: others wait until they have come.
    void spend(double count) { tokens_ -= count; }

  private:
    double perSecond_, most_, tokens_;
    std::optional<Time> last_;
};

}  // namespace terrane::base
