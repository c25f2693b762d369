#include "terrane/base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdio>
#include <vector>

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

CodePoint firstCodePoint(std::string_view text) {
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
        const std::size_t bytes = firstCodePoint(text).bytes;
        if (bytes == 0) return false;
        text.remove_prefix(bytes);
    }
    return true;
}

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
        const CodePoint c = firstCodePoint(text);
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

std::string inOneLine(std::string message) {
    std::replace_if(
        message.begin(), message.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return message;
}

namespace detail {

void printLine(fmt::string_view format, fmt::format_args args) {
    const std::string line = printable(fmt::vformat(format, args)) + '\n';
    std::fwrite(line.data(), 1, line.size(), stdout);
}

}  // namespace detail

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

std::string expectedOneOf(std::span<const std::string> names, std::string_view word) {
    return fmt::format("expected one of {}, got \"{}\"{}", fmt::join(names, ", "), word,
                       didYouMean(word, names));
}

}  // namespace terrane::base
