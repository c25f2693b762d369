// A linked GL program of shaders found by a ShaderLoader. It is used on the thread of its context.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <string_view>
#include <utility>

#include "terrane/base/result.h"
#include "terrane/gpu/handle.h"
#include "terrane/gpu/shader_loader.h"

namespace terrane::gpu {

class Program {
  public:
    // Compiles and links a program. Errors are one line: the shader or program, then the driver's messages,
    // separated by " | ". Messages of the compiler have file and line.
    [[nodiscard]] static base::Result<Program> graphics(const ShaderLoader& loader,
                                                        std::string_view vertexName,
                                                        std::string_view fragmentName,
                                                        const ShaderDefines& defines, std::string_view label);
    [[nodiscard]] static base::Result<Program> compute(const ShaderLoader& loader, std::string_view name,
                                                       const ShaderDefines& defines, std::string_view label);
    Program() = default;

    void use() const;
    // Makes no program current. Some drivers check the textures of the current program at each clear,
    // including those deleted since its last draw.
    static void useNone();

    // Sets a uniform by its explicit location: layout(location = 0) uniform uint …
    void set(GLint location, GLuint value) const;
    void set(GLint location, glm::uvec4 value) const;

    [[nodiscard]] GLuint id() const { return handle_.id(); }

  private:
    explicit Program(Handle<ObjectKind::Program> handle) : handle_(std::move(handle)) {}

    Handle<ObjectKind::Program> handle_;
};

}  // namespace terrane::gpu
