// Hexadecimal digits in text from outside. Any thread may call.
#pragma once

#include <optional>

namespace terrane::base {

// The value of a hexadecimal digit, in upper or lower case.
[[nodiscard]] constexpr std::optional<int> hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return std::nullopt;
}

// The byte that two hexadecimal digits give.
[[nodiscard]] constexpr std::optional<unsigned char> hexByte(char high, char low) {
    const std::optional<int> upper = hexDigit(high), lower = hexDigit(low);
    if (!upper || !lower) return std::nullopt;
    return static_cast<unsigned char>(*upper * 16 + *lower);
}

}  // namespace terrane::base
