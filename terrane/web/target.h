// What a browser asks for: the path and query of a request, from any bytes. Plain values; any thread.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace terrane::web {

// Longer targets, and those with more parts, are refused.
constexpr std::size_t kMaxTargetBytes = 1024, kMaxSegments = 8, kMaxParameters = 8;

struct Parameter {
    std::string name, value;
};

// "/a/b?x=1": segments a, b; one parameter. "/" has no segments.
struct Target {
    std::vector<std::string> segments;
    std::vector<Parameter> query;

    // The value of the first parameter of this name; nothing where there is none.
    std::optional<std::string_view> parameter(std::string_view name) const;
};

// Percent escapes are decoded (RFC 3986); "+" is a plus. Nothing for what is no absolute path: a wrong
// escape, a control character or a byte above 0x7e outside of escapes, a segment that is empty, "." or "..",
// or has a slash, a backslash or a zero byte in it once it is decoded.
std::optional<Target> parseTarget(std::string_view target);

}  // namespace terrane::web
