// State by which a shader reads a texture: filters, wrapping, comparison. Used on the thread of its context.
#pragma once

#include <string_view>

#include "terrane/gpu/handle.h"

namespace terrane::gpu {

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

}  // namespace terrane::gpu
