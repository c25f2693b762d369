#include "terrane/base/printable.h"

#include <algorithm>
#include <cstddef>

#include "terrane/base/utf8.h"

namespace terrane::base {
namespace {

// C0, DEL and C1 (U+009B begins an escape sequence), line separators, and marks of the text direction, which
// can hide or reorder the rest of a line.
bool isControl(char32_t code) {
    return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x61C || code == 0x200E ||
           code == 0x200F || (code >= 0x2028 && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

}  // namespace

std::string printable(std::string_view text) {
    std::string line;
    line.reserve(text.size());
    while (!text.empty()) {
        const Character c = firstCharacter(text);
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
