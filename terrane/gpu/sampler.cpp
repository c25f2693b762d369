#include "terrane/gpu/sampler.h"

#include <cassert>

namespace terrane::gpu {
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

}  // namespace terrane::gpu
