// Chunks as the shaders that solve light read them: sections in their packed form, with the opacity and
// emission of blocks in place of their ids. Pure bookkeeping without OpenGL.
#pragma once

#include "terrane/light/light_table.h"
#include "terrane/world/chunk.h"
#include "terrane/world/packed_sections.h"

namespace terrane::light_gpu {

// Appends the sixteen sections of a chunk, the lowest first.
void appendChunk(world::PackedSections& packed, const world::Chunk& chunk, const light::LightTable& table);

}  // namespace terrane::light_gpu
