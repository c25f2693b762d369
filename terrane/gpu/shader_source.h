// Text processing of shaders, without OpenGL: expanding includes, the lines before the first one, and naming
// the files in a compiler's log. Pure functions, for ShaderLoader and for offline checks.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "terrane/base/result.h"

namespace terrane::gpu {

enum class ShaderStage : std::uint8_t { Vertex, Fragment, Compute };

// Name and value of each #define, in order.
using ShaderDefines = std::vector<std::pair<std::string, std::string>>;

// Returns the text of a file by the path that #include names; none if there is no such file.
using ShaderLookup = std::function<std::optional<std::string>(std::string_view path)>;

struct ShaderSource {
    std::string text;
    std::vector<std::string> files;  // by the source number that #line gives
};

// Replaces every #include "path" by the file, once per source, and writes #line so that the compiler's
// messages have the file's number and line. Text between #ifdef __cplusplus and #else or #endif is left out.
// Includes under any other condition are always expanded. Fails with "file:line: …".
[[nodiscard]] base::Result<ShaderSource> expandIncludes(std::string_view name, const ShaderLookup& lookup);

// #version, extensions and defines, which precede the expanded text.
[[nodiscard]] std::string shaderHeader(ShaderStage stage, const ShaderDefines& defines);

// Replaces the source numbers in a compiler's log, "0(12)" or "0:12(5)", by the names of the files.
[[nodiscard]] std::string nameSources(std::string_view log, std::span<const std::string> files);

}  // namespace terrane::gpu
