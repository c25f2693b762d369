#include "terrane/render/quad_cull.h"

#include <span>

#include "terrane/gpu/debug.h"
#include "terrane/render/growing_buffer.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {

base::Result<QuadCull> QuadCull::create(const gpu::ShaderLoader& shaders) {
    QuadCull cull;
    auto program =
        TERRANE_TRY(gpu::Program::compute(shaders, "terrane/render/quad_cull.comp.glsl", {}, "cull quads"));
    cull.program_ = std::move(program);
    return cull;
}

void QuadCull::begin(std::uint32_t meshSections) {
    const std::size_t needed = sizeof(shared::TestedMeshSections) + meshSections * sizeof(shared::uint);
    if (const std::size_t bytes = grownBytes(list_, needed); bytes > 0)
        list_ = gpu::Buffer(bytes, GL_DYNAMIC_STORAGE_BIT, "mesh sections to test");
    const shared::TestedMeshSections none{0, 1, 1};
    list_.upload(0, std::as_bytes(std::span(&none, 1)));
    list_.bindStorage(shared::kTestedMeshSectionsBinding);
}

void QuadCull::run(const QuadStore& quads, const QuadResources& resources) const {
    const gpu::DebugGroup group("cull quads");
    resources.bindTables();
    program_.use();
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, list_.id());
    const std::vector<const gpu::Buffer*> arenas = quads.buffers().buffers;
    for (std::size_t arena = 0; arena < arenas.size(); ++arena) {
        arenas[arena]->bindStorage(shared::kQuadsBinding);
        program_.set(shared::kArenaLocation, static_cast<GLuint>(arena));
        glDispatchComputeIndirect(0);
    }
    // The vertex shader reads the quads as texels; uploads and copies may follow.
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace terrane::render
