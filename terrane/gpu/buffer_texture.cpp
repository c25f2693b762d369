#include "terrane/gpu/buffer_texture.h"

#include <cassert>

namespace terrane::gpu {

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
