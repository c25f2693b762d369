#include "terrane/render/pixel_mask.h"

namespace terrane::render {

base::Result<void> PixelMask::select(int samples) {
    return pass_.select(defined({{"MSAA_SAMPLES", samples}, {"OF", static_cast<int>(of_)}}));
}

void PixelMask::draw(gpu::Pipeline& pipeline, const FrameTargets& targets) const {
    const gpu::PipelineState nearest{.depthTest = gpu::DepthTest::Always, .depthRange = {1, 1}};
    pipeline.set(nearest);
    targets.bindGBuffer();
    targets.mask.bind();
    targets.mask.clearDepth(0.0f);
    pass_.draw(pipeline, nearest);
}

}  // namespace terrane::render
