// What a pass that draws quads takes: those that culling chose, and what shaders read of them. Used by the
// renderer on the context's thread.
#pragma once

#include "terrane/render/cull_pass.h"
#include "terrane/render/quad_resources.h"

namespace terrane::render {

// What the faces of the world ask of the shaders of quads; without them these are shorter.
struct QuadFeatures {
    bool hasFaceSampling = false;  // see needsFaceSampling()
    bool hasTint = false;          // see TintTextures
    bool hasLand = false;          // light knows the land to the horizon: see LandTextures
};

struct QuadDraw {
    QuadResources& resources;
    const QuadStore& quads;
    const MeshSectionTable& meshSections;
    const CullPass& culled;  // draws what its last run chose
    bool isSmooth = false;   // textures are filtered

    void bind() const { resources.bind(meshSections, isSmooth); }
    // With a shader and what bind() binds.
    void draw(gpu::Pipeline& pipeline, const gpu::PipelineState& state, mesh::AlphaClass alphaClass) const {
        culled.drawBuckets(pipeline, state, quads, alphaClass);
    }
};

}  // namespace terrane::render
