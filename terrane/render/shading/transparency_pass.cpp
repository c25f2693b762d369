// Transparency: blended faces, separated into layers from the nearest on by depth peeling, then lit and
// blended over the image.
#include <array>

#include "terrane/gpu/pipeline_state.h"
#include "terrane/render/corners/corners.h"
#include "terrane/render/effects/ambient_occlusion.h"
#include "terrane/render/frame/frame.h"
#include "terrane/render/rays/rays_pass.h"
#include "terrane/render/shading/pixel_mask.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {

constexpr std::size_t kMaxLayers = 3;

// Whether a layer has faces, as of the last peeling. Both passes use them.
struct LayerQueries {
    std::array<gpu::Handle<gpu::ObjectKind::Query>, kMaxLayers> ofLayer;
};

namespace {

constexpr std::array<std::string_view, kMaxLayers> kLayerLabels = {"layer 1", "layer 2", "layer 3"};
constexpr std::array<std::string_view, kMaxLayers> kDepthLabels = {"depth 1", "depth 2", "depth 3"};

// A single layer has a background everywhere.
bool showsAllLayers(const FrameBuilder& build) {
    return build.options().singleTransparencyLayer == 0;
}
bool castsRays(const FrameBuilder& build) {
    return build.options().surfaces == SurfaceMethod::Rays;
}
// With one sample a pixel the layers' quads are drawn once more to shade exactly the pixels that they cover.
bool shadesQuads(const FrameBuilder& build) {
    return build.samples() == 1 && showsAllLayers(build) && !castsRays(build);
}

struct Peel {
    const gpu::Program *first = nullptr, *next = nullptr;  // that draw quads
    RayLayerPrograms rays;                                 // in place of these
    std::vector<TargetRef> depths;
    std::vector<std::shared_ptr<const gpu::Framebuffer>> framebuffers;
    TargetRef surfaceDepth;
    glm::ivec2 size{0};
    int samples = 1;
    bool isBounded = true;       // by rectangles
    bool hasWholeDepth = false;  // other passes read the first layer's depth all over the screen
    std::shared_ptr<LayerQueries> anyDrawn;

    // A layer starts with the depth of the opaque surfaces: faces behind them fail the depth test, and pixels
    // without a face keep that depth.
    void copyDepth(const FrameContext& context, std::size_t number) const {
        if (!isBounded || (number == 0 && hasWholeDepth))
            return copyTarget(*surfaceDepth, *depths[number], {0, 0}, size);
        for (const ScreenRect& rect : context.blendedRects)
            copyTarget(*surfaceDepth, *depths[number], rect.min, rect.size());
    }

    void drawFaces(FrameContext& context, const QuadDraw& quads, std::size_t number) const {
        if (rays.first) return rays.draw(context, number == 0 ? nullptr : depths[number - 1].get());
        (number == 0 ? first : next)->use();
        quads.draw(context.pipeline,
                   {.depthTest = gpu::DepthTest::Greater, .readsSampleId = number > 0 && samples > 1},
                   mesh::AlphaClass::Blended);
    }

    void drawLayer(FrameContext& context, const QuadDraw& quads, std::size_t number) const {
        framebuffers[number]->bind();
        // No layers are behind one without faces: the GPU skips their drawing, not the copy above.
        if (number > 0) {
            glBeginConditionalRender(anyDrawn->ofLayer[number - 1].id(), GL_QUERY_WAIT);
            gpu::TextureSet().add(shared::kTransparencyDepthUnit, depths[number - 1]->id()).bind();
        }
        glBeginQuery(GL_ANY_SAMPLES_PASSED, anyDrawn->ofLayer[number].id());
        drawFaces(context, quads, number);
        glEndQuery(GL_ANY_SAMPLES_PASSED);
        if (number > 0) glEndConditionalRender();
    }

    void record(FrameContext& context) const {
        context.nearestDepth = depths[0].get();
        context.worldTextures.bind();
        const QuadDraw quads = context.quadDraw();
        if (!rays.first) quads.bind();
        for (std::size_t number = 0; number < depths.size(); ++number) {
            copyDepth(context, number);
            drawLayer(context, quads, number);
        }
    }
};

struct ShadeLayers {
    std::array<const gpu::Program*, 2> shade{};  // in air, under water
    OcclusionPrograms occlusion{};
    bool hasOcclusion = false, isDirect = false, drawsQuads = false, isBounded = true;
    bool castsRays = false;  // for shadows
    PixelMask mask;          // one sample, or a single layer: none
    std::shared_ptr<const gpu::Framebuffer>
        over;  // where quads are drawn: the scene or the image, with the first layer's depth
    TargetRef scene;
    std::vector<TargetRef> layers, depths;
    glm::ivec2 size{0};
    std::shared_ptr<const LayerQueries> anyDrawn;

    gpu::TextureSet layerTextures() const {
        gpu::TextureSet textures;
        for (std::size_t k = 0; k < layers.size(); ++k) {
            const auto unit = static_cast<GLuint>(k);
            textures.add(shared::kTransparencyColorUnit + unit, layers[k]->id());
            textures.add(shared::kTransparencyDepthUnit + unit, depths[k]->id());
        }
        return textures;
    }

    void drawOverQuads(FrameContext& context, const gpu::Program& program,
                       const gpu::TextureSet& textures) const {
        over->bind();
        const QuadDraw quads = context.quadDraw();
        quads.bind();
        textures.bind();
        program.use();
        quads.draw(context.pipeline,
                   {.depthTest = gpu::DepthTest::Equal,
                    .writesDepth = false,
                    .blending = isDirect ? gpu::Blending::Off : gpu::Blending::Through},
                   mesh::AlphaClass::Blended);
    }

    void drawWithin(FrameContext& context, const gpu::Program& program, const gpu::TextureSet& textures,
                    std::span<const ScreenRect> rects) const {
        if (mask.program) mask.draw(context, layerTextures(), rects);
        context.frame.scene->bind();
        drawFullscreen(context, program,
                       {.depthTest = mask.program ? gpu::DepthTest::Less : gpu::DepthTest::Off,
                        .writesDepth = false,
                        .blending = gpu::Blending::Through},
                       textures, rects);
    }

    void record(FrameContext& context) const {
        const ScreenRect all{{0, 0}, size};
        const std::span<const ScreenRect> rects =
            isBounded ? std::span(context.blendedRects) : std::span(&all, 1);
        glBeginConditionalRender(anyDrawn->ofLayer[0].id(), GL_QUERY_WAIT);
        if (hasOcclusion) {
            const ScreenRect bounds = boundsOf(rects);  // one rectangle: the blur reads beyond its edges
            const gpu::Scissor scissor(bounds.min, bounds.size());
            occlusion.draw(context, context.frame.gbufferTextures().add(layerTextures()));
        }
        // The scene is that of pixels without layers: see water_reflection.glsl.
        gpu::TextureSet textures =
            context.shadingTextures().add(context.frame.gbufferTextures()).add(layerTextures());
        if (!isDirect) textures.add(shared::kSceneUnit, scene->id());
        if (hasOcclusion) textures.add(shared::kOcclusionUnit, occlusion.visibility.target->id());
        if (castsRays) bindRays(context, false);
        const gpu::Program& program = *shade[context.isUnderWater() ? 1 : 0];
        if (drawsQuads) {
            drawOverQuads(context, program, textures);
        } else {
            drawWithin(context, program, textures, rects);
        }
        glEndConditionalRender();
    }
};

base::Result<void> makeQuadPrograms(FrameBuilder& build, Peel& peel) {
    PeelVariant variant{build.samples(), false, build.features().hasFaceSampling, build.features().hasTint};
    peel.first = TERRANE_TRY(build.programs.quads("shading/depth_peel", variant.defines()));
    variant.isNext = true;
    if (build.options().transparencyLayers > 1)
        peel.next = TERRANE_TRY(build.programs.quads("shading/depth_peel", variant.defines()));
    return {};
}

base::Result<void> makeLayerTargets(FrameBuilder& build, Peel& peel) {
    SharedTargets& targets = build.frame.targets;
    const auto count = static_cast<std::size_t>(build.options().transparencyLayers);
    for (std::size_t k = 0; k < count; ++k) {
        targets.layers.push_back(build.target({kLayerLabels[k], GL_RGBA16, peel.size, peel.samples}));
        targets.layerDepths.push_back(
            build.target({kDepthLabels[k], GL_DEPTH_COMPONENT32F, peel.size, peel.samples}));
        auto framebuffer =
            TERRANE_TRY(build.framebuffer("layer", {targets.layers.back()}, targets.layerDepths.back()));
        framebuffer->clearColor(0, glm::vec4(0));  // pixels without a face are read, but never used
        peel.framebuffers.push_back(std::move(framebuffer));
    }
    return {};
}

}  // namespace

// Only within rectangles that contain all pixels with blended faces; costs nothing if no mesh section in view
// has any.
MaybePass makePeel(FrameBuilder& build) {
    const RenderOptions& options = build.options();
    if (options.transparencyLayers == 0 || options.shading == Shading::Corners) return std::nullopt;
    Peel peel;
    if (castsRays(build))
        peel.rays = TERRANE_TRY(RayLayerPrograms::make(build));
    else
        TERRANE_TRY(makeQuadPrograms(build, peel));
    peel.size = build.frame.spec.size;
    peel.samples = build.samples();
    peel.isBounded = showsAllLayers(build);
    peel.hasWholeDepth = options.occlusion != Occlusion::Off || options.depthOfField;
    TERRANE_TRY(makeLayerTargets(build, peel));
    SharedTargets& targets = build.frame.targets;
    peel.depths = targets.layerDepths;
    peel.surfaceDepth = targets.depth;
    peel.anyDrawn = std::make_shared<LayerQueries>();
    for (auto& query : peel.anyDrawn->ofLayer) query = gpu::createQuery(GL_ANY_SAMPLES_PASSED);
    targets.anyLayer = peel.anyDrawn;
    std::vector<TargetRef> writes = targets.layers;
    writes.insert(writes.end(), targets.layerDepths.begin(), targets.layerDepths.end());
    return Pass{.reads = {targets.depth},
                .writes = std::move(writes),
                .record = [peel](FrameContext& context) { peel.record(context); },
                .isNeeded =
                    [size = peel.size, hasRays = castsRays(build)](FrameContext& context) {
                        if (hasRays)
                            context.blendedRects = {{{0, 0}, size}};
                        else
                            context.blendedRects = context.meshSections.blendedRects(
                                cameraChunk(context.input.camera), context.view.viewProjection, size);
                        return !context.blendedRects.empty();
                    }};
}

MaybePass makeShadeLayers(FrameBuilder& build) {
    const RenderOptions& options = build.options();
    if (options.transparencyLayers == 0) return std::nullopt;
    if (options.shading == Shading::Corners) return makeCornerLayers(build);
    const SharedTargets& targets = build.frame.targets;
    ShadeLayers pass;
    pass.drawsQuads = shadesQuads(build);
    pass.isDirect = build.frame.isDirect();
    pass.isBounded = showsAllLayers(build);
    pass.hasOcclusion = options.occlusion != Occlusion::Off;
    TransparencyVariant variant{
        .samples = build.samples(),
        .layers = options.transparencyLayers,
        .sun = SunVariant::of(options, build.features()),
        .hasOcclusion = pass.hasOcclusion,
        .hasWaterDetail = options.water == Water::Full,
        .light = options.light == LightSampling::Smooth ? LightDetail::Smooth : LightDetail::Classic,
        .drawsQuads = pass.drawsQuads,
        .isDirect = pass.isDirect};
    pass.castsRays = variant.sun.shadows == ShadowEdges::Rays;
    for (const bool isUnderWater : {false, true}) {
        variant.isUnderWater = isUnderWater;
        pass.shade[isUnderWater ? 1 : 0] = TERRANE_TRY(
            pass.drawsQuads ? build.programs.quads("shading/transparency", variant.defines())
                            : build.programs.fullscreen("shading/transparency", variant.defines()));
    }
    if (pass.isBounded) pass.mask = TERRANE_TRY(PixelMask::make(build, MaskOf::Layers));
    if (pass.hasOcclusion) pass.occlusion = TERRANE_TRY(OcclusionPrograms::make(build, true));
    if (pass.drawsQuads)
        pass.over = TERRANE_TRY(build.framebuffer(
            "over layers", {pass.isDirect ? targets.image : targets.scene}, targets.layerDepths[0]));
    pass.scene = targets.scene;
    pass.layers = targets.layers;
    pass.depths = targets.layerDepths;
    pass.size = build.frame.spec.size;
    pass.anyDrawn = targets.anyLayer;
    std::vector<TargetRef> reads = {targets.surfaces, targets.depth};
    if (!pass.isDirect) reads.push_back(targets.scene);
    reads.insert(reads.end(), targets.layers.begin(), targets.layers.end());
    reads.insert(reads.end(), targets.layerDepths.begin(), targets.layerDepths.end());
    return Pass{.reads = std::move(reads),
                .writes = {pass.isDirect ? targets.image : targets.scene},
                .record = [pass](FrameContext& context) { pass.record(context); },
                .isNeeded = [](FrameContext& context) { return !context.blendedRects.empty(); }};
}

}  // namespace terrane::render
