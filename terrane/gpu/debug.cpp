#include "terrane/gpu/debug.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstdlib>

#include "terrane/base/log.h"

namespace terrane::gpu {
namespace {

std::string_view sourceName(GLenum source) {
    switch (source) {
        case GL_DEBUG_SOURCE_API:
            return "api";
        case GL_DEBUG_SOURCE_WINDOW_SYSTEM:
            return "window system";
        case GL_DEBUG_SOURCE_SHADER_COMPILER:
            return "shader compiler";
        case GL_DEBUG_SOURCE_THIRD_PARTY:
            return "third party";
        case GL_DEBUG_SOURCE_APPLICATION:
            return "application";
        default:
            return "other";
    }
}

std::string_view typeName(GLenum type) {
    switch (type) {
        case GL_DEBUG_TYPE_ERROR:
            return "error";
        case GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR:
            return "deprecated";
        case GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR:
            return "undefined behavior";
        case GL_DEBUG_TYPE_PORTABILITY:
            return "portability";
        case GL_DEBUG_TYPE_PERFORMANCE:
            return "performance";
        default:
            return "other";
    }
}

std::string_view trimmed(const GLchar* message, GLsizei length) {
    std::string_view text =
        length < 0 ? std::string_view(message) : std::string_view(message, static_cast<std::size_t>(length));
    while (!text.empty() && (text.back() == '\n' || text.back() == '\0')) text.remove_suffix(1);
    return text;
}

// Signature of GLDEBUGPROC.
void APIENTRY onMessage(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                        const GLchar* message, const void* user) {
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION || source == GL_DEBUG_SOURCE_SHADER_COMPILER) return;
    const std::string line =
        fmt::format("GL {}, {} {}: {}", sourceName(source), typeName(type), id, trimmed(message, length));
    const bool isError = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR ||
                         severity == GL_DEBUG_SEVERITY_HIGH;
    if (isError) {
        static_cast<const DebugLog*>(user)->addError(line);
    } else if (severity == GL_DEBUG_SEVERITY_MEDIUM) {
        base::logWarning("{}", line);
    } else {
        base::logInfo("{}", line);
    }
}

}  // namespace

void DebugLog::addError(std::string_view message) const {
    ++errors_;
    base::logError("{}", message);
    if (fatal_) std::abort();
}

std::unique_ptr<DebugLog> enableDebugOutput(bool fatal) {
    auto log = std::make_unique<DebugLog>(fatal);
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);  // so that a debugger shows the call at fault
    glDebugMessageCallback(onMessage, log.get());
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DEBUG_SEVERITY_NOTIFICATION, 0, nullptr, GL_FALSE);
    return log;
}

DebugGroup::DebugGroup(std::string_view name) {
    assert(!name.empty() && "a debug group needs a name");
    constexpr std::size_t kLongestName = 255;  // far below the shortest limit on messages
    const auto length = static_cast<GLsizei>(std::min(name.size(), kLongestName));
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, length, name.data());
}

DebugGroup::~DebugGroup() {
    glPopDebugGroup();
}

}  // namespace terrane::gpu
