#include "terrane/render/quads/draw_commands.h"

#include <algorithm>
#include <cassert>

namespace terrane::render {
namespace {

// Drivers of AMD were reported to have a wrong gl_VertexID from 2^23 on, as if it went through a float
// (Sodium, pull request 1072). Base instances stay below too.
constexpr std::uint32_t kExactNumbers = 1u << 23;
static_assert(4 * shared::kMaxQuadsPerCommand <= kExactNumbers, "vertex ids begin at 0 in each command");
static_assert(shared::kMaxDrawCommands <= kExactNumbers);

void drawIndirect(const CommandList& list) {
    assert((std::size_t{list.first} + list.count) * sizeof(shared::DrawCommand) <=
               list.commands->sizeBytes() &&
           "the commands lie in the buffer");
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, list.commands->id());
    const auto offset = reinterpret_cast<const void*>(std::size_t{list.first} * sizeof(shared::DrawCommand));
    const auto count = static_cast<GLsizei>(list.count);
    if (!list.counts) {
        glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, offset, count, 0);
        return;
    }
    assert(list.countOffsetBytes + sizeof(GLuint) <= list.counts->sizeBytes() &&
           "the count lies in its buffer");
    glBindBuffer(GL_PARAMETER_BUFFER_ARB, list.counts->id());
    glMultiDrawElementsIndirectCountARB(GL_TRIANGLES, GL_UNSIGNED_SHORT, offset,
                                        static_cast<GLintptr>(list.countOffsetBytes), count, 0);
    // Mesa 22.3 limits draws without a count, too, by the buffer that is bound here.
    glBindBuffer(GL_PARAMETER_BUFFER_ARB, 0);
}

// A member that OpenGL would ignore or refuse is wrong data: the GPU wrote some of these commands.
void drawOne(const shared::DrawCommand& command) {
    assert(command.indexCount <= 6 * shared::kMaxQuadsPerCommand && command.firstIndex == 0 &&
           command.baseVertex == 0 && command.instanceCount <= 1 && "as compact.comp.glsl writes them");
    if (command.indexCount == 0 || command.instanceCount == 0) return;
    glDrawElementsInstancedBaseInstance(GL_TRIANGLES, static_cast<GLsizei>(command.indexCount),
                                        GL_UNSIGNED_SHORT, nullptr, 1, command.baseInstance);
}

}  // namespace

DrawLimits DrawLimits::ofDriver() const {
    const std::size_t bytes = gpu::maxBufferBytes();
    GLint groups = 0;
    glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0, &groups);
    const auto within = [](std::uint32_t limit, std::size_t reachable) {
        return static_cast<std::uint32_t>(std::min<std::size_t>(limit, reachable));
    };
    const std::size_t listWords = std::min(bytes / sizeof(shared::uint), gpu::BufferTexture::maxElements());
    return {within(meshSections, bytes / sizeof(shared::MeshSectionRecord)),
            within(commands,
                   std::min<std::size_t>(bytes / sizeof(shared::DrawCommand), shared::kMaxDrawCommands)),
            within(listedQuads, std::min<std::size_t>(listWords - 1, shared::kMaxListedQuads)),
            within(testGroups, std::min<std::size_t>(static_cast<std::size_t>(std::max(groups, 1)),
                                                     shared::kMaxTestGroups))};
}

void drawCommands(DrawMethod method, const CommandList& list) {
    if (method == DrawMethod::Indirect) {
        drawIndirect(list);
    } else {
        for (const shared::DrawCommand& command : list.onCpu) drawOne(command);
    }
}

}  // namespace terrane::render
