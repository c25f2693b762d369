// A linked GL program of shaders found by a ShaderLoader, which can be built again from changed files while
// the program runs. Used on the thread of its context.
#pragma once

#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/gpu/handle.h"
#include "terrane/gpu/shader_loader.h"

namespace terrane::gpu {

class Program {
  public:
    // The loader outlives the program. The error's first line names the shader; the compiler's messages
    // follow, one a line, each with its file and line.
    [[nodiscard]] static base::Result<Program> graphics(const ShaderLoader& loader,
                                                        std::string_view vertexName,
                                                        std::string_view fragmentName,
                                                        const ShaderDefines& defines, std::string_view label);
    [[nodiscard]] static base::Result<Program> compute(const ShaderLoader& loader, std::string_view name,
                                                       const ShaderDefines& defines, std::string_view label);
    Program() = default;

    void use() const;

    // By explicit location: layout(location = 0) uniform float …
    void set(GLint location, float value) const;
    void set(GLint location, GLint value) const;
    void set(GLint location, GLuint value) const;
    void set(GLint location, glm::vec2 value) const;
    void set(GLint location, glm::vec3 value) const;
    void set(GLint location, glm::vec4 value) const;
    void set(GLint location, glm::ivec2 value) const;
    void set(GLint location, glm::ivec3 value) const;
    void set(GLint location, glm::ivec4 value) const;
    void set(GLint location, glm::uvec2 value) const;
    void set(GLint location, glm::uvec4 value) const;
    void set(GLint location, const glm::mat4& value) const;

    // Builds the program again if one of its files was written since it was last built; true if it now is
    // another one, with all uniforms at their defaults. A failure is logged and the old program stays. Asks
    // the file system for every file: for development, a few times a second.
    bool reloadIfChanged();

    [[nodiscard]] GLuint id() const { return built_.handle.id(); }

  private:
    struct Stage {
        ShaderStage stage;
        std::string name;
    };
    // All that building needs.
    struct Recipe {
        const ShaderLoader* loader = nullptr;
        std::vector<Stage> stages;
        ShaderDefines defines;
        std::string label;
    };
    struct Built {
        Handle<ObjectKind::Program> handle;
        std::vector<std::string> files;               // of all stages
        std::filesystem::file_time_type newestWrite;  // of the files, when they were read
    };

    static base::Result<Program> create(Recipe recipe);
    static base::Result<Built> build(const Recipe& recipe);

    Built built_;
    Recipe recipe_;
};

}  // namespace terrane::gpu
