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
    // A file under shaderRoot takes precedence over the embedded one of the same path; an empty root is
    // ignored.
    explicit ShaderLoader(std::span<const base::EmbeddedFile> embedded,
                          std::filesystem::path shaderRoot = {});

    // Adds embedded files, which must outlive the loader.
    void addFiles(std::span<const base::EmbeddedFile> embedded);

    // Returns the complete text for the compiler, by the path under which it is embedded
    // ("terrane/render/sky.frag.glsl").
    [[nodiscard]] base::Result<ShaderSource> load(std::string_view name, ShaderStage stage,
                                                  const ShaderDefines& defines) const;

    [[nodiscard]] std::optional<std::string> find(std::string_view path) const;

    // Time of the newest write to a .glsl or .h file in the root's folder terrane; none without such files.
    // Looks at every file there, about 1 ms: for development, once in a while.
    [[nodiscard]] std::optional<std::filesystem::file_time_type> newestWrite() const;

  private:
    std::map<std::string, std::string_view, std::less<>> embedded_;
    std::filesystem::path shaderRoot_;
};

}  // namespace terrane::gpu
