#include "terrane/world/heights.h"

#include <fmt/format.h>

namespace terrane::world {

base::Result<void> checkHeights(Heights heights) {
    if (isValid(heights)) return {};
    return base::fail(
        "a world's bottom and top are multiples of {} from {} to {}, the bottom below the top; they are {} "
        "and {}",
        kSectionSize, kLowestBottom, kHighestTop, heights.bottom, heights.top);
}

std::string describe(Heights heights) {
    return fmt::format("{} to {}", heights.bottom, heights.top - 1);
}

}  // namespace terrane::world
