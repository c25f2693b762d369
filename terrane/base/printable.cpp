#include "terrane/base/printable.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace terrane::base {
namespace {

// Bytes of the character at the start of the text by its first byte; 0: no character starts so.
std::size_t lengthByFirst(unsigned char first) {
    if (first < 0x80) return 1;
    if (first >= 0xC2 && first < 0xE0) return 2;
    if (first >= 0xE0 && first < 0xF0) return 3;
    return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

struct Character {
    std::uint32_t code = 0;
    std::size_t bytes = 0;  // 0: no UTF-8
};

// The Unicode standard, section 3.9, table 3-7: longer forms than needed and surrogates are no UTF-8.
Character firstOf(std::string_view text) {
    constexpr std::array<std::uint32_t, 5> kLeast = {0, 0, 0x80, 0x800, 0x10000};
    const auto first = static_cast<unsigned char>(text.front());
    const std::size_t bytes = lengthByFirst(first);
    if (bytes == 0 || bytes > text.size()) return {};
    std::uint32_t code = bytes == 1 ? first : first & (0x7Fu >> bytes);
    for (std::size_t k = 1; k < bytes; ++k) {
        const auto next = static_cast<unsigned char>(text[k]);
        if ((next & 0xC0) != 0x80) return {};
        code = code << 6 | (next & 0x3F);
    }
    if (code < kLeast[bytes] || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return {};
    return {code, bytes};
}

// C0, DEL and C1 (a terminal takes U+009B for the start of an escape sequence), ends of lines, and marks of
// the direction of text, which can hide or reorder the rest of a line.
bool isControl(std::uint32_t code) {
    return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x61C || code == 0x200E ||
           code == 0x200F || (code >= 0x2028 && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

}  // namespace

std::string printable(std::string_view text) {
    std::string line;
    line.reserve(text.size());
    while (!text.empty()) {
        const Character c = firstOf(text);
        const std::string_view bytes = text.substr(0, std::max<std::size_t>(c.bytes, 1));
        if (c.bytes > 0 && !isControl(c.code)) {
            line += bytes;
        } else {
            for (const char byte : bytes) line += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
        }
        text.remove_prefix(bytes.size());
    }
    return line;
}

namespace detail {

void printLine(fmt::string_view format, fmt::format_args args) {
    fmt::print("{}\n", printable(fmt::vformat(format, args)));
}

}  // namespace detail

}  // namespace terrane::base
