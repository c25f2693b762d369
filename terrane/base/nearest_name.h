// Finds the known name that a misspelled word probably means. Pure functions; any thread.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace terrane::base {

// The number of bytes to insert, delete, replace or swap with the next one to turn one text into the other.
// No byte is changed twice ("optimal string alignment").
[[nodiscard]] std::size_t editDistance(std::string_view a, std::string_view b);

// The name at the smallest edit distance, of equal ones the first. Empty if none is near: the distance may be
// at most a third of the longer text, or 1, and must be less than its length.
[[nodiscard]] std::string nearestName(std::string_view word, std::span<const std::string> names);

// "; did you mean NAME?", to append to an error; empty if no name is near.
[[nodiscard]] std::string didYouMean(std::string_view word, std::span<const std::string> names);

// "expected one of low, high, got "hihg"; did you mean high?"
[[nodiscard]] std::string notOneOf(std::span<const std::string> names, std::string_view word);

}  // namespace terrane::base
