#include "terrane/render/shadow_map.h"

#include <cassert>
#include <glm/matrix.hpp>

#include "terrane/gpu/debug.h"
#include "terrane/render/growing_buffer.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {
namespace {

constexpr int kMapTiles = static_cast<int>(shared::kShadowTiles);

// OpenGL asks uniforms to begin at multiples of at most so much.
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

}  // namespace

ShadowMap::ShadowMap(const gpu::ShaderLoader& shaders)
    : opaque_(quadShaders(shaders, "shadow", "opaque shadows")),
      tested_(quadShaders(shaders, "shadow", "tested shadows")),
      compared_({.wrapS = GL_REPEAT, .wrapT = GL_REPEAT, .compare = GL_GEQUAL}, "shadow map"),
      plain_({.minFilter = GL_NEAREST, .magFilter = GL_NEAREST, .wrapS = GL_REPEAT, .wrapT = GL_REPEAT},
             "depths of the shadow map") {}

base::Result<void> ShadowMap::configure(const Shape& shape, bool hasFaceSampling) {
    assert(shape.texels % kMapTiles == 0 && "tiles have whole texels");
    if (shape.cascades > 0) {
        auto selected =
            opaque_.select(defined({{"PASS", 2}, {"ALPHA_CLASS", 0}, {"FACE_SAMPLING", 0}, {"TINT", 0}}));
        if (selected)
            selected = tested_.select(
                defined({{"PASS", 2}, {"ALPHA_CLASS", 1}, {"FACE_SAMPLING", hasFaceSampling}, {"TINT", 0}}));
        if (!selected) return selected;
    }
    if (shape == shape_) return {};
    layers_.clear();
    depths_ = {};
    shape_ = {};
    clipmap_ = ShadowClipmap(shape.cascades);
    if (shape.cascades == 0) return {};
    gpu::Texture2DArray depths({{shape.texels, shape.texels}, clipmap_.layers(), 1}, GL_DEPTH_COMPONENT32F,
                               "shadow map");
    std::vector<gpu::Framebuffer> layers;
    for (int layer = 0; layer < clipmap_.layers(); ++layer) {
        auto framebuffer = gpu::Framebuffer::create({{}, {depths, layer}}, "shadow map");
        if (!framebuffer) return tl::unexpected(framebuffer.error());
        layers.push_back(std::move(*framebuffer));
    }
    depths_ = std::move(depths);
    layers_ = std::move(layers);
    shape_ = shape;
    return {};
}

void ShadowMap::markChanged(std::span<const CasterBox> boxes) {
    for (const CasterBox& box : boxes) clipmap_.markChanged(box);
}

void ShadowMap::upload(const std::vector<Drawing>& drawings,
                       const std::vector<shared::DrawCommand>& commands) {
    std::vector<AlignedDraw> uniforms;
    for (const Drawing& drawing : drawings) uniforms.push_back({uniformsOf(drawing.tiles)});
    const auto write = [](gpu::Buffer& buffer, const auto& values, std::string_view label) {
        const auto bytes = std::as_bytes(std::span(values));
        if (bytes.empty()) return;
        if (const std::size_t grown = grownBytes(buffer, bytes.size()))
            buffer = gpu::Buffer(grown, GL_DYNAMIC_STORAGE_BIT, label);
        buffer.upload(0, bytes);
    };
    write(commands_, commands, "shadow draw commands");
    write(uniforms_, uniforms, "shadow tiles");
}

std::vector<ShadowMap::Drawing> ShadowMap::prepare(const std::vector<ShadowTiles>& tiles,
                                                   const MeshSectionTable& meshSections) {
    std::vector<Drawing> drawings;
    std::vector<shared::DrawCommand> commands;
    drawnTriangles_ = 0;
    for (const ShadowTiles& rectangle : tiles) {
        Drawing drawing{rectangle, {}};
        const std::vector<CasterList> lists =
            castersOf(rectangle, meshSections.slotRecords(), meshSections.arenaQuads());
        for (std::size_t k = 0; k < lists.size(); ++k) {
            if (lists[k].commands.empty()) continue;
            drawing.lists.push_back({k, commands.size(), lists[k].commands.size()});
            commands.insert(commands.end(), lists[k].commands.begin(), lists[k].commands.end());
            drawnTriangles_ += 2 * lists[k].quads;
        }
        drawings.push_back(std::move(drawing));
    }
    upload(drawings, commands);
    return drawings;
}

void ShadowMap::clear(const ShadowTiles& tiles) const {
    const int texels = shape_.texels / kMapTiles;
    const glm::ivec2 corner = texels * tiles.slot(), size = texels * tiles.size;
    const gpu::Framebuffer& layer = layers_[static_cast<std::size_t>(tiles.layer)];
    layer.bind();
    glViewport(corner.x, corner.y, size.x, size.y);
    glEnable(GL_SCISSOR_TEST);
    glScissor(corner.x, corner.y, size.x, size.y);
    layer.clearDepth(0.0f);
    glDisable(GL_SCISSOR_TEST);
}

// Depth grows toward the light. What lies beyond the range casts too: its depth is clamped.
void ShadowMap::draw(gpu::Pipeline& pipeline, const Drawing& drawing, const QuadStore& quads) const {
    constexpr gpu::PipelineState kNearestToLight{.depthTest = gpu::DepthTest::Greater, .clampsDepth = true};
    pipeline.set(kNearestToLight);
    clear(drawing.tiles);
    for (const ListRange& range : drawing.lists) {
        const int bucket = static_cast<int>(range.list) % kCasterBuckets;
        gpu::PipelineState state = kNearestToLight;
        state.cullsBackFaces = !mesh::bucketTwoSided(bucket);
        pipeline.set(state);
        (mesh::bucketAlphaClass(bucket) == mesh::AlphaClass::Opaque ? opaque_ : tested_).use();
        quads.texels(range.list / kCasterBuckets).bind(shared::kQuadsUnit);
        glMultiDrawElementsIndirect(
            GL_TRIANGLES, GL_UNSIGNED_SHORT,
            reinterpret_cast<const void*>(range.firstCommand * sizeof(shared::DrawCommand)),
            static_cast<GLsizei>(range.count), 0);
    }
}

void ShadowMap::update(gpu::Pipeline& pipeline, const Casters& casters, const Camera& camera,
                       glm::vec3 lightDirection, std::size_t maxTiles) {
    const gpu::DebugGroup group("shadow map");
    const std::vector<ShadowTiles> tiles = clipmap_.update(camera, lightDirection, maxTiles);
    drawnTriangles_ = 0;
    if (tiles.empty()) return;
    const std::vector<Drawing> drawings = prepare(tiles, casters.meshSections);
    casters.resources.bind(casters.meshSections, false);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.id());
    for (std::size_t k = 0; k < drawings.size(); ++k) {
        uniforms_.bindUniform(shared::kShadowDrawBinding, k * sizeof(AlignedDraw),
                              sizeof(shared::ShadowDraw));
        draw(pipeline, drawings[k], casters.quads);
    }
}

void ShadowMap::bindUniforms(const Camera& camera, bool isLit, gpu::MappedRing& ring) const {
    if (!isOn()) return;
    shared::ShadowFrame frame{};
    if (isLit) frame = clipmap_.frame(camera, shape_.texels);
    frame.strength = isLit ? 1.0f : 0.0f;
    const auto slice = ring.write(std::span<const shared::ShadowFrame>(&frame, 1));
    assert(slice && "the ring has room for the uniforms of a frame");
    ring.bindUniform(shared::kShadowBinding, *slice);
}

void ShadowMap::bind() const {
    depths_.bind(shared::kShadowUnit);
    compared_.bind(shared::kShadowUnit);
    depths_.bind(shared::kShadowDepthsUnit);
    plain_.bind(shared::kShadowDepthsUnit);
}

}  // namespace terrane::render
