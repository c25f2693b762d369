// Finds shaders and their includes: files embedded in the program, or, while developing, the files of a
// source tree, which may change while the program runs. It is made once by the program, used on the threads
// of its GL contexts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "terrane/base/files.h"
#include "terrane/base/result.h"

namespace terrane::gpu {

// The next functions process the text of shaders without OpenGL: they expand includes, write the header and
// name the files in a compiler's log. They are pure; ShaderLoader and offline checks call them.
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

// Returns #version, extensions and defines, which precede the expanded text.
[[nodiscard]] std::string shaderHeader(ShaderStage stage, const ShaderDefines& defines);

// Replaces the source numbers in a compiler's log, "0(12)" or "0:12(5)", by the names of the files.
[[nodiscard]] std::string replaceSourceNumbers(std::string_view log, std::span<const std::string> files);

class ShaderLoader {
  public:
    // A file under shaderRoot takes precedence over the embedded one of the same path; an empty root is
    // ignored.
    explicit ShaderLoader(std::span<const base::EmbeddedFile> embedded,
                          std::filesystem::path shaderRoot = {});

    // Adds embedded files, which must outlive the loader.
    void addFiles(std::span<const base::EmbeddedFile> embedded);

    // Returns the complete text for the compiler, by the path under which it is embedded
    // ("terrane/render/sky/sky.frag.glsl").
    [[nodiscard]] base::Result<ShaderSource> load(std::string_view name, ShaderStage stage,
                                                  const ShaderDefines& defines) const;

    [[nodiscard]] std::optional<std::string> find(std::string_view path) const;

    // Returns the time of the newest write to a .glsl or .h file in the root's folder terrane; none without
    // such files. It visits every file there, which takes about 1 ms: for development, once in a while.
    [[nodiscard]] std::optional<std::filesystem::file_time_type> newestWrite() const;

  private:
    std::map<std::string, std::string_view, std::less<>> embedded_;
    std::filesystem::path shaderRoot_;
};

// Returns a loader of the shaders that are compiled into the program. `shaderRoot` is a source tree whose
// shaders take precedence over the built-in ones, or empty for none.
ShaderLoader builtInShaders(const std::string& shaderRoot);

}  // namespace terrane::gpu
