// The passes of a frame that have shaders. They are made together, so that all can be rebuilt when shader
// files change. Used by the renderer on the context's thread.
#pragma once

#include "terrane/render/cull/cull_pass.h"
#include "terrane/render/cull/hi_z.h"
#include "terrane/render/effects/ambient_occlusion.h"
#include "terrane/render/effects/depth_of_field.h"
#include "terrane/render/effects/god_rays.h"
#include "terrane/render/effects/hole_fill.h"
#include "terrane/render/figures/figure_pass.h"
#include "terrane/render/frame/fullscreen_pass.h"
#include "terrane/render/frame/render_options.h"
#include "terrane/render/quads/gbuffer_pass.h"
#include "terrane/render/shading/shading_pass.h"
#include "terrane/render/shading/transparency_pass.h"
#include "terrane/render/shadow/shadow_map.h"

namespace terrane::render {

// Whether a shader reads the land up to the horizon (land_map.h) with these options, if there is land.
bool readsLand(const RenderOptions& options);

struct FramePasses {
    // The loader outlives the passes.
    static base::Result<FramePasses> create(const gpu::ShaderLoader& shaders, const gpu::DeviceInfo& device);

    // Selects the variants of the shaders and makes the passes' own targets. After a failure some passes are
    // unchanged; configuring with the old values restores all and compiles nothing.
    base::Result<void> configure(const FrameTargets& targets, const RenderOptions& options,
                                 const QuadFeatures& features = {});

    // Size of the passes' own targets.
    std::size_t targetBytes() const;

    CullPass cull;
    HiZ hiZ;
    ShadowMap shadowMap;
    GBufferPass gbuffer;
    HoleFill holeFill;
    FigurePass figures;
    TransparencyPass transparency;
    AmbientOcclusion occlusion;
    GodRays godRays;
    DepthOfField depthOfField;
    ShadingPass shading;
    FullscreenPass debugView, finalPass;
};

}  // namespace terrane::render
