// Finds shaders and their includes: files embedded in the program, or, while developing, the files of a
// source tree, which may change while the program runs. Made once by the program, used on the threads of its
// GL contexts.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "terrane/base/embedded.h"
#include "terrane/base/result.h"
#include "terrane/gpu/shader_source.h"

namespace terrane::gpu {

class ShaderLoader {
  public:
    // A file under shaderRoot comes before the embedded one of the same path; an empty root is not looked at.
    explicit ShaderLoader(std::span<const base::EmbeddedFile> embedded,
                          std::filesystem::path shaderRoot = {});

    // More embedded files; they outlive the loader.
    void addFiles(std::span<const base::EmbeddedFile> embedded);

    // The complete text for the compiler, by the path under which it is embedded
    // ("terrane/render/sky.frag.glsl").
    [[nodiscard]] base::Result<ShaderSource> load(std::string_view name, ShaderStage stage,
                                                  const ShaderDefines& defines) const;

    [[nodiscard]] std::optional<std::string> find(std::string_view path) const;

    // When the newest .glsl or .h file in the root's folder terrane was written; none without such files.
    // Looks at every file there, 1 ms or so: for development, once in a while.
    [[nodiscard]] std::optional<std::filesystem::file_time_type> newestWrite() const;

  private:
    std::map<std::string, std::string_view, std::less<>> embedded_;
    std::filesystem::path shaderRoot_;
};

}  // namespace terrane::gpu
