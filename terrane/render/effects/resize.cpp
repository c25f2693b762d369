// The image at another size than it was drawn at: see RenderOptions::renderScale.
#include "terrane/render/frame/frame.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {

MaybePass makeResize(FrameBuilder& build) {
    Frame& frame = build.frame;
    if (frame.spec.outputSize == frame.spec.size) return std::nullopt;
    const bool isLarger = frame.spec.outputSize.x > frame.spec.size.x;
    const Upscaling way = isLarger ? frame.spec.upscaling : Upscaling::Linear;
    const auto programOf = [&](Resizing step) {
        return build.programs.fullscreen("effects/resize", ResizeVariant{step}.defines());
    };
    const gpu::Program *resize = nullptr, *sharpen = nullptr;
    if (way == Upscaling::Edges) {
        resize = TERRANE_TRY(programOf(Resizing::Edges));
        sharpen = TERRANE_TRY(programOf(Resizing::Sharpen));
    } else {
        resize = TERRANE_TRY(programOf(way == Upscaling::Nearest ? Resizing::Nearest : Resizing::Linear));
    }
    const auto output = TERRANE_TRY(build.drawnTarget("output", GL_RGBA8, frame.spec.outputSize));
    FrameBuilder::Drawn resized = output;
    if (sharpen) resized = TERRANE_TRY(build.drawnTarget("resized", GL_RGBA8, frame.spec.outputSize));
    frame.output = output.framebuffer;
    const auto smooth = std::make_shared<gpu::Sampler>(gpu::SamplerSettings{}, "smooth");
    const TargetRef image = frame.targets.image;
    return Pass{.reads = {image},
                .writes = {output.target},
                .record =
                    [=](FrameContext& context) {
                        resized.framebuffer->bind();
                        drawFullscreen(context, *resize, {},
                                       gpu::TextureSet().add(shared::kSceneUnit, image->id(), smooth.get()));
                        if (!sharpen) return;
                        output.framebuffer->bind();
                        drawFullscreen(context, *sharpen, {},
                                       gpu::TextureSet().add(shared::kSceneUnit, resized.target->id()));
                    },
                .drawnIn = DrawnIn::EveryView};
}

}  // namespace terrane::render
