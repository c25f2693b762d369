#include "terrane/gpu/handle.h"

#include <algorithm>
#include <cassert>

namespace terrane::gpu {
namespace {

GLenum labelNamespace(ObjectKind kind) {
    switch (kind) {
        case ObjectKind::Buffer:
            return GL_BUFFER;
        case ObjectKind::Texture:
            return GL_TEXTURE;
        case ObjectKind::Sampler:
            return GL_SAMPLER;
        case ObjectKind::Framebuffer:
            return GL_FRAMEBUFFER;
        case ObjectKind::VertexArray:
            return GL_VERTEX_ARRAY;
        case ObjectKind::Query:
            return GL_QUERY;
        case ObjectKind::Shader:
            return GL_SHADER;
        case ObjectKind::Program:
            return GL_PROGRAM;
    }
    return GL_NONE;
}

}  // namespace

void deleteObject(ObjectKind kind, GLuint id) {
    switch (kind) {
        case ObjectKind::Buffer:
            return glDeleteBuffers(1, &id);
        case ObjectKind::Texture:
            return glDeleteTextures(1, &id);
        case ObjectKind::Sampler:
            return glDeleteSamplers(1, &id);
        case ObjectKind::Framebuffer:
            return glDeleteFramebuffers(1, &id);
        case ObjectKind::VertexArray:
            return glDeleteVertexArrays(1, &id);
        case ObjectKind::Query:
            return glDeleteQueries(1, &id);
        case ObjectKind::Shader:
            return glDeleteShader(id);
        case ObjectKind::Program:
            return glDeleteProgram(id);
    }
}

void labelObject(ObjectKind kind, GLuint id, std::string_view label) {
    assert(id != 0 && "an empty object has no label");
    constexpr std::size_t kShortestLimit = 255;  // every driver takes labels below 256 bytes
    const std::size_t length = std::min(label.size(), kShortestLimit);
    if (length == 0) return;  // a length of zero would remove the label
    glObjectLabel(labelNamespace(kind), id, static_cast<GLsizei>(length), label.data());
}

Handle<ObjectKind::Query> createQuery(GLenum target) {
    GLuint id = 0;
    glCreateQueries(target, 1, &id);
    return Handle<ObjectKind::Query>(id);
}

}  // namespace terrane::gpu
