// A buffer as a one-dimensional texture, which shaders read by texelFetch from a samplerBuffer, in a texture
// format. Software renderers gather texels, but read storage buffers one number at a time. Used on the thread
// of its context.
#pragma once

#include <string_view>

#include "terrane/gpu/buffer.h"
#include "terrane/gpu/handle.h"

namespace terrane::gpu {

class BufferTexture {
  public:
    BufferTexture() = default;
    // Views the whole buffer, which must outlive the texture.
    BufferTexture(const Buffer& buffer, GLenum format, std::string_view label);

    [[nodiscard]] GLuint id() const { return handle_.id(); }
    void bind(GLuint unit) const;

    // Most elements of a buffer texture.
    [[nodiscard]] static std::size_t maxElements();

  private:
    Handle<ObjectKind::Texture> handle_;
};

}  // namespace terrane::gpu
