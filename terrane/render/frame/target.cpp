#include "terrane/render/frame/target.h"

#include <cassert>

namespace terrane::render {

Target::Target(const TargetShape& shape) : shape_(shape) {
    assert(shape.size.x > 0 && shape.size.y > 0 && "an image has pixels");
    if (shape.samples == 1)
        plain_ = gpu::Texture2D(shape.size, shape.format, shape.levels, shape.label);
    else
        sampled_ = gpu::Texture2DMultisample(shape.size, shape.format, shape.samples, shape.label);
}

gpu::Attachment Target::attachment() const {
    return plain_.id() != 0 ? gpu::Attachment(plain_) : gpu::Attachment(sampled_);
}

void copyTarget(const Target& from, const Target& to, glm::ivec2 corner, glm::ivec2 size) {
    const GLenum kind = from.samples() > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
    glCopyImageSubData(from.id(), kind, 0, corner.x, corner.y, 0, to.id(), kind, 0, corner.x, corner.y, 0,
                       size.x, size.y, 1);
}

}  // namespace terrane::render
