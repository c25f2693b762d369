#include "terrane/render/frame/frame.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>

#include "terrane/gpu/debug.h"
#include "terrane/render/frame/frame_statistics.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {

// Each in a file of its own.
MaybePass makeCull(FrameBuilder&), makeShadowMap(FrameBuilder&), makeSurfaces(FrameBuilder&),
    makeDepthPyramid(FrameBuilder&), makeLateCull(FrameBuilder&), makeLateSurfaces(FrameBuilder&),
    makeHoleFill(FrameBuilder&), makeFigures(FrameBuilder&), makeOcclusion(FrameBuilder&),
    makeSky(FrameBuilder&), makeShade(FrameBuilder&), makePeel(FrameBuilder&), makeShadeLayers(FrameBuilder&),
    makeClouds(FrameBuilder&), makeGodRays(FrameBuilder&), makeDepthOfField(FrameBuilder&),
    makeBloom(FrameBuilder&), makeFinal(FrameBuilder&), makeDebugView(FrameBuilder&),
    makeResize(FrameBuilder&);

namespace {

struct PassRow {
    std::string_view name;
    MaybePass (*make)(FrameBuilder&);
};

// In the order of a frame.
constexpr PassRow kPasses[] = {
    {"cull", makeCull},                    // selects mesh sections and quads in view
    {"shadow map", makeShadowMap},         // draws shadow tiles that are missing or changed
    {"surfaces", makeSurfaces},            // draws opaque and alpha-tested quads into the G-buffer
    {"depth pyramid", makeDepthPyramid},   // farthest depths in a mip chain
    {"cull again", makeLateCull},          // selects what was hidden in the frame before and is visible now
    {"surfaces again", makeLateSurfaces},  //
    {"fill holes", makeHoleFill},          // closes cracks at T-junctions, after the thesis
    {"figures", makeFigures},  // draws other players; after holes are filled, which would take arms for holes
    {"ambient occlusion", makeOcclusion},  //
    {"sky", makeSky},                      //
    {"shade", makeShade},                  // lights the G-buffer over the sky
    {"peel", makePeel},                    // separates blended faces into layers
    {"shade layers", makeShadeLayers},     // lights the layers and blends them over the image
    {"clouds", makeClouds},                // draws clouds that are before surfaces
    {"god rays", makeGodRays},             //
    {"depth of field", makeDepthOfField},  //
    {"bloom", makeBloom},                  //
    {"final", makeFinal},                  // applies effects and display colors
    {"debug view", makeDebugView},         // shows the G-buffer instead of the image
    {"resize", makeResize}};               // makes the image as large as it is shown

bool isDrawn(const Pass& pass, const FrameInput& input) {
    switch (pass.drawnIn) {
        case DrawnIn::Image:
            return input.view == View::Color;
        case DrawnIn::DebugViews:
            return input.view != View::Color;
        default:
            return true;
    }
}

std::string labelsOf(const std::vector<TargetRef>& targets) {
    std::vector<std::string_view> labels;
    for (const TargetRef& target : targets) labels.push_back(target->shape().label);
    return fmt::format("{}", fmt::join(labels, ", "));
}

}  // namespace

bool FrameContext::cullsOccluded() const {
    return frame.targets.hiZ && !input.cullingCamera;
}

bool FrameContext::shadesAtCorners() const {
    return frame.drawn.shading == Shading::Corners && input.view == View::Color;
}

gpu::TextureSet FrameContext::shadingTextures() const {
    gpu::TextureSet textures = worldTextures;
    if (frame.shadowMap) frame.shadowMap->addTo(textures);
    return textures;
}

QuadDraw FrameContext::quadDraw() const {
    return {resources, quads, cull, frame.drawn.sharpFiltering};
}

bool Frame::isDirect() const {
    return isDirectImage(drawn, samples);
}

gpu::TextureSet Frame::gbufferTextures() const {
    return gpu::TextureSet()
        .add(shared::kGBufferUnit, targets.surfaces->id())
        .add(shared::kDepthUnit, targets.depth->id());
}

std::size_t Frame::targetBytes() const {
    std::size_t bytes = shadowMap ? shadowMap->gpuBytes() : 0;
    for (const TargetRef& target : allTargets) bytes += target->sizeBytes();
    return bytes;
}

FrameBuilder::FrameBuilder(const FrameSpec& spec, Programs& compiled, const Frame& before)
    : programs(compiled), before_(before) {
    frame.spec = spec;
    frame.drawn = drawnOptions(spec.options);
}

TargetRef FrameBuilder::target(const TargetShape& shape) {
    const auto isFree = [&](const TargetRef& target) {
        return target->shape() == shape &&
               std::ranges::find(frame.allTargets, target) == frame.allTargets.end();
    };
    const auto found = std::ranges::find_if(before_.allTargets, isFree);
    return frame.allTargets.emplace_back(
        found != before_.allTargets.end() ? *found : std::make_shared<const Target>(shape));
}

base::Result<std::shared_ptr<const gpu::Framebuffer>> FrameBuilder::framebuffer(
    std::string_view label, const std::vector<TargetRef>& colors, const TargetRef& depth) {
    gpu::FramebufferOptions options;
    for (const TargetRef& color : colors) options.colors.push_back(color->attachment());
    if (depth) options.depth = depth->attachment();
    auto made = TERRANE_TRY(gpu::Framebuffer::create(options, label));
    return std::make_shared<const gpu::Framebuffer>(std::move(made));
}

base::Result<FrameBuilder::Drawn> FrameBuilder::drawnTarget(std::string_view label, GLenum format,
                                                            glm::ivec2 size) {
    Drawn drawn{target({label, format, size}), nullptr};
    drawn.framebuffer = TERRANE_TRY(framebuffer(label, {drawn.target}));
    return drawn;
}

base::Result<void> FrameBuilder::makeSharedTargets() {
    const glm::ivec2 size = frame.spec.size;
    const int asked = options().msaaSamples;
    SharedTargets& t = frame.targets;
    t.surfaces = target({"G-buffer", GL_RGBA8, size, asked});
    t.depth = target({"depth", GL_DEPTH_COMPONENT32F, size, asked});
    frame.samples = t.surfaces->samples();
    t.scene = target({"scene", GL_RGBA16F, size});
    t.image = target({"image", GL_RGBA8, size});
    frame.gbuffer = TERRANE_TRY(framebuffer("G-buffer", {t.surfaces}, t.depth));
    frame.image = TERRANE_TRY(framebuffer("image", {t.image}));
    frame.output = frame.image;
    if (samples() > 1) {
        t.mask = target({"mask", GL_DEPTH_COMPONENT16, size});
        frame.mask = TERRANE_TRY(framebuffer("mask", {}, t.mask));
    } else {
        frame.direct = TERRANE_TRY(framebuffer("direct image", {t.image}, t.depth));
    }
    frame.scene = TERRANE_TRY(framebuffer("scene", {t.scene}, t.mask ? t.mask : t.depth));
    // No sky is drawn behind near surfaces. The scene is blended there with 0 of its previous color, which
    // must be a number.
    if (t.scene != before_.targets.scene) frame.scene->clearColor(0, glm::vec4(0));
    return {};
}

base::Result<void> FrameBuilder::makeShadowMap() {
    if (!hasShadowMap(options())) return {};
    const int cascades =
        options().shadows == ShadowReach::Near ? 1 : static_cast<int>(shared::kShadowCascades);
    const ShadowMap::Shape shape{cascades, options().shadowSize};
    if (before_.shadowMap && before_.shadowMap->shape() == shape) {
        frame.shadowMap = before_.shadowMap;
        return {};
    }
    auto made = TERRANE_TRY(ShadowMap::create(shape));
    frame.shadowMap = std::make_shared<ShadowMap>(std::move(made));
    return {};
}

base::Result<Frame> buildFrame(const FrameSpec& spec, Programs& programs, const Frame& before) {
    FrameBuilder build(spec, programs, before);
    TERRANE_TRY(build.makeSharedTargets());
    TERRANE_TRY(build.makeShadowMap());
    for (const PassRow& row : kPasses) {
        auto pass = TERRANE_TRY(row.make(build));
        if (!pass) continue;
        pass->name = row.name;
        build.frame.passes.push_back(std::move(*pass));
    }
    return std::move(build.frame);
}

void recordPasses(FrameContext& context, gpu::GpuTimer& timer) {
    for (const Pass& pass : context.frame.passes) {
        if (!isDrawn(pass, context.input) || (pass.isNeeded && !pass.isNeeded(context))) continue;
        const TimerZone zone(timer, pass.name);
        const gpu::DebugGroup group(pass.name);
        pass.record(context);
    }
}

std::vector<std::string_view> passNames() {
    std::vector<std::string_view> names;
    for (const PassRow& row : kPasses) names.push_back(row.name);
    return names;
}

std::string textOf(const Frame& frame) {
    std::string text;
    for (const Pass& pass : frame.passes) {
        text += pass.name;
        if (!pass.reads.empty()) text += ": " + labelsOf(pass.reads);
        if (!pass.writes.empty()) text += " → " + labelsOf(pass.writes);
        text += '\n';
    }
    return text;
}

void drawFullscreen(FrameContext& context, const gpu::Program& program, const gpu::PipelineState& state,
                    const gpu::TextureSet& textures, std::span<const ScreenRect> within) {
    context.pipeline.set(state);
    program.use();
    textures.bind();
    context.fullscreen.bind();
    if (within.empty()) glDrawArrays(GL_TRIANGLES, 0, 3);
    for (const ScreenRect& rect : within) {
        const gpu::Scissor scissor(rect.min, rect.size());
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
}

}  // namespace terrane::render
