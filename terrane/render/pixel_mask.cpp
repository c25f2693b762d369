#include "terrane/render/pixel_mask.h"

namespace terrane::render {

base::Result<void> PixelMask::select(int samples) {
    return pass_.select(defined({{"SAMPLES", samples}, {"OF", static_cast<int>(of_)}}));
}

void PixelMask::draw(const FrameTargets& targets) const {
    targets.mask.bind();
    targets.mask.clearDepth(0.0f);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_ALWAYS);
    glDepthRangef(1.0f, 1.0f);
    pass_.draw();
    glDepthRangef(0.0f, 1.0f);
}

}  // namespace terrane::render
