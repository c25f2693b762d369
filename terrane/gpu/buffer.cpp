#include "terrane/gpu/buffer.h"

#include <algorithm>
#include <cassert>

#include "terrane/base/result.h"

namespace terrane::gpu {

namespace {

Handle<ObjectKind::Buffer> createBuffer(std::string_view label) {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    Handle<ObjectKind::Buffer> handle(id);
    handle.label(label);
    return handle;
}

}  // namespace

std::size_t maxBufferBytes() {
    GLint64 blockBytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &blockBytes);
    return static_cast<std::size_t>(std::clamp<GLint64>(blockBytes, 1, kMaxBufferBytes));
}

std::size_t grownBytes(std::size_t sizeBytes, std::size_t neededBytes, std::size_t maxBytes) {
    if (neededBytes <= sizeBytes) return 0;
    const std::size_t most = maxBytes > 0 ? maxBytes : maxBufferBytes();
    assert(neededBytes <= most && "the caller keeps to what a buffer holds");
    return std::max(neededBytes, std::min(2 * neededBytes, most));
}

Buffer::Buffer(std::size_t sizeBytes, GLbitfield flags, std::string_view label)
    : handle_(createBuffer(label)), sizeBytes_(sizeBytes) {
    assert(sizeBytes > 0 && "OpenGL has no buffers of size zero");
    base::require(sizeBytes <= kMaxBufferBytes, "gpu::Buffer: no buffer has 2 GiB");
    glNamedBufferStorage(id(), static_cast<GLsizeiptr>(sizeBytes), nullptr, flags);
}

Buffer::Buffer(std::span<const std::byte> data, GLbitfield flags, std::string_view label)
    : handle_(createBuffer(label)), sizeBytes_(data.size()) {
    assert(!data.empty() && "OpenGL has no buffers of size zero");
    base::require(data.size() <= kMaxBufferBytes, "gpu::Buffer: no buffer has 2 GiB");
    glNamedBufferStorage(id(), static_cast<GLsizeiptr>(data.size()), data.data(), flags);
}

void Buffer::upload(std::size_t offsetBytes, std::span<const std::byte> data) {
    assert(id() != 0 && "an empty buffer takes no data");
    assert(offsetBytes <= sizeBytes_ && data.size() <= sizeBytes_ - offsetBytes && "upload past the end");
    if (data.empty()) return;
    glNamedBufferSubData(id(), static_cast<GLintptr>(offsetBytes), static_cast<GLsizeiptr>(data.size()),
                         data.data());
}

void Buffer::download(std::size_t offsetBytes, std::span<std::byte> out) const {
    assert(id() != 0 && "an empty buffer holds no data");
    assert(offsetBytes <= sizeBytes_ && out.size() <= sizeBytes_ - offsetBytes && "download past the end");
    if (out.empty()) return;
    glGetNamedBufferSubData(id(), static_cast<GLintptr>(offsetBytes), static_cast<GLsizeiptr>(out.size()),
                            out.data());
}

void Buffer::bindStorage(GLuint index) const {
    bindRange(GL_SHADER_STORAGE_BUFFER, index, 0, sizeBytes_);
}

void Buffer::bindUniform(GLuint index, std::size_t offsetBytes, std::size_t sizeBytes) const {
    bindRange(GL_UNIFORM_BUFFER, index, offsetBytes, sizeBytes);
}

void Buffer::bindRange(GLenum target, GLuint index, std::size_t offsetBytes, std::size_t sizeBytes) const {
    assert(id() != 0 && "an empty buffer cannot be bound");
    assert(offsetBytes <= sizeBytes_ && sizeBytes <= sizeBytes_ - offsetBytes && "range past the end");
    glBindBufferRange(target, index, id(), static_cast<GLintptr>(offsetBytes),
                      static_cast<GLsizeiptr>(sizeBytes));
}

BufferTexture::BufferTexture(const Buffer& buffer, GLenum format, std::string_view label) {
    assert(buffer.id() != 0 && "an empty buffer has nothing to show");
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &id);
    handle_ = Handle<ObjectKind::Texture>(id);
    handle_.label(label);
    glTextureBuffer(id, format, buffer.id());
}

void BufferTexture::bind(GLuint unit) const {
    assert(id() != 0 && "an empty texture cannot be bound");
    glBindTextureUnit(unit, id());
}

std::size_t BufferTexture::maxElements() {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    return static_cast<std::size_t>(most);
}

}  // namespace terrane::gpu
