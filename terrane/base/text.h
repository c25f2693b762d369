// Text from outside: hexadecimal digits, UTF-8, output that is safe for terminals, and near matches of
// misspelled names. All functions are pure; any thread may call them.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace terrane::base {

// Returns the byte that two hexadecimal digits give, in upper or lower case.
[[nodiscard]] constexpr std::optional<unsigned char> hexByte(char high, char low) {
    const auto digit = [](char c) {
        if (c >= '0' && c <= '9') return c - '0';
        if (c >= 'a' && c <= 'f') return c - 'a' + 10;
        return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
    };
    const int upper = digit(high), lower = digit(low);
    if (upper < 0 || lower < 0) return std::nullopt;
    return static_cast<unsigned char>(upper * 16 + lower);
}

// A decoded code point of UTF-8 (the Unicode standard, section 3.9, table 3-7: overlong forms, surrogates and
// codes beyond U+10FFFF are invalid).
struct CodePoint {
    char32_t code = 0;
    std::size_t bytes = 0;  // 0: the text does not begin with valid UTF-8
};

// Decodes the first code point of a text that is not empty.
[[nodiscard]] CodePoint firstCodePoint(std::string_view text);

[[nodiscard]] bool isUtf8(std::string_view text);

// Makes text of unknown origin safe for a terminal: names and values in files can hold escape sequences that
// change colors, titles or earlier output. The result is one line: control characters (also those of Unicode
// that reorder or break lines) and bytes that are not UTF-8 become \xNN for each byte.
[[nodiscard]] std::string printable(std::string_view text);

// Returns the message without line breaks, which texts of a file may have: an error is one line.
[[nodiscard]] std::string inOneLine(std::string message);

// Returns "1 block", "2 blocks": `what` is a noun whose plural has an s.
[[nodiscard]] inline std::string counted(std::uint64_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

namespace detail {
void printLine(fmt::string_view format, fmt::format_args args);
}

// Prints a line of results to standard output, made printable.
template <class... Args>
void printLine(fmt::format_string<Args...> format, Args&&... args) {
    detail::printLine(format, fmt::make_format_args(args...));
}

// Returns the number of bytes to insert, delete, replace or swap with the next one to turn one text into the
// other. No byte is changed twice ("optimal string alignment").
[[nodiscard]] std::size_t editDistance(std::string_view a, std::string_view b);

// Returns the name at the smallest edit distance, of equal ones the first. The result is empty if none is
// near: the distance may be at most a third of the longer text, or 1, and must be less than its length.
[[nodiscard]] std::string nearestName(std::string_view word, std::span<const std::string> names);

// Returns "; did you mean NAME?", to append to an error; the text is empty if no name is near.
[[nodiscard]] std::string didYouMean(std::string_view word, std::span<const std::string> names);

// Returns the text of an error: "expected one of low, high, got "hihg"; did you mean high?"
[[nodiscard]] std::string expectedOneOf(std::span<const std::string> names, std::string_view word);

}  // namespace terrane::base
