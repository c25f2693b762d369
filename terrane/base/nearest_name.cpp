#include "terrane/base/nearest_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <vector>

namespace terrane::base {

// Row i has the distances of the first i bytes of a from all prefixes of b; three rows are kept.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::array<std::vector<std::size_t>, 3> rows;
    for (auto& row : rows) row.resize(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) rows[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::vector<std::size_t>&row = rows[i % 3], &above = rows[(i + 2) % 3], &twoAbove = rows[(i + 1) % 3];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool isSame = a[i - 1] == b[j - 1];
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (isSame ? 0 : 1)});
            const bool isSwapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (isSwapped) row[j] = std::min(row[j], twoAbove[j - 2] + 1);
        }
    }
    return rows[a.size() % 3][b.size()];
}

std::string nearestName(std::string_view word, std::span<const std::string> names) {
    constexpr std::size_t kMaxNameBytes = 100;  // a longer word is no misspelled name
    std::string nearest;
    std::size_t smallest = kMaxNameBytes;
    for (const std::string& name : names) {
        const std::size_t longer = std::max(word.size(), name.size());
        if (longer > kMaxNameBytes) continue;
        const std::size_t distance = editDistance(word, name);
        const bool isNear = distance <= std::max<std::size_t>(1, longer / 3) && distance < longer;
        if (!isNear || distance >= smallest) continue;
        smallest = distance;
        nearest = name;
    }
    return nearest;
}

std::string didYouMean(std::string_view word, std::span<const std::string> names) {
    const std::string nearest = nearestName(word, names);
    return nearest.empty() ? std::string() : "; did you mean " + nearest + "?";
}

std::string notOneOf(std::span<const std::string> names, std::string_view word) {
    return fmt::format("expected one of {}, got \"{}\"{}", fmt::join(names, ", "), word,
                       didYouMean(word, names));
}

}  // namespace terrane::base
