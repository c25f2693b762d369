#include "terrane/base/utf8.h"

#include <array>
#include <cassert>

namespace terrane::base {
namespace {

// Length of a character in bytes by its first byte; 0 if no character begins with it.
std::size_t lengthByFirst(unsigned char first) {
    if (first < 0x80) return 1;
    if (first >= 0xC2 && first < 0xE0) return 2;
    if (first >= 0xE0 && first < 0xF0) return 3;
    return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

}  // namespace

Character firstCharacter(std::string_view text) {
    assert(!text.empty() && "an empty text has no character");
    constexpr std::array<char32_t, 5> kLeast = {0, 0, 0x80, 0x800, 0x10000};
    const auto first = static_cast<unsigned char>(text.front());
    const std::size_t bytes = lengthByFirst(first);
    if (bytes == 0 || bytes > text.size()) return {};
    char32_t code = bytes == 1 ? first : first & (0x7Fu >> bytes);
    for (std::size_t k = 1; k < bytes; ++k) {
        const auto next = static_cast<unsigned char>(text[k]);
        if ((next & 0xC0) != 0x80) return {};
        code = code << 6 | (next & 0x3Fu);
    }
    if (code < kLeast[bytes] || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return {};
    return {code, bytes};
}

bool isUtf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t bytes = firstCharacter(text).bytes;
        if (bytes == 0) return false;
        text.remove_prefix(bytes);
    }
    return true;
}

}  // namespace terrane::base
