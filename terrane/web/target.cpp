#include "terrane/web/target.h"

#include <algorithm>

#include "terrane/base/hex.h"

namespace terrane::web {
namespace {

std::optional<std::string> decoded(std::string_view text) {
    std::string out;
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (text[k] != '%') {
            out.push_back(text[k]);
            continue;
        }
        if (k + 2 >= text.size()) return std::nullopt;
        const auto byte = base::hexByte(text[k + 1], text[k + 2]);
        if (!byte) return std::nullopt;
        out.push_back(static_cast<char>(*byte));
        k += 2;
    }
    return out;
}

// Splits at separators; an empty text has no parts.
std::vector<std::string_view> parts(std::string_view text, char separator) {
    std::vector<std::string_view> found;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(separator), text.size());
        found.push_back(text.substr(0, end));
        if (end == text.size()) break;
        text.remove_prefix(end + 1);
        if (text.empty()) found.emplace_back();
    }
    return found;
}

bool isSegment(std::string_view segment) {
    constexpr std::string_view kForbidden("/\\\0", 3);
    return !segment.empty() && segment != "." && segment != ".." &&
           segment.find_first_of(kForbidden) == std::string_view::npos;
}

}  // namespace

std::optional<std::string_view> Target::parameter(std::string_view name) const {
    const auto found = std::ranges::find(query, name, &Parameter::name);
    if (found == query.end()) return std::nullopt;
    return found->value;
}

std::optional<Target> parseTarget(std::string_view text) {
    if (text.size() > kMaxTargetBytes || !text.starts_with('/')) return std::nullopt;
    if (std::ranges::any_of(text, [](char c) { return c <= ' ' || c > '~'; })) return std::nullopt;
    const std::size_t pathEnd = std::min(text.find('?'), text.size());
    Target target;
    for (const std::string_view part : parts(text.substr(1, pathEnd - 1), '/')) {
        auto segment = decoded(part);
        if (!segment || !isSegment(*segment) || target.segments.size() == kMaxSegments) return std::nullopt;
        target.segments.push_back(std::move(*segment));
    }
    if (pathEnd == text.size()) return target;
    for (const std::string_view part : parts(text.substr(pathEnd + 1), '&')) {
        const std::size_t equals = std::min(part.find('='), part.size());
        auto name = decoded(part.substr(0, equals));
        auto value = decoded(part.substr(std::min(equals + 1, part.size())));
        if (!name || !value || target.query.size() == kMaxParameters) return std::nullopt;
        target.query.push_back({std::move(*name), std::move(*value)});
    }
    return target;
}

}  // namespace terrane::web
