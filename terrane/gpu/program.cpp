#include "terrane/gpu/program.h"

#include <cassert>
#include <span>
#include <string>
#include <string_view>

namespace terrane::gpu {
namespace {

GLenum shaderType(ShaderStage stage) {
    switch (stage) {
        case ShaderStage::Vertex:
            return GL_VERTEX_SHADER;
        case ShaderStage::Fragment:
            return GL_FRAGMENT_SHADER;
        case ShaderStage::Compute:
            return GL_COMPUTE_SHADER;
    }
    return GL_NONE;
}

// Without the final zero and the line ends before it.
std::string trimmedLog(std::string log) {
    while (!log.empty() && (log.back() == '\0' || log.back() == '\n')) log.pop_back();
    return log;
}

std::string shaderLog(GLuint id) {
    GLint sizeBytes = 0;
    glGetShaderiv(id, GL_INFO_LOG_LENGTH, &sizeBytes);
    std::string log(static_cast<std::size_t>(sizeBytes), '\0');
    if (sizeBytes > 0) glGetShaderInfoLog(id, sizeBytes, nullptr, log.data());
    return trimmedLog(std::move(log));
}

std::string programLog(GLuint id) {
    GLint sizeBytes = 0;
    glGetProgramiv(id, GL_INFO_LOG_LENGTH, &sizeBytes);
    std::string log(static_cast<std::size_t>(sizeBytes), '\0');
    if (sizeBytes > 0) glGetProgramInfoLog(id, sizeBytes, nullptr, log.data());
    return trimmedLog(std::move(log));
}

// Error messages are one line.
std::string inOneLine(std::string_view log) {
    std::string line;
    for (const char c : log) c == '\n' ? line += " | " : line += c;
    return line;
}

base::Result<Handle<ObjectKind::Shader>> compile(const ShaderSource& source, ShaderStage stage) {
    assert(!source.files.empty() && "a source comes from a file");
    Handle<ObjectKind::Shader> shader(glCreateShader(shaderType(stage)));
    const GLuint id = shader.id();
    shader.label(source.files.front());
    const char* text = source.text.c_str();
    const auto length = static_cast<GLint>(source.text.size());
    glShaderSource(id, 1, &text, &length);
    glCompileShader(id);
    GLint compiled = GL_FALSE;
    glGetShaderiv(id, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_FALSE)
        return base::fail("{}: the shader does not compile: {}", source.files.front(),
                          inOneLine(replaceSourceNumbers(shaderLog(id), source.files)));
    return shader;
}

struct ProgramStage {
    ShaderStage stage;
    std::string_view name;
};

base::Result<Handle<ObjectKind::Program>> linkProgram(const ShaderLoader& loader,
                                                      std::span<const ProgramStage> stages,
                                                      const ShaderDefines& defines, std::string_view label) {
    const GLuint id = glCreateProgram();
    Handle<ObjectKind::Program> program(id);
    program.label(label);
    for (const ProgramStage& stage : stages) {
        const ShaderSource source = TERRANE_TRY(loader.load(stage.name, stage.stage, defines));
        const Handle<ObjectKind::Shader> shader = TERRANE_TRY(compile(source, stage.stage));
        glAttachShader(id, shader.id());  // the program keeps the shader until it is deleted itself
    }
    glLinkProgram(id);
    GLint linked = GL_FALSE;
    glGetProgramiv(id, GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE)
        return base::fail("{}: the program does not link: {}", label, inOneLine(programLog(id)));
    return program;
}

}  // namespace

base::Result<Program> Program::graphics(const ShaderLoader& loader, std::string_view vertexName,
                                        std::string_view fragmentName, const ShaderDefines& defines,
                                        std::string_view label) {
    const ProgramStage stages[] = {{ShaderStage::Vertex, vertexName}, {ShaderStage::Fragment, fragmentName}};
    auto linked = TERRANE_TRY(linkProgram(loader, stages, defines, label));
    return Program(std::move(linked));
}

base::Result<Program> Program::compute(const ShaderLoader& loader, std::string_view name,
                                       const ShaderDefines& defines, std::string_view label) {
    const ProgramStage stages[] = {{ShaderStage::Compute, name}};
    auto linked = TERRANE_TRY(linkProgram(loader, stages, defines, label));
    return Program(std::move(linked));
}

void Program::use() const {
    assert(id() != 0 && "an empty program cannot run");
    glUseProgram(id());
}

void Program::useNone() {
    glUseProgram(0);
}

void Program::set(GLint location, GLuint value) const {
    glProgramUniform1ui(id(), location, value);
}
void Program::set(GLint location, glm::uvec4 value) const {
    glProgramUniform4uiv(id(), location, 1, &value.x);
}

}  // namespace terrane::gpu
