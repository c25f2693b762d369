// Input of a pass that draws quads: the quads that culling selected, and the data that shaders read of them.
// Used by the renderer on the context's thread.
#pragma once

#include "terrane/render/cull_pass.h"
#include "terrane/render/quad_resources.h"

namespace terrane::render {

// Features that the world's faces need in the shaders of quads; without them the shaders are shorter.
struct QuadFeatures {
    bool hasFaceSampling = false;  // see needsFaceSampling()
    bool hasTint = false;          // see TintTextures
    bool hasLand = false;          // land to the horizon affects light: see LandTextures
};

struct QuadDraw {
    QuadResources& resources;
    const QuadStore& quads;
    const MeshSectionTable& meshSections;
    const CullPass& culled;  // draws the selection of its last run
    bool isSmooth = false;   // textures are filtered

    void bind() const { resources.bind(meshSections, isSmooth); }
    // Draws with the shader and the bindings of bind().
    void draw(gpu::Pipeline& pipeline, const gpu::PipelineState& state, mesh::AlphaClass alphaClass) const {
        culled.drawBuckets(pipeline, state, quads, alphaClass);
    }
};

}  // namespace terrane::render
