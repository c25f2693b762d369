// Which known name somebody may have meant by a word that is none. Pure functions: any thread may call.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace terrane::base {

// How many bytes must be inserted, deleted, replaced, or swapped with the next one, to make one of the other.
// No byte is changed twice ("optimal string alignment").
[[nodiscard]] std::size_t editDistance(std::string_view a, std::string_view b);

// The name at the smallest distance, of equal ones the first; empty where none is near: at most a third of
// the longer one's bytes may differ, or one, and something must be the same.
[[nodiscard]] std::string nearestName(std::string_view word, std::span<const std::string> names);

// "; did you mean NAME?", to stand behind an error; empty where no name is near.
[[nodiscard]] std::string didYouMean(std::string_view word, std::span<const std::string> names);

// "expected one of low, high, got "hihg"; did you mean high?"
[[nodiscard]] std::string notOneOf(std::span<const std::string> names, std::string_view word);

}  // namespace terrane::base
