// Textures of fixed size and format. It is used on the thread of their context. Formats and types are
// OpenGL's: `format` of the constructors is a sized internal format (GL_RGBA8), `format` and `type` of
// uploads describe the bytes given (GL_RGBA, GL_UNSIGNED_BYTE), rows without padding, the first row at v = 0.
// sizeBytes() is the memory of all texels, 0 for an empty texture; drivers may pad it.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "terrane/gpu/handle.h"

namespace terrane::gpu {

// Returns the number of levels down to 1 × 1.
[[nodiscard]] int fullLevels(glm::ivec2 size);
[[nodiscard]] glm::ivec2 levelSize(glm::ivec2 size, int level);

class Texture2D {
  public:
    Texture2D() = default;
    Texture2D(glm::ivec2 size, GLenum format, int levels, std::string_view label);

    // Uploads the whole of one level.
    void upload(int level, GLenum format, GLenum type, std::span<const std::byte> data);
    void generateMipmaps();
    void bind(GLuint unit) const;

    [[nodiscard]] GLuint id() const { return handle_.id(); }
    [[nodiscard]] glm::ivec2 size() const { return size_; }
    [[nodiscard]] int levels() const { return levels_; }
    [[nodiscard]] std::size_t sizeBytes() const;

  private:
    Handle<ObjectKind::Texture> handle_;
    glm::ivec2 size_ = {0, 0};
    GLenum format_ = GL_NONE;
    int levels_ = 0;
};

class Texture2DArray {
  public:
    struct Shape {
        glm::ivec2 size = {0, 0};
        int layers = 1;
        int levels = 1;
    };

    Texture2DArray() = default;
    Texture2DArray(const Shape& shape, GLenum format, std::string_view label);

    struct Part {
        glm::ivec2 corner, size;
    };
    // Uploads a rectangle of texels to level 0 of one layer.
    void uploadPart(int layer, const Part& part, GLenum format, GLenum type, std::span<const std::byte> data);
    // Uploads the whole of one level of one layer.
    void upload(int level, int layer, GLenum format, GLenum type, std::span<const std::byte> data);
    void bind(GLuint unit) const;

    [[nodiscard]] GLuint id() const { return handle_.id(); }
    [[nodiscard]] const Shape& shape() const { return shape_; }
    [[nodiscard]] std::size_t sizeBytes() const;

  private:
    Handle<ObjectKind::Texture> handle_;
    Shape shape_;
    GLenum format_ = GL_NONE;
};

class Texture3D {
  public:
    Texture3D() = default;
    // The content is undefined until written. The texture has one level and linear filtering (nearest for
    // integer formats), and it is clamped.
    Texture3D(glm::ivec3 size, GLenum format, std::string_view label);

    // Uploads a box of texels. Types may be packed ones; `data` has as many bytes as they need.
    void uploadPart(glm::ivec3 corner, glm::ivec3 size, GLenum format, GLenum type,
                    std::span<const std::byte> data);
    void bind(GLuint unit) const;

    [[nodiscard]] GLuint id() const { return handle_.id(); }
    [[nodiscard]] glm::ivec3 size() const { return size_; }
    [[nodiscard]] std::size_t sizeBytes() const;

  private:
    Handle<ObjectKind::Texture> handle_;
    glm::ivec3 size_ = {0, 0, 0};
    GLenum format_ = GL_NONE;
};

// A render target with several samples per pixel, at the same positions in every pixel. The driver may use
// more samples than requested: see samples().
class Texture2DMultisample {
  public:
    Texture2DMultisample() = default;
    Texture2DMultisample(glm::ivec2 size, GLenum format, int samples, std::string_view label);

    void bind(GLuint unit) const;

    [[nodiscard]] GLuint id() const { return handle_.id(); }
    [[nodiscard]] glm::ivec2 size() const { return size_; }
    [[nodiscard]] int samples() const { return samples_; }
    [[nodiscard]] std::size_t sizeBytes() const;

  private:
    Handle<ObjectKind::Texture> handle_;
    glm::ivec2 size_ = {0, 0};
    GLenum format_ = GL_NONE;
    int samples_ = 0;
};

// The state by which a shader reads a texture: filters, wrapping, comparison.
struct SamplerSettings {
    GLenum minFilter = GL_LINEAR;
    GLenum magFilter = GL_LINEAR;
    GLenum wrapS = GL_CLAMP_TO_EDGE;
    GLenum wrapT = GL_CLAMP_TO_EDGE;
    GLenum compare = GL_NONE;    // GL_LEQUAL and so on for shadow samplers
    float maxAnisotropy = 1.0F;  // up to DeviceInfo::maxAnisotropy
};

class Sampler {
  public:
    Sampler() = default;
    Sampler(const SamplerSettings& settings, std::string_view label);

    void bind(GLuint unit) const;
    [[nodiscard]] GLuint id() const { return handle_.id(); }

  private:
    Handle<ObjectKind::Sampler> handle_;
};

// The textures of a draw, each at a unit with the sampler that reads it. They are bound as a whole, so that
// no draw depends on the bindings of another. At most kMax; refers to the objects by their GL names.
class TextureSet {
  public:
    static constexpr std::size_t kMax = 24;

    // Adds a texture. `sampler` is null for the texture's own filters. Texture 0 is skipped.
    TextureSet& add(GLuint unit, GLuint texture, const Sampler* sampler = nullptr);
    TextureSet& add(const TextureSet& others);
    void bind() const;

  private:
    struct Binding {
        GLuint unit = 0, texture = 0, sampler = 0;
    };
    std::array<Binding, kMax> bindings_;
    std::size_t count_ = 0;
};

}  // namespace terrane::gpu
