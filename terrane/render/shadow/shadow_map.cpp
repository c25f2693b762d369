#include "terrane/render/shadow/shadow_map.h"

#include <cassert>
#include <glm/matrix.hpp>

#include "terrane/base/log.h"
#include "terrane/gpu/debug.h"
#include "terrane/render/frame/frame.h"
#include "terrane/render/quads/quad_store.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {
namespace {

constexpr gpu::PipelineState kNearestToLight{.depthTest = gpu::DepthTest::Greater, .clampsDepth = true};

constexpr int kMapTiles = static_cast<int>(shared::kShadowTiles);

// 256 is the largest alignment that OpenGL allows drivers to require for uniforms.
struct alignas(256) AlignedDraw {
    shared::ShadowDraw draw;
};

shared::ShadowDraw uniformsOf(const ShadowTiles& tiles) {
    const double blocks = shadowTileBlocks(tiles.cascade);
    const glm::dmat3 axes = glm::transpose(tiles.plane.toLight);
    glm::dmat4 rows(0);  // of the matrix
    for (int axis = 0; axis < 2; ++axis) {
        const double half = 0.5 * blocks * tiles.size[axis];
        rows[axis] = {axes[axis] / half, -1 - tiles.place[axis] * blocks / half};
    }
    rows[2] = {axes[2] / double{shared::kShadowRange}, 0.5};
    rows[3] = {0, 0, 0, 1};
    shared::ShadowDraw draw{};
    draw.toClip = glm::mat4(glm::transpose(rows));
    draw.toLight = glm::vec4(axes[2], 0);
    draw.anchorChunk = {tiles.plane.anchor.x, tiles.plane.anchor.y};
    return draw;
}

gpu::Texture2DArray mapsOf(int texels, int count) {
    return {{{texels, texels}, count, 1}, GL_DEPTH_COMPONENT32F, "shadow map"};
}

base::Result<std::vector<gpu::Framebuffer>> layersOf(const gpu::Texture2DArray& maps) {
    std::vector<gpu::Framebuffer> layers;
    for (int layer = 0; layer < maps.shape().layers; ++layer) {
        auto framebuffer = TERRANE_TRY(gpu::Framebuffer::create({{}, {maps, layer}}, "shadow map"));
        layers.push_back(std::move(framebuffer));
    }
    return layers;
}

// Replaces the buffer if it is too small.
template <class T>
void uploadTo(gpu::Buffer& buffer, const std::vector<T>& values, std::string_view label) {
    if (const std::size_t grown = grownBytes(buffer, values.size() * sizeof(T)))
        buffer = gpu::Buffer(grown, GL_DYNAMIC_STORAGE_BIT, label);
    buffer.uploadVector(0, values);
}

}  // namespace

base::Result<ShadowMap> ShadowMap::create(const Shape& shape) {
    assert(shape.cascades > 0 && shape.texels % kMapTiles == 0 && "tiles have whole texels");
    ShadowMap map;
    map.shape_ = shape;
    map.clipmap_ = ShadowClipmap(shape.cascades);
    map.depths_ = mapsOf(shape.texels, map.clipmap_.layers());
    map.layers_ = TERRANE_TRY(layersOf(map.depths_));
    map.compared_ =
        gpu::Sampler({.wrapS = GL_REPEAT, .wrapT = GL_REPEAT, .compare = GL_GEQUAL}, "shadow map");
    map.plain_ = gpu::Sampler(
        {.minFilter = GL_NEAREST, .magFilter = GL_NEAREST, .wrapS = GL_REPEAT, .wrapT = GL_REPEAT},
        "depths of the shadow map");
    return map;
}

void ShadowMap::markChanged(std::span<const CasterBox> boxes) {
    for (const CasterBox& box : boxes) clipmap_.markChanged(box);
}

std::vector<ShadowMap::Drawing> ShadowMap::prepare(const std::vector<ShadowTiles>& tiles,
                                                   const MeshSectionTable& meshSections) {
    std::vector<Drawing> drawings;
    std::vector<AlignedDraw> uniforms;
    for (const ShadowTiles& rectangle : tiles) {
        drawings.push_back(
            {rectangle, castersOf(rectangle, meshSections.slotRecords(), meshSections.arenaQuads())});
        uniforms.push_back({uniformsOf(rectangle)});
        for (const CasterList& list : drawings.back().lists) drawnTriangles_ += 2 * list.quads;
    }
    uploadTo(uniforms_, uniforms, "shadow tiles");
    return drawings;
}

// Uploads the records of the first drawing and of others as long as they fit, one after the other. Returns
// the number of drawings.
std::size_t ShadowMap::uploadRecords(std::span<Drawing> drawings, std::uint32_t most) {
    std::vector<shared::DrawRecord> records;
    std::size_t count = 0;
    for (Drawing& drawing : drawings) {
        std::size_t added = 0;
        for (const CasterList& list : drawing.lists) added += list.records.size();
        if (count > 0 && records.size() + added > most) break;
        ++count;
        for (CasterList& list : drawing.lists) {
            const auto first = static_cast<std::uint32_t>(records.size());
            for (shared::DrawCommand& command : list.commands) command.baseInstance += first;
            records.insert(records.end(), list.records.begin(), list.records.end());
        }
    }
    if (records.empty()) records.emplace_back();  // tiles without casters are cleared; no buffer is empty
    uploadTo(records_, records, "shadow draw records");
    return count;
}

// Draws go only into the tiles while the result lives.
gpu::Scissor ShadowMap::bindTiles(const ShadowTiles& tiles, std::size_t layer) const {
    const int texels = shape_.texels / kMapTiles;
    const glm::ivec2 corner = texels * tiles.slot(), size = texels * tiles.size;
    layers_[layer].bind();
    glViewport(corner.x, corner.y, size.x, size.y);
    return gpu::Scissor(corner, size);
}

// Depth grows toward the light. Casters beyond the range are drawn too: their depth is clamped. The scissor
// test stays on, so that no triangle leaves its tiles, whatever the driver clips to.
void ShadowMap::draw(gpu::Pipeline& pipeline, const ShadowPrograms& programs, const Drawing& drawing,
                     const Casters& casters) const {
    pipeline.set(kNearestToLight);
    const auto layer = static_cast<std::size_t>(drawing.tiles.layer);
    const gpu::Scissor scissor = bindTiles(drawing.tiles, layer);
    layers_[layer].clearDepth(0.0f);
    for (std::size_t k = 0; k < drawing.lists.size(); ++k) {
        const std::vector<shared::DrawCommand>& commands = drawing.lists[k].commands;
        if (commands.empty()) continue;
        const int bucket = static_cast<int>(k) % kCasterBuckets;
        gpu::PipelineState state = kNearestToLight;
        state.cullsBackFaces = !mesh::bucketTwoSided(bucket);
        pipeline.set(state);
        (mesh::bucketAlphaClass(bucket) == mesh::AlphaClass::Opaque ? programs.opaque : programs.tested)
            ->use();
        casters.quads.texels(k / kCasterBuckets).bind(shared::kQuadsUnit);
        // The CPU has the commands, and tiles are drawn seldom. Mesa 22.3.6 (llvmpipe) lost some commands of
        // indirect draws here.
        drawCommands(DrawMethod::Loop, {.onCpu = commands});
    }
}

void ShadowMap::update(gpu::Pipeline& pipeline, const Casters& casters, const ShadowPrograms& programs,
                       const Camera& camera, glm::vec3 lightDirection, std::size_t maxTiles) {
    const std::vector<ShadowTiles> tiles = clipmap_.update(camera, lightDirection, maxTiles);
    drawnTriangles_ = 0;
    if (tiles.empty()) return;
    std::vector<Drawing> drawings = prepare(tiles, casters.meshSections);
    std::size_t end = 0;
    for (std::size_t k = 0; k < drawings.size(); ++k) {
        if (k == end) {
            end += uploadRecords(std::span(drawings).subspan(k), casters.maxCommands);
            casters.resources.bind(records_, false);
        }
        uniforms_.bindUniform(shared::kShadowDrawBinding, k * sizeof(AlignedDraw),
                              sizeof(shared::ShadowDraw));
        draw(pipeline, programs, drawings[k], casters);
    }
}

// Adds a layer for figures; the maps are kept.
bool ShadowMap::addFigureLayer() {
    if (layers_.size() > figureLayer()) return true;
    auto depths = mapsOf(shape_.texels, clipmap_.layers() + 1);
    auto layers = layersOf(depths);
    if (!layers) {
        base::logWarning("players cast no shadows: {}", layers.error().message);
        canHaveFigures_ = false;
        return false;
    }
    glCopyImageSubData(depths_.id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, depths.id(), GL_TEXTURE_2D_ARRAY, 0, 0,
                       0, 0, shape_.texels, shape_.texels, clipmap_.layers());
    depths_ = std::move(depths);
    layers_ = std::move(*layers);
    return true;
}

void ShadowMap::copyToFigureLayer(int layer, std::span<const glm::ivec2> slots) const {
    const int texels = shape_.texels / kMapTiles;
    for (const glm::ivec2 slot : slots)
        glCopyImageSubData(depths_.id(), GL_TEXTURE_2D_ARRAY, 0, texels * slot.x, texels * slot.y, layer,
                           depths_.id(), GL_TEXTURE_2D_ARRAY, 0, texels * slot.x, texels * slot.y,
                           static_cast<GLint>(figureLayer()), texels, texels, 1);
}

void ShadowMap::drawFigures(gpu::Pipeline& pipeline, const FigurePass& pass, const ShadowPrograms& programs,
                            const FigureCasters& figures, gpu::MappedRing& ring) {
    hasFigures_ = false;
    if (figures.records.empty() || !canHaveFigures_ || !addFigureLayer()) return;
    std::vector<glm::dvec3> feet;
    const glm::dvec3 corner = cornerOfChunk(figures.chunk);
    for (const shared::FigureRecord& record : figures.records)
        feet.push_back(corner + glm::dvec3(glm::vec3(record.feet)));
    const NearestShadowMap map = clipmap_.nearest();
    const FigureShadowPlan plan = figureShadows_.plan(map, feet);
    if (plan.draws.empty()) return;
    const gpu::DebugGroup group("shadows of figures");
    hasFigures_ = true;
    copyToFigureLayer(map.layer, plan.copies);
    pipeline.set(kNearestToLight);
    pass.bind(figures.records, ring);
    for (const ShadowTiles& tiles : plan.draws) {
        const shared::ShadowDraw draw = uniformsOf(tiles);
        ring.writeUniform(shared::kShadowDrawBinding, draw);
        const gpu::Scissor scissor = bindTiles(tiles, figureLayer());
        pass.draw(*programs.figures, figures.records.size());
    }
}

void ShadowMap::writeUniforms(const Camera& camera, bool isLit, gpu::MappedRing& ring) const {
    shared::ShadowFrame frame{};
    if (isLit) frame = clipmap_.frame(camera, shape_.texels);
    if (isLit && hasFigures_) frame.layers[0] = static_cast<float>(figureLayer());
    frame.strength = isLit ? 1.0f : 0.0f;
    ring.writeUniform(shared::kShadowBinding, frame);
}

void ShadowMap::addTo(gpu::TextureSet& textures) const {
    textures.add(shared::kShadowUnit, depths_.id(), &compared_)
        .add(shared::kShadowDepthsUnit, depths_.id(), &plain_);
}

// The shadow map within a frame.
MaybePass makeShadowMap(FrameBuilder& build) {
    if (!build.frame.shadowMap) return std::nullopt;
    const auto quads = [&](const ShadowVariant& variant) {
        return build.programs.quads("shadow/shadow", variant.defines());
    };
    ShadowPrograms programs{};
    programs.opaque = TERRANE_TRY(quads({mesh::AlphaClass::Opaque, false}));
    programs.tested = TERRANE_TRY(quads({mesh::AlphaClass::Tested, build.features().hasFaceSampling}));
    programs.figures = TERRANE_TRY(build.programs.graphics("figures/figure", "figures/figure_shadow",
                                                           FigureVariant{QuadPass::Shadows}.defines()));
    return Pass{
        .record =
            [programs](FrameContext& context) {
                const FrameInput& input = context.input;
                ShadowMap& map = *context.frame.shadowMap;
                map.update(
                    context.pipeline,
                    {context.resources, context.quads, context.meshSections, context.cull.limits().commands},
                    programs, input.camera, input.environment.lightDirection, input.maxShadowTiles);
                const auto figures = figureRecords(input.figures, input.camera, {}, kFigureShadowReach);
                map.drawFigures(context.pipeline, context.figures, programs,
                                {figures, cameraChunk(input.camera)}, context.ring);
                map.writeUniforms(input.camera, true, context.ring);
            },
        .isNeeded = [](FrameContext& context) { return context.hasShadows; },
        .drawnIn = DrawnIn::EveryView};
}

}  // namespace terrane::render
