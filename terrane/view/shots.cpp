#include "terrane/view/shots.h"

#include <algorithm>

namespace terrane::view {

const Shot& shotAt(std::span<const Shot> shots, double seconds) {
    const auto after = std::ranges::upper_bound(shots, seconds + kTimeSlack, {}, &Shot::start);
    return after == shots.begin() ? *after : *(after - 1);
}

const OptionsCue& optionsAt(const Shot& shot, double secondsInShot) {
    const auto after =
        std::ranges::upper_bound(shot.options, secondsInShot + kTimeSlack, {}, &OptionsCue::time);
    return after == shot.options.begin() ? *after : *(after - 1);
}

}  // namespace terrane::view
