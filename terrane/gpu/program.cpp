#include "terrane/gpu/program.h"

#include <cassert>
#include <utility>

#include "terrane/base/log.h"

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
        return base::fail("{}: the shader does not compile:\n{}", source.files.front(),
                          nameSources(shaderLog(id), source.files));
    return shader;
}

}  // namespace

base::Result<Program> Program::graphics(const ShaderLoader& loader, std::string_view vertexName,
                                        std::string_view fragmentName, const ShaderDefines& defines,
                                        std::string_view label) {
    Recipe recipe{&loader, {}, defines, std::string(label)};
    recipe.stages.push_back({ShaderStage::Vertex, std::string(vertexName)});
    recipe.stages.push_back({ShaderStage::Fragment, std::string(fragmentName)});
    return create(std::move(recipe));
}

base::Result<Program> Program::compute(const ShaderLoader& loader, std::string_view name,
                                       const ShaderDefines& defines, std::string_view label) {
    Recipe recipe{&loader, {}, defines, std::string(label)};
    recipe.stages.push_back({ShaderStage::Compute, std::string(name)});
    return create(std::move(recipe));
}

base::Result<Program> Program::create(Recipe recipe) {
    base::Result<Built> built = build(recipe);
    if (!built) return tl::unexpected(built.error());
    Program program;
    program.recipe_ = std::move(recipe);
    program.built_ = *std::move(built);
    return program;
}

base::Result<Program::Built> Program::build(const Recipe& recipe) {
    std::vector<ShaderSource> sources;
    Built built;
    for (const Stage& stage : recipe.stages) {
        base::Result<ShaderSource> source = recipe.loader->load(stage.name, stage.stage, recipe.defines);
        if (!source) return tl::unexpected(source.error());
        built.files.insert(built.files.end(), source->files.begin(), source->files.end());
        sources.push_back(*std::move(source));
    }
    // Before compiling, which takes long: what is written meanwhile counts as a change.
    built.newestWrite = recipe.loader->newestWrite(built.files);

    const GLuint id = glCreateProgram();
    built.handle = Handle<ObjectKind::Program>(id);
    built.handle.label(recipe.label);
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const base::Result<Handle<ObjectKind::Shader>> shader = compile(sources[i], recipe.stages[i].stage);
        if (!shader) return tl::unexpected(shader.error());
        glAttachShader(id, shader->id());  // the program keeps the shader until it is deleted itself
    }
    glLinkProgram(id);
    GLint linked = GL_FALSE;
    glGetProgramiv(id, GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE)
        return base::fail("{}: the program does not link:\n{}", recipe.label, programLog(id));
    return built;
}

void Program::use() const {
    assert(id() != 0 && "an empty program cannot run");
    glUseProgram(id());
}

void Program::set(GLint location, float value) const {
    glProgramUniform1f(id(), location, value);
}
void Program::set(GLint location, GLint value) const {
    glProgramUniform1i(id(), location, value);
}
void Program::set(GLint location, GLuint value) const {
    glProgramUniform1ui(id(), location, value);
}
void Program::set(GLint location, glm::vec2 value) const {
    glProgramUniform2fv(id(), location, 1, &value.x);
}
void Program::set(GLint location, glm::vec3 value) const {
    glProgramUniform3fv(id(), location, 1, &value.x);
}
void Program::set(GLint location, glm::vec4 value) const {
    glProgramUniform4fv(id(), location, 1, &value.x);
}
void Program::set(GLint location, glm::ivec2 value) const {
    glProgramUniform2iv(id(), location, 1, &value.x);
}
void Program::set(GLint location, glm::ivec3 value) const {
    glProgramUniform3iv(id(), location, 1, &value.x);
}
void Program::set(GLint location, glm::ivec4 value) const {
    glProgramUniform4iv(id(), location, 1, &value.x);
}
void Program::set(GLint location, glm::uvec2 value) const {
    glProgramUniform2uiv(id(), location, 1, &value.x);
}
void Program::set(GLint location, glm::uvec4 value) const {
    glProgramUniform4uiv(id(), location, 1, &value.x);
}
void Program::set(GLint location, const glm::mat4& value) const {
    glProgramUniformMatrix4fv(id(), location, 1, GL_FALSE, &value[0].x);
}

bool Program::reloadIfChanged() {
    assert(recipe_.loader != nullptr && "an empty program has no files");
    const std::filesystem::file_time_type newest = recipe_.loader->newestWrite(built_.files);
    if (newest == built_.newestWrite) return false;
    built_.newestWrite = newest;  // also for a failure, which is not repeated before the next change
    base::Result<Built> built = build(recipe_);
    if (!built) {
        base::logError("{}: kept as it was: {}", recipe_.label, built.error().message);
        return false;
    }
    built_ = *std::move(built);
    base::logInfo("{}: reloaded", recipe_.label);
    return true;
}

}  // namespace terrane::gpu
