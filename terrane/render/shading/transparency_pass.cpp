#include "terrane/render/shading/transparency_pass.h"

#include "terrane/gpu/debug.h"
#include "terrane/gpu/pipeline_state.h"
#include "terrane/render/frame/frame_targets.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {
namespace {

GLenum targetOf(int samples) {
    return samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
}

}  // namespace

TransparencyPass::TransparencyPass(const gpu::ShaderLoader& shaders)
    : first_(quadShaders(shaders, "shading/depth_peel", "first layer")),
      next_(quadShaders(shaders, "shading/depth_peel", "next layer")),
      shadeQuads_{quadShaders(shaders, "shading/transparency", "shade layers"),
                  quadShaders(shaders, "shading/transparency", "shade layers")},
      shade_{FullscreenPass(shaders, "shading/transparency"), FullscreenPass(shaders, "shading/transparency")},
      mask_(shaders, PixelMask::Of::Layers) {
    for (auto& query : anyDrawn_) query = gpu::createQuery(GL_ANY_SAMPLES_PASSED);
}

base::Result<TransparencyPass::Target> TransparencyPass::makeTarget(const FrameTargets& targets) {
    Target target;
    target.color = MsaaTexture(targets.size, GL_RGBA16, targets.msaaSamples, "layer");
    target.depth = MsaaTexture(targets.size, GL_DEPTH_COMPONENT32F, targets.msaaSamples, "layer depth");
    auto framebuffer = TERRANE_TRY(
        gpu::Framebuffer::create({{target.color.attachment()}, target.depth.attachment()}, "layer"));
    framebuffer.clearColor(0, glm::vec4(0));  // once: pixels without a face are read, but never used
    target.framebuffer = std::move(framebuffer);
    return target;
}

base::Result<void> TransparencyPass::selectVariants(int samples, const RenderOptions& options,
                                                    const LightVariant& light, const QuadFeatures& features) {
    const int layers = options.transparencyLayers;
    const auto peeling = [&](int next) {
        return defined({{"PASS", 1},
                        {"ALPHA_CLASS", 2},
                        {"MSAA_SAMPLES", samples},
                        {"NEXT", next},
                        {"FACE_SAMPLING", features.hasFaceSampling},
                        {"TINT", features.hasTint}});
    };
    auto selected = first_.select(peeling(0));
    if (selected && layers > 1) selected = next_.select(peeling(1));
    for (int isUnderWater = 0; selected && isUnderWater < 2; ++isUnderWater) {
        const auto index = static_cast<std::size_t>(isUnderWater);
        const gpu::ShaderDefines shading = defined({{"PASS", 1},
                                                    {"ALPHA_CLASS", 2},
                                                    {"MSAA_SAMPLES", samples},
                                                    {"LAYERS", layers},
                                                    {"SHADOW", light.shadowVariant},
                                                    {"LAND", light.knowsLand},
                                                    {"OCCLUSION", options.occlusion != Occlusion::Off},
                                                    {"LIGHT_SMOOTH", static_cast<int>(options.light)},
                                                    {"QUADS", shadesQuads_},
                                                    {"DIRECT", isDirect_},
                                                    {"OVER_SKY", !isDirect_},
                                                    {"FACE_SAMPLING", 0},
                                                    {"TINT", 0},
                                                    {"WATER_DETAIL", options.water == Water::Full},
                                                    {"UNDER_WATER", isUnderWater},
                                                    {"FAR", 0}});
        selected = shadesQuads_ ? shadeQuads_[index].select(shading) : shade_[index].select(shading);
    }
    if (selected && isMasked_) selected = mask_.select(samples);
    return selected;
}

// With one sample a pixel the layers' quads are drawn once more to shade exactly the pixels that they cover.
// A single layer has a background everywhere.
base::Result<void> TransparencyPass::configure(const FrameTargets& targets, const RenderOptions& options,
                                               const LightVariant& light, const QuadFeatures& features) {
    shadesQuads_ = targets.msaaSamples == 1 && options.singleTransparencyLayer == 0;
    isDirect_ = isDirectImage(options, targets.msaaSamples);
    isMasked_ = targets.msaaSamples > 1 && options.singleTransparencyLayer == 0;
    isBounded_ = options.singleTransparencyLayer == 0;
    hasWholeDepth_ = options.occlusion != Occlusion::Off || options.depthOfField;
    if (options.transparencyLayers > 0) {
        TERRANE_TRY(selectVariants(targets.msaaSamples, options, light, features));
    }
    const bool isMade =
        size_ == targets.size && samples_ == targets.msaaSamples && scene_ == targets.sceneColor.id();
    if (options.transparencyLayers == layers_ && isMade) return {};
    targets_ = {};
    overQuads_ = {};
    overQuadsDirect_ = {};
    layers_ = 0;
    for (int k = 0; k < options.transparencyLayers; ++k) {
        auto target = TERRANE_TRY(makeTarget(targets));
        targets_[static_cast<std::size_t>(k)] = std::move(target);
    }
    if (options.transparencyLayers > 0 && targets.msaaSamples == 1) {
        const auto makeOver = [&](const gpu::Texture2D& color) {
            return gpu::Framebuffer::create({{color}, targets_[0].depth.attachment()}, "over layers");
        };
        auto over = makeOver(targets.sceneColor), overDirect = makeOver(targets.ldrColor);
        if (!over) return tl::unexpected(over.error());
        if (!overDirect) return tl::unexpected(overDirect.error());
        overQuads_ = std::move(*over);
        overQuadsDirect_ = std::move(*overDirect);
    }
    layers_ = options.transparencyLayers;
    size_ = targets.size;
    samples_ = targets.msaaSamples;
    scene_ = targets.sceneColor.id();
    return {};
}

// A layer starts with the depth of the opaque surfaces: faces behind them fail the depth test, and pixels
// without a face keep that depth.
void TransparencyPass::copyDepth(const FrameTargets& targets, int number,
                                 std::span<const ScreenRect> rects) const {
    const Target& target = targets_[static_cast<std::size_t>(number)];
    const GLenum kind = targetOf(samples_);
    for (const ScreenRect& rect : rects)
        glCopyImageSubData(targets.depth.id(), kind, 0, rect.min.x, rect.min.y, 0, target.depth.id(), kind, 0,
                           rect.min.x, rect.min.y, 0, rect.size().x, rect.size().y, 1);
}

void TransparencyPass::peelLayer(gpu::Pipeline& pipeline, const QuadDraw& quads, int number) {
    const auto index = static_cast<std::size_t>(number);
    Target& target = targets_[index];
    target.framebuffer.bind();
    // No layers are behind one without faces: the GPU skips their drawing, not the copy above.
    if (number > 0) {
        glBeginConditionalRender(anyDrawn_[index - 1].id(), GL_QUERY_WAIT);
        targets_[index - 1].depth.bind(shared::kTransparencyDepthUnit);
    }
    glBeginQuery(GL_ANY_SAMPLES_PASSED, anyDrawn_[index].id());
    (number == 0 ? first_ : next_).use();
    quads.draw(pipeline, {.depthTest = gpu::DepthTest::Greater, .readsSampleId = number > 0 && samples_ > 1},
               mesh::AlphaClass::Blended);
    glEndQuery(GL_ANY_SAMPLES_PASSED);
    if (number > 0) glEndConditionalRender();
}

void TransparencyPass::peelLayers(gpu::Pipeline& pipeline, const FrameTargets& targets, const QuadDraw& quads,
                                  std::span<const ScreenRect> rects) {
    const gpu::DebugGroup group("layers");
    const ScreenRect all{{0, 0}, size_};
    quads.bind();
    for (int number = 0; number < layers_; ++number) {
        const bool needsAll = !isBounded_ || (number == 0 && hasWholeDepth_);
        copyDepth(targets, number, needsAll ? std::span(&all, 1) : rects);
        peelLayer(pipeline, quads, number);
    }
}

std::size_t TransparencyPass::gpuBytes() const {
    std::size_t bytes = 0;
    for (const Target& target : targets_) bytes += target.color.sizeBytes() + target.depth.sizeBytes();
    return bytes;
}

void TransparencyPass::bindLayers() const {
    for (int k = 0; k < layers_; ++k) {
        const Target& target = targets_[static_cast<std::size_t>(k)];
        target.color.bind(shared::kTransparencyColorUnit + static_cast<GLuint>(k));
        target.depth.bind(shared::kTransparencyDepthUnit + static_cast<GLuint>(k));
    }
}

// Shades a rectangle of the screen, if quads are not drawn again.
void TransparencyPass::shadeWithin(gpu::Pipeline& pipeline, const FrameTargets& targets,
                                   const ScreenRect& rect, const ShadingInputs& inputs,
                                   const AmbientOcclusion& occlusion) const {
    const gpu::Scissor scissor(rect.min, rect.size());
    if (isMasked_) mask_.draw(pipeline, targets);
    if (occlusion.isOn()) occlusion.result().bind(shared::kOcclusionUnit);
    targets.scene.bind();
    shade_[inputs.isUnderWater ? 1 : 0].draw(
        pipeline, {.depthTest = isMasked_ ? gpu::DepthTest::Less : gpu::DepthTest::Off,
                   .writesDepth = false,
                   .blending = gpu::Blending::Through});
}

void TransparencyPass::shade(gpu::Pipeline& pipeline, const FrameTargets& targets, const QuadDraw& quads,
                             const ShadingInputs& inputs, const AmbientOcclusion& occlusion,
                             std::span<const ScreenRect> rects) const {
    const ScreenRect all{{0, 0}, size_};
    if (!isBounded_) rects = std::span(&all, 1);
    glBeginConditionalRender(anyDrawn_[0].id(), GL_QUERY_WAIT);
    bindLayers();
    if (occlusion.isOn()) {
        const ScreenRect bounds = boundsOf(rects);  // one rectangle: the blur reads beyond its edges
        const gpu::Scissor scissor(bounds.min, bounds.size());
        occlusion.drawNearestLayer(pipeline, targets);
        occlusion.result().bind(shared::kOcclusionUnit);
    }
    targets.bindGBuffer();
    targets.sceneColor.bind(shared::kSceneUnit);  // of pixels without layers: see water_reflection.glsl
    inputs.bind();
    if (shadesQuads_) {
        (isDirect_ ? overQuadsDirect_ : overQuads_).bind();
        quads.bind();
        shadeQuads_[inputs.isUnderWater ? 1 : 0].use();
        quads.draw(pipeline,
                   {.depthTest = gpu::DepthTest::Equal,
                    .writesDepth = false,
                    .blending = isDirect_ ? gpu::Blending::Off : gpu::Blending::Through},
                   mesh::AlphaClass::Blended);
    } else {
        for (const ScreenRect& rect : rects) shadeWithin(pipeline, targets, rect, inputs, occlusion);
    }
    glEndConditionalRender();
}

}  // namespace terrane::render
