// Bytes in hexadecimal text from outside. Any thread may call.
#pragma once

#include <optional>

namespace terrane::base {

// The byte that two hexadecimal digits give, in upper or lower case.
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

}  // namespace terrane::base
