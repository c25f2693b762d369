// Faces of liquids that flow, one quad a face. Used by section_faces.cpp on the meshing worker's thread;
// terrane/mesh_gpu/quads.glsl has the same rules.
#pragma once

#include "terrane/mesh/model_faces.h"

namespace terrane::mesh {

// Whether a liquid flows in the section or beside it.
bool hasFlow(const SectionView& view);

// The blocks of a liquid that flow.
BitCube flowingBlocks(const ModelBlocks& liquid);

// All faces of blocks that flow, and those of still blocks toward blocks that flow. `stillSurface`: the
// still blocks whose top is seen, in rows along x. `uncovered` as in model_faces.h.
void addFlowFaces(const ModelBlocks& liquid, const BitCube& stillSurface,
                  const std::array<BitCube, world::kFaceCount>& uncovered, QuadCollector& out);

}  // namespace terrane::mesh
