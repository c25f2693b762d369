#include "terrane/render/cull/quad_list.h"

#include <algorithm>
#include <span>

#include "terrane/gpu/debug.h"
#include "terrane/render/quads/quad_store.h"
#include "terrane/shared/bindings.h"
#include "terrane/shared/quad.h"

namespace terrane::render {
namespace {

// The list has room for one in this many of all quads: in a landscape one in fifteen is in the image.
constexpr std::size_t kQuadsForOneListed = 4;
constexpr GLuint kGroups = 16;  // a list's commands are distributed over them

}  // namespace

base::Result<QuadList> QuadList::create(const gpu::ShaderLoader& shaders, const DrawLimits& limits) {
    QuadList list;
    list.maxQuads_ = limits.ofDriver().listedQuads;
    auto program = TERRANE_TRY(
        gpu::Program::compute(shaders, "terrane/render/cull/quad_list.comp.glsl", {}, "list quads"));
    list.program_ = std::move(program);
    list.reserve(0);
    return list;
}

void QuadList::reserve(std::size_t quads) {
    const std::size_t listed = std::min(quads / kQuadsForOneListed, maxQuads_);
    const std::size_t bytes = gpu::grownBytes(list_.sizeBytes(), (1 + listed) * sizeof(shared::uint),
                                              (1 + maxQuads_) * sizeof(shared::uint));
    if (bytes == 0) return;
    list_ = gpu::Buffer(bytes, GL_DYNAMIC_STORAGE_BIT, "listed quads");
    texels_ = gpu::BufferTexture(list_, GL_R32UI, "listed quads");
}

void QuadList::run(const QuadStore& quads, shared::uint bit) {
    const gpu::DebugGroup group("list quads");
    reserve(quads.usedBytes() / shared::kQuadBytes);
    const shared::uint count = 1;
    list_.upload(0, std::as_bytes(std::span(&count, 1)));
    list_.bindStorage(shared::kListedQuadsBinding);
    program_.use();
    program_.set(shared::kListedBitLocation, bit);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    const std::vector<const gpu::Buffer*> arenas = quads.buffers().buffers;
    for (std::size_t arena = 0; arena < arenas.size(); ++arena) {
        arenas[arena]->bindStorage(shared::kQuadsBinding);
        program_.set(shared::kArenaLocation, static_cast<GLuint>(arena));
        glDispatchCompute(kGroups, shared::kListedDrawLists, 1);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace terrane::render
