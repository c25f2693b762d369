// Finds the visible faces of one section by the rules of each shape and passes them to a FaceWriter. Called
// by chunk_mesher.cpp for each section of a chunk, on the meshing worker's thread.
#pragma once

#include <array>

#include "terrane/mesh/face_writer.h"
#include "terrane/mesh/quad_collector.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/section.h"

namespace terrane::mesh {

// A section and its neighbors.
struct SectionView {
    const world::Section* center = nullptr;
    // By side. Null above the world, where there is air; below it, which is never seen; and beyond an open
    // border (MeshInput).
    std::array<const world::Section*, world::kFaceCount> neighbors{};
    const world::Section* blockState = nullptr;             // of the section's blocks
    std::array<const world::Section*, 4> neighborStates{};  // null where `neighbors` are
    const world::BlockRegistry* blocks = nullptr;
    FaceTarget target;
};

void addSectionFaces(const SectionView& view, QuadCollector& out);

}  // namespace terrane::mesh
