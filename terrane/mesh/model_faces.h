// Faces of blocks whose shape is a model, one quad a face. section_faces.cpp uses it on the meshing worker's
// thread.
#pragma once

#include <array>

#include "terrane/mesh/bit_cube.h"
#include "terrane/mesh/quad_collector.h"
#include "terrane/mesh/section_faces.h"
#include "terrane/world/blocks/block_model.h"

namespace terrane::mesh {

// The blocks of one type in a section.
struct ModelBlocks {
    const SectionView& view;
    const world::BlockType& type;
    const BitCube& alongX;
    LayerRange layers;
};

// Returns whether the bit of a block is set, given by its index in the section, in a cube that has rows along
// y for -x and +x.
bool hasBit(const BitCube& cube, world::Face side, std::size_t block);
void addCellFace(const ModelBlocks& blocks, std::size_t block, const world::ModelFace& face,
                 QuadCollector& out);

// Adds the faces of models. `uncovered`: blocks whose neighbor on a side is not an opaque cube, with rows
// along y for -x and +x.
void addModelFaces(const ModelBlocks& blocks, const std::array<BitCube, world::kFaceCount>& uncovered,
                   QuadCollector& out);

// Returns whether a liquid flows in the section or its neighbors. terrane/mesh_gpu/liquids.glsl has the same
// rules for flowing liquids.
bool hasFlow(const SectionView& view);

BitCube flowingBlocks(const ModelBlocks& liquid);

// Adds all faces of flowing blocks, and those of still blocks toward flowing ones. `stillSurface`: the still
// blocks whose top is visible, in rows along x. `uncovered` as in model_faces.h.
void addFlowFaces(const ModelBlocks& liquid, const BitCube& stillSurface,
                  const std::array<BitCube, world::kFaceCount>& uncovered, QuadCollector& out);

}  // namespace terrane::mesh
