#include "apps/terrane/record/script.h"

#include <algorithm>

namespace terrane::app {

const Shot& shotAt(const Script& script, double seconds) {
    const auto after = std::ranges::upper_bound(script.shots, seconds + kTimeSlack, {}, &Shot::start);
    return after == script.shots.begin() ? *after : *(after - 1);
}

const GraphicsOptions& optionsAt(const Shot& shot, double secondsInShot) {
    const auto after =
        std::ranges::upper_bound(shot.options, secondsInShot + kTimeSlack, {}, &OptionsCue::time);
    return after == shot.options.begin() ? after->graphics : (after - 1)->graphics;
}

}  // namespace terrane::app
