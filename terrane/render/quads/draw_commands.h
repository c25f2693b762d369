// Draws lists of commands over the quads' indices, for all passes: by multi-draw indirect, or by a call for
// each command, which makes the same image. Also the limits within which lists stay. The renderer uses it on
// the context's thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "terrane/gpu/buffer.h"
#include "terrane/render/frame/render_options.h"
#include "terrane/shared/mesh_section.h"

namespace terrane::render {

// Most that lists of draws may hold. Tests set smaller ones.
struct DrawLimits {
    std::uint32_t meshSections = UINT32_MAX;  // that have quads
    std::uint32_t commands = UINT32_MAX;      // of all lists together
    std::uint32_t listedQuads = UINT32_MAX;   // see quad_list.h
    std::uint32_t testGroups = UINT32_MAX;    // work groups of quad_cull.comp.glsl

    // Returns the same within what the current context can reach.
    DrawLimits ofDriver() const;
};

// Commands that follow each other in a buffer, each with its shared::DrawRecord in the bound vertex array.
struct CommandList {
    const gpu::Buffer* commands = nullptr;  // of DrawMethod::Indirect
    std::uint32_t first = 0, count = 0;     // the most, if the GPU counts them
    const gpu::Buffer* counts = nullptr;    // null: `count` is exact, or the last commands draw nothing
    std::size_t countOffsetBytes = 0;
    std::span<const shared::DrawCommand> onCpu = {};  // of DrawMethod::Loop
};

// Draws with the bound program and the bound vertex array, whose indices are 16 bits.
void drawCommands(DrawMethod method, const CommandList& list);

}  // namespace terrane::render
