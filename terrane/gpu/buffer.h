// A GL buffer of fixed size and its uploads. It is used on the thread of its context.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "terrane/gpu/handle.h"

namespace terrane::gpu {

// No buffer is larger: some drivers keep sizes and offsets in signed 32 bits.
constexpr std::size_t kMaxBufferBytes = (std::size_t{1} << 31) - 256;

// Returns the largest buffer that shaders of the current context reach as a whole, at most kMaxBufferBytes.
[[nodiscard]] std::size_t maxBufferBytes();

// A buffer that is too small is replaced by one of twice the needed size, as far as that is possible. Returns
// the size of the buffer that replaces one of `sizeBytes`; 0 if that is large enough. `maxBytes`: 0 for
// maxBufferBytes(); `neededBytes` are within.
[[nodiscard]] std::size_t grownBytes(std::size_t sizeBytes, std::size_t neededBytes,
                                     std::size_t maxBytes = 0);

class Buffer {
  public:
    Buffer() = default;
    // The content is undefined until written. `flags` are those of glNamedBufferStorage:
    // GL_DYNAMIC_STORAGE_BIT for upload().
    Buffer(std::size_t sizeBytes, GLbitfield flags, std::string_view label);
    // Creates a buffer with a copy of `data`, which is not empty.
    Buffer(std::span<const std::byte> data, GLbitfield flags, std::string_view label);

    [[nodiscard]] GLuint id() const { return handle_.id(); }
    [[nodiscard]] std::size_t sizeBytes() const { return sizeBytes_; }

    // Uploads data; the buffer needs GL_DYNAMIC_STORAGE_BIT.
    void upload(std::size_t offsetBytes, std::span<const std::byte> data);
    template <class T>
    void uploadVector(std::size_t offsetBytes, const std::vector<T>& values) {
        upload(offsetBytes, std::as_bytes(std::span(values)));
    }

    // Downloads data and waits for the GPU; for tests and read-back outside the frame.
    void download(std::size_t offsetBytes, std::span<std::byte> out) const;

    void bindStorage(GLuint index) const;
    void bindUniform(GLuint index, std::size_t offsetBytes, std::size_t sizeBytes) const;

  private:
    void bindRange(GLenum target, GLuint index, std::size_t offsetBytes, std::size_t sizeBytes) const;

    Handle<ObjectKind::Buffer> handle_;
    std::size_t sizeBytes_ = 0;
};

// A buffer as a one-dimensional texture, which shaders read by texelFetch from a samplerBuffer, in a texture
// format. Software renderers gather texels, but read storage buffers one number at a time. It is used on the
// thread of its context.
class BufferTexture {
  public:
    BufferTexture() = default;
    // Views the whole buffer, which must outlive the texture.
    BufferTexture(const Buffer& buffer, GLenum format, std::string_view label);

    [[nodiscard]] GLuint id() const { return handle_.id(); }
    void bind(GLuint unit) const;

    // Returns the most elements of a buffer texture.
    [[nodiscard]] static std::size_t maxElements();

  private:
    Handle<ObjectKind::Texture> handle_;
};

}  // namespace terrane::gpu
