#include "terrane/base/toml.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>

#include "terrane/base/text.h"

namespace terrane::base {
namespace {

// The offset after the string that begins at `at`. A string of one line ends with it.
std::size_t endOfString(std::string_view text, std::size_t at) {
    const char quote = text[at];
    const std::string three(3, quote);
    const bool isLong = text.substr(at).starts_with(three), hasEscapes = quote == '"';
    for (at += isLong ? 3 : 1; at < text.size(); ++at) {
        if (hasEscapes && text[at] == '\\' && at + 1 < text.size() && text[at + 1] != '\n') {
            ++at;
        } else if (isLong && text.substr(at).starts_with(three)) {
            at += 3;
            // Two more may belong to its content.
            for (int k = 0; k < 2 && at < text.size() && text[at] == quote; ++k) ++at;
            return at;
        } else if (!isLong && text[at] == quote) {
            return at + 1;
        } else if (!isLong && text[at] == '\n') {
            return at;
        }
    }
    return at;
}

bool isOfKey(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return std::isalnum(byte) != 0 || byte >= 0x80 || c == '-' || c == '_' || c == ' ' || c == '\t';
}

// The line of a key with too many parts; 0 if there is none.
std::ptrdiff_t lineOfLongKey(std::string_view text) {
    int dots = 0;
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        if (c == '"' || c == '\'') {
            at = endOfString(text, at);
            continue;
        }
        if (c == '#') {
            at = std::min(text.find('\n', at), text.size());
            continue;
        }
        if (c == '.')
            ++dots;
        else if (!isOfKey(c))
            dots = 0;
        if (dots >= kMaxKeyParts) return 1 + std::ranges::count(text.substr(0, at), '\n');
        ++at;
    }
    return 0;
}

tl::unexpected<Error> wrongSyntax(std::string_view name, std::ptrdiff_t line, std::string_view what) {
    return fail(ErrorCode::BadInput, "{}", inOneLine(fmt::format("{}:{}: syntax: {}", name, line, what)));
}

}  // namespace

Result<toml::table> parseToml(std::string_view text, std::string_view name) {
    if (const std::ptrdiff_t line = lineOfLongKey(text); line > 0)
        return wrongSyntax(name, line, fmt::format("a key has more than {} parts", kMaxKeyParts));
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {  // the only way this library tells of wrong syntax
        return wrongSyntax(name, static_cast<std::ptrdiff_t>(error.source().begin.line), error.description());
    }
}

}  // namespace terrane::base
