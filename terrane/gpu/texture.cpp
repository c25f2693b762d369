#include "terrane/gpu/texture.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "terrane/base/result.h"

namespace terrane::gpu {

namespace {

Handle<ObjectKind::Texture> createTexture(GLenum target, std::string_view label) {
    GLuint id = 0;
    glCreateTextures(target, 1, &id);
    Handle<ObjectKind::Texture> handle(id);
    handle.label(label);
    return handle;
}

std::size_t channels(GLenum format) {
    switch (format) {
        case GL_RED:
        case GL_RED_INTEGER:
        case GL_DEPTH_COMPONENT:
            return 1;
        case GL_RG:
        case GL_RG_INTEGER:
            return 2;
        case GL_RGB:
        case GL_RGB_INTEGER:
            return 3;
        case GL_RGBA:
        case GL_RGBA_INTEGER:
            return 4;
        default:
            return 0;
    }
}

std::size_t channelBytes(GLenum type) {
    switch (type) {
        case GL_BYTE:
        case GL_UNSIGNED_BYTE:
            return 1;
        case GL_SHORT:
        case GL_UNSIGNED_SHORT:
        case GL_HALF_FLOAT:
            return 2;
        case GL_INT:
        case GL_UNSIGNED_INT:
        case GL_FLOAT:
            return 4;
        default:
            return 0;
    }
}

// Zero for formats unknown to the tables above.
std::size_t imageBytes(glm::ivec2 size, GLenum format, GLenum type) {
    const auto texels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    if (type == GL_UNSIGNED_SHORT_4_4_4_4_REV) return texels * 2;  // a packed type
    return texels * channels(format) * channelBytes(type);
}

// Bytes of a texel, for the sized formats used here.
std::size_t texelBytes(GLenum format) {
    switch (format) {
        case GL_R8:
            return 1;
        case GL_RGBA4:
        case GL_DEPTH_COMPONENT16:
            return 2;
        case GL_RGBA16F:
        case GL_RGBA16:
        case GL_RG32F:
            return 8;
        case GL_RGBA32F:
            return 16;
        default:  // GL_RGBA8, GL_SRGB8_ALPHA8, GL_RG16, GL_R32F, GL_R32UI, GL_DEPTH_COMPONENT32F
            return 4;
    }
}

std::size_t levelBytes(glm::ivec2 size, int levels, GLenum format) {
    std::size_t texels = 0;
    for (int level = 0; level < levels; ++level) {
        const glm::ivec2 s = levelSize(size, level);
        texels += static_cast<std::size_t>(s.x) * static_cast<std::size_t>(s.y);
    }
    return texels * texelBytes(format);
}

// OpenGL would read past the end of shorter data.
void prepareUpload(std::span<const std::byte> data, std::size_t expectedBytes) {
    base::require(expectedBytes != 0, "texture upload: a format of unknown size");
    base::require(data.size() == expectedBytes, "texture upload: the data are not those of all texels");
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

}  // namespace

int fullLevels(glm::ivec2 size) {
    assert(size.x > 0 && size.y > 0 && "a texture has a size");
    return static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(size.x, size.y))));
}

glm::ivec2 levelSize(glm::ivec2 size, int level) {
    return {std::max(size.x >> level, 1), std::max(size.y >> level, 1)};
}

Texture2D::Texture2D(glm::ivec2 size, GLenum format, int levels, std::string_view label)
    : handle_(createTexture(GL_TEXTURE_2D, label)), size_(size), format_(format), levels_(levels) {
    assert(levels >= 1 && levels <= fullLevels(size) && "levels end at 1 x 1");
    glTextureStorage2D(id(), levels, format, size.x, size.y);
}

void Texture2D::upload(int level, GLenum format, GLenum type, std::span<const std::byte> data) {
    assert(level >= 0 && level < levels_ && "the level exists");
    const glm::ivec2 size = levelSize(size_, level);
    prepareUpload(data, imageBytes(size, format, type));
    glTextureSubImage2D(id(), level, 0, 0, size.x, size.y, format, type, data.data());
}

void Texture2D::generateMipmaps() {
    glGenerateTextureMipmap(id());
}

std::size_t Texture2D::sizeBytes() const {
    return id() == 0 ? 0 : levelBytes(size_, levels_, format_);
}

void Texture2D::bind(GLuint unit) const {
    assert(id() != 0 && "an empty texture cannot be bound");
    glBindTextureUnit(unit, id());
}

Texture2DArray::Texture2DArray(const Shape& shape, GLenum format, std::string_view label)
    : handle_(createTexture(GL_TEXTURE_2D_ARRAY, label)), shape_(shape), format_(format) {
    assert(shape.layers >= 1 && "an array has layers");
    assert(shape.levels >= 1 && shape.levels <= fullLevels(shape.size) && "levels end at 1 x 1");
    glTextureStorage3D(id(), shape.levels, format, shape.size.x, shape.size.y, shape.layers);
}

void Texture2DArray::upload(int level, int layer, GLenum format, GLenum type,
                            std::span<const std::byte> data) {
    assert(level >= 0 && level < shape_.levels && "the level exists");
    assert(layer >= 0 && layer < shape_.layers && "the layer exists");
    const glm::ivec2 size = levelSize(shape_.size, level);
    prepareUpload(data, imageBytes(size, format, type));
    glTextureSubImage3D(id(), level, 0, 0, layer, size.x, size.y, 1, format, type, data.data());
}

void Texture2DArray::uploadPart(int layer, const Part& part, GLenum format, GLenum type,
                                std::span<const std::byte> data) {
    assert(layer >= 0 && layer < shape_.layers && "the layer exists");
    prepareUpload(data, imageBytes(part.size, format, type));
    glTextureSubImage3D(id(), 0, part.corner.x, part.corner.y, layer, part.size.x, part.size.y, 1, format,
                        type, data.data());
}

std::size_t Texture2DArray::sizeBytes() const {
    return id() == 0
               ? 0
               : static_cast<std::size_t>(shape_.layers) * levelBytes(shape_.size, shape_.levels, format_);
}

void Texture2DArray::bind(GLuint unit) const {
    assert(id() != 0 && "an empty texture cannot be bound");
    glBindTextureUnit(unit, id());
}

Texture3D::Texture3D(glm::ivec3 size, GLenum format, std::string_view label)
    : handle_(createTexture(GL_TEXTURE_3D, label)), size_(size), format_(format) {
    assert(size.x > 0 && size.y > 0 && size.z > 0 && "a texture has a size");
    glTextureStorage3D(id(), 1, format, size.x, size.y, size.z);
    // Integer formats cannot be filtered.
    const GLint filter = format == GL_R32UI ? GL_NEAREST : GL_LINEAR;
    glTextureParameteri(id(), GL_TEXTURE_MIN_FILTER, filter);
    glTextureParameteri(id(), GL_TEXTURE_MAG_FILTER, filter);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
        glTextureParameteri(id(), axis, GL_CLAMP_TO_EDGE);
    }
}

void Texture3D::uploadPart(glm::ivec3 corner, glm::ivec3 size, GLenum format, GLenum type,
                           std::span<const std::byte> data) {
    prepareUpload(data, static_cast<std::size_t>(size.z) * imageBytes({size.x, size.y}, format, type));
    glTextureSubImage3D(id(), 0, corner.x, corner.y, corner.z, size.x, size.y, size.z, format, type,
                        data.data());
}

std::size_t Texture3D::sizeBytes() const {
    return id() == 0 ? 0 : static_cast<std::size_t>(size_.z) * levelBytes({size_.x, size_.y}, 1, format_);
}

void Texture3D::bind(GLuint unit) const {
    glBindTextureUnit(unit, id());
}

Texture2DMultisample::Texture2DMultisample(glm::ivec2 size, GLenum format, int samples,
                                           std::string_view label)
    : handle_(createTexture(GL_TEXTURE_2D_MULTISAMPLE, label)),
      size_(size),
      format_(format),
      samples_(samples) {
    assert(size.x > 0 && size.y > 0 && "a texture has a size");
    assert(samples >= 1 && "a texture has samples");
    glTextureStorage2DMultisample(id(), samples, format, size.x, size.y, GL_TRUE);
    glGetTextureLevelParameteriv(id(), 0, GL_TEXTURE_SAMPLES, &samples_);
}

std::size_t Texture2DMultisample::sizeBytes() const {
    return id() == 0 ? 0 : static_cast<std::size_t>(samples_) * levelBytes(size_, 1, format_);
}

void Texture2DMultisample::bind(GLuint unit) const {
    assert(id() != 0 && "an empty texture cannot be bound");
    glBindTextureUnit(unit, id());
}

namespace {

void setParameter(GLuint id, GLenum name, GLenum value) {
    glSamplerParameteri(id, name, static_cast<GLint>(value));
}

}  // namespace

Sampler::Sampler(const SamplerSettings& settings, std::string_view label) {
    GLuint id = 0;
    glCreateSamplers(1, &id);
    handle_ = Handle<ObjectKind::Sampler>(id);
    handle_.label(label);
    setParameter(id, GL_TEXTURE_MIN_FILTER, settings.minFilter);
    setParameter(id, GL_TEXTURE_MAG_FILTER, settings.magFilter);
    setParameter(id, GL_TEXTURE_WRAP_S, settings.wrapS);
    setParameter(id, GL_TEXTURE_WRAP_T, settings.wrapT);
    if (settings.compare != GL_NONE) {
        setParameter(id, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        setParameter(id, GL_TEXTURE_COMPARE_FUNC, settings.compare);
    }
    // Drivers without the extension refuse the parameter, so its default is not set.
    if (settings.maxAnisotropy > 1.0F)
        glSamplerParameterf(id, GL_TEXTURE_MAX_ANISOTROPY, settings.maxAnisotropy);
}

void Sampler::bind(GLuint unit) const {
    assert(id() != 0 && "an empty sampler cannot be bound");
    glBindSampler(unit, id());
}

TextureSet& TextureSet::add(GLuint unit, GLuint texture, const Sampler* sampler) {
    if (texture == 0) return *this;
    assert(count_ < kMax && "a draw has few textures");
    bindings_[count_++] = {unit, texture, sampler ? sampler->id() : 0};
    return *this;
}

TextureSet& TextureSet::add(const TextureSet& others) {
    assert(count_ + others.count_ <= kMax && "a draw has few textures");
    for (std::size_t k = 0; k < others.count_; ++k) bindings_[count_++] = others.bindings_[k];
    return *this;
}

void TextureSet::bind() const {
    for (std::size_t k = 0; k < count_; ++k) {
        glBindTextureUnit(bindings_[k].unit, bindings_[k].texture);
        glBindSampler(bindings_[k].unit, bindings_[k].sampler);
    }
}

}  // namespace terrane::gpu
