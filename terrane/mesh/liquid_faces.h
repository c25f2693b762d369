// Faces of flowing liquids, one quad a face. Used by section_faces.cpp on the meshing worker's thread;
// terrane/mesh_gpu/liquids.glsl has the same rules.
#pragma once

#include "terrane/mesh/model_faces.h"

namespace terrane::mesh {

// Whether a liquid flows in the section or its neighbors.
bool hasFlow(const SectionView& view);

BitCube flowingBlocks(const ModelBlocks& liquid);

// Adds all faces of flowing blocks, and those of still blocks toward flowing ones. `stillSurface`: the still
// blocks whose top is visible, in rows along x. `uncovered` as in model_faces.h.
void addFlowFaces(const ModelBlocks& liquid, const BitCube& stillSurface,
                  const std::array<BitCube, world::kFaceCount>& uncovered, QuadCollector& out);

}  // namespace terrane::mesh
