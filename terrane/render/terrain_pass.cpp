#include "terrane/render/terrain_pass.h"

#include <cassert>
#include <span>

#include "terrane/gpu/debug.h"
#include "terrane/mesh/shape_faces.h"
#include "terrane/shared/bindings.h"
#include "terrane/shared/material.h"

namespace terrane::render {
namespace {

static_assert(static_cast<shared::uint>(world::AlphaMode::TestGlow) == shared::kAlphaTestGlow);
static_assert(static_cast<shared::uint>(world::Animation::LiquidSurface) == shared::kAnimationLiquidSurface);

// Corners 0 1 2, 2 1 3 of each quad; 6 × 16,384 × 2 bytes = 192 KiB.
gpu::Buffer quadIndices() {
    std::vector<std::uint16_t> indices;
    for (std::uint32_t quad = 0; quad < kMaxQuadsPerCommand; ++quad) {
        for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) {
            indices.push_back(static_cast<std::uint16_t>(4 * quad + corner));
        }
    }
    return gpu::Buffer(std::as_bytes(std::span(indices)), 0, "quad indices");
}

gpu::Buffer materialRecords(const world::BlockRegistry& blocks) {
    std::vector<shared::MaterialRecord> records;
    for (const world::Material& m : blocks.materials()) {
        records.push_back(
            {m.texture, static_cast<shared::uint>(m.alpha), static_cast<shared::uint>(m.animation), 0});
    }
    return gpu::Buffer(std::as_bytes(std::span(records)), 0, "materials");
}

void setState(int context) {
    const bool isBlended = mesh::contextAlphaClass(context) == mesh::AlphaClass::Blended;
    (mesh::contextTwoSided(context) ? glDisable : glEnable)(GL_CULL_FACE);
    (isBlended ? glEnable : glDisable)(GL_BLEND);
    glDepthMask(isBlended ? GL_FALSE : GL_TRUE);
}

}  // namespace

base::Result<TerrainPass> TerrainPass::create(const gpu::ShaderLoader& shaders,
                                              const world::BlockRegistry& blocks,
                                              gpu::Texture2DArray textures, float anisotropy) {
    TerrainPass pass;
    for (std::size_t light = 0; light < pass.programs_.size(); ++light) {
        for (std::size_t alphaClass = 0; alphaClass < pass.programs_[light].size(); ++alphaClass) {
            const gpu::ShaderDefines defines = {{"ALPHA_CLASS", std::to_string(alphaClass)},
                                                {"LIGHT_SMOOTH", std::to_string(light)}};
            auto program = gpu::Program::graphics(shaders, "terrane/render/terrain.vert.glsl",
                                                  "terrane/render/terrain.frag.glsl", defines, "terrain");
            if (!program) return tl::unexpected(program.error());
            pass.programs_[light][alphaClass] = std::move(*program);
        }
    }
    pass.textures_ = std::move(textures);
    pass.sampler_ = gpu::Sampler({.minFilter = GL_LINEAR_MIPMAP_LINEAR,
                                  .magFilter = GL_LINEAR,
                                  .wrapS = GL_REPEAT,
                                  .wrapT = GL_REPEAT,
                                  .maxAnisotropy = anisotropy},
                                 "block textures");
    pass.indices_ = quadIndices();
    pass.shapeFaces_ = gpu::Buffer(std::as_bytes(mesh::shapeFaces()), 0, "shape faces");
    pass.materials_ = materialRecords(blocks);
    pass.vertexArray_ = gpu::VertexArray("quads");
    pass.vertexArray_.setElementBuffer(pass.indices_);
    return pass;
}

void TerrainPass::draw(const DrawList& list, const QuadStore& quads, gpu::MappedRing& ring,
                       LightSampling light) {
    if (list.records.empty()) return;
    const gpu::DebugGroup group("terrain");
    const auto records = ring.write(std::span(list.records));
    assert(records && "the ring holds a frame's draws");
    ring.buffer().bindStorage(shared::kDrawsBinding, records->offsetBytes, records->data.size());
    quads.buffer().bindStorage(shared::kQuadsBinding);
    shapeFaces_.bindStorage(shared::kShapeFacesBinding);
    materials_.bindStorage(shared::kMaterialsBinding);
    textures_.bind(shared::kBlockTexturesUnit);
    sampler_.bind(shared::kBlockTexturesUnit);
    vertexArray_.bind();
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, ring.buffer().id());
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    const Programs& programs = programs_[static_cast<std::size_t>(light)];
    for (int context = 0; context < mesh::kContextCount; ++context)
        drawContext(list, context, ring, programs);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
}

void TerrainPass::drawContext(const DrawList& list, int context, gpu::MappedRing& ring,
                              const Programs& programs) {
    const auto& commands = list.commands[static_cast<std::size_t>(context)];
    if (commands.empty()) return;
    const auto slice = ring.write(std::span(commands));
    assert(slice && "the ring holds a frame's draws");
    setState(context);
    programs[static_cast<std::size_t>(mesh::contextAlphaClass(context))].use();
    const void* offset = reinterpret_cast<const void*>(slice->offsetBytes);
    glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, offset,
                                static_cast<GLsizei>(commands.size()), 0);
}

}  // namespace terrane::render
