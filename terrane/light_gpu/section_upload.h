// Blocks as the shaders read them: sections in their packed form, palettes of opacity and emission. Pure
// bookkeeping without OpenGL.
#pragma once

#include <vector>

#include "terrane/light/light_table.h"
#include "terrane/shared/light_solver.h"
#include "terrane/world/chunk.h"

namespace terrane::light_gpu {

struct SectionUpload {
    std::vector<shared::SectionInput> sections;  // sixteen a chunk
    std::vector<shared::uint> data;              // about 9 KB an overworld chunk

    void clear();
    void add(const world::Chunk& chunk, const light::LightTable& table);
};

}  // namespace terrane::light_gpu
