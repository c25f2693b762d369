// Parses the target of a request, path and query, from any bytes. Plain values; any thread.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace terrane::web {

// Longer targets, and targets with more parts, are rejected.
constexpr std::size_t kMaxTargetBytes = 1024, kMaxSegments = 8, kMaxParameters = 8;

struct Parameter {
    std::string name, value;
};

// "/a/b?x=1": segments a, b; one parameter. "/" has no segments.
struct Target {
    std::vector<std::string> segments;
    std::vector<Parameter> query;

    // The value of the first parameter of this name, if any.
    std::optional<std::string_view> parameter(std::string_view name) const;
};

// Decodes percent escapes (RFC 3986); "+" is a plus. No value if the target is not an absolute path, or has
// invalid escapes, or has control characters or bytes above 0x7e outside of escapes. Also no value for
// segments that are empty, "." or "..", or contain a slash, backslash or zero byte after decoding.
std::optional<Target> parseTarget(std::string_view target);

}  // namespace terrane::web
