// A frame as data: its targets, and the passes in their order. buildFrame() makes it as a whole for options
// and a size, or fails and leaves everything as it was. It is used on the thread of the OpenGL context.
//
// A pass is a function in a file of its own. It reads the options, requests programs and targets from the
// builder, and returns the targets that it reads and writes and a function that records it, or nothing if it
// is off. frame.cpp lists the passes in the order of a frame; timer zones, memory and the list in
// docs/rendering.md follow.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "terrane/gpu/framebuffer.h"
#include "terrane/gpu/mapped_ring.h"
#include "terrane/gpu/pipeline_state.h"
#include "terrane/gpu/texture.h"
#include "terrane/gpu/timer.h"
#include "terrane/gpu/vertex_array.h"
#include "terrane/render/cull/cull_pass.h"
#include "terrane/render/cull/screen_rect.h"
#include "terrane/render/figures/figure_pass.h"
#include "terrane/render/frame/camera.h"
#include "terrane/render/frame/frame_uniforms.h"
#include "terrane/render/frame/programs.h"
#include "terrane/render/frame/target.h"
#include "terrane/render/frame/variants.h"
#include "terrane/render/quads/light_store.h"
#include "terrane/render/rays/ray_store.h"
#include "terrane/render/shadow/shadow_map.h"
#include "terrane/render/sky/sky_texture.h"

namespace terrane::render {

struct Frame;
struct LayerQueries;

// The context of a frame: the world on the GPU, and this frame's camera. There is one object for each frame;
// passes write its last members for later passes.
struct FrameContext {
    const Frame& frame;
    const FrameInput& input;
    ViewMatrices view;
    gpu::Pipeline& pipeline;
    gpu::MappedRing& ring;
    QuadStore& quads;
    QuadResources& resources;
    MeshSectionTable& meshSections;
    CullPass& cull;
    const FigurePass& figures;
    const RayStore& rays;
    const gpu::VertexArray& fullscreen;  // without attributes
    gpu::TextureSet worldTextures = {};  // that shaders of surfaces read: light, noise, sky, land, tint
    CullInput culling;
    bool hasShadows = false;
    int top = 0;        // of the world: its highest layer is below
    float cloudsZ = 0;  // of the clouds' plane

    const Target* nearestDepth = nullptr;       // of the nearest surfaces: the layers' where there are any
    std::vector<ScreenRect> blendedRects = {};  // pixels with blended faces; empty: there are none in view
    std::vector<shared::FigureRecord> figuresInView = {};

    bool isUnderWater() const { return input.waterAbove > 0; }
    // Returns whether surfaces are drawn shaded, without a G-buffer: see Shading::Corners.
    bool shadesAtCorners() const;
    // Returns whether culling omits occluded mesh sections: not while culling is shown from outside.
    bool cullsOccluded() const;
    gpu::TextureSet shadingTextures() const;  // of the world, and the shadow map
    QuadDraw quadDraw() const;
};

enum class DrawnIn : std::uint8_t { EveryView, Image, DebugViews };

struct Pass {
    std::string_view name = {};  // of its timer zone: from the list
    std::vector<TargetRef> reads = {}, writes = {};
    std::function<void(FrameContext&)> record = {};
    // Returns whether it has something to do in this frame; empty: always.
    std::function<bool(FrameContext&)> isNeeded = {};
    DrawnIn drawnIn = DrawnIn::Image;
};
using MaybePass = base::Result<std::optional<Pass>>;

struct FrameSpec {
    glm::ivec2 size{0};        // pixels that are drawn
    glm::ivec2 outputSize{0};  // pixels of the image that is shown: see RenderOptions::renderScale
    RenderOptions options;
    QuadFeatures features;
    // As the options say, for this driver: not Auto.
    DrawMethod draw = DrawMethod::Indirect;
    Upscaling upscaling = Upscaling::Linear;

    bool operator==(const FrameSpec&) const = default;
};

// The targets that several passes share.
struct SharedTargets {
    TargetRef surfaces, depth;  // the G-buffer (packed_gbuffer.glsl), and its reversed depth
    TargetRef scene;            // linear light, coverage in alpha
    TargetRef image;            // as the screen shows it
    TargetRef
        mask;  // selects pixels of full-screen passes, with several samples a pixel: see pixel_mask.frag.glsl
    TargetRef hiZ, occlusion, occlusionBetween, godRays, depthOfField, bloom;  // null: off
    std::vector<TargetRef> layers, layerDepths;                                // from the nearest
    std::shared_ptr<const LayerQueries> anyLayer;  // whether layers have faces: transparency_pass.cpp
};

struct Frame {
    FrameSpec spec;
    RenderOptions drawn;  // drawnOptions() of the spec's
    int samples = 1;      // a pixel, as the driver has them
    SharedTargets targets;
    // gbuffer: surfaces and depth. scene: with the depth of the one sample, or the mask. image: alone.
    // direct: with one sample a pixel, the image with the depth: see isDirectImage().
    // output: what is shown, the image or another size of it.
    std::shared_ptr<const gpu::Framebuffer> gbuffer, scene, image, direct, mask, output;
    std::shared_ptr<ShadowMap> shadowMap;  // null: off
    std::vector<Pass> passes;
    std::vector<TargetRef> allTargets;

    bool isBuilt() const { return spec.size.x > 0; }
    bool isDirect() const;
    gpu::TextureSet gbufferTextures() const;
    std::size_t targetBytes() const;  // of all targets and the shadow map
};

// Creates the parts of a frame. Targets and shadow maps of the frame before are reused if they are the same.
class FrameBuilder {
  public:
    FrameBuilder(const FrameSpec& spec, Programs& compiled, const Frame& before);

    Frame frame;  // in the making: passes look at its options and targets, and add to them
    Programs& programs;

    const RenderOptions& options() const { return frame.drawn; }
    const QuadFeatures& features() const { return frame.spec.features; }
    int samples() const { return frame.samples; }

    // Returns a target, reused from the frame before if it is the same. Its `samples` are 1, or those of a
    // pixel.
    TargetRef target(const TargetShape& shape);
    base::Result<std::shared_ptr<const gpu::Framebuffer>> framebuffer(std::string_view label,
                                                                      const std::vector<TargetRef>& colors,
                                                                      const TargetRef& depth = nullptr);
    // A target of one sample a pixel that is drawn into alone.
    struct Drawn {
        TargetRef target;
        std::shared_ptr<const gpu::Framebuffer> framebuffer;
    };
    base::Result<Drawn> drawnTarget(std::string_view label, GLenum format, glm::ivec2 size);
    base::Result<void> makeSharedTargets();
    base::Result<void> makeShadowMap();

  private:
    const Frame& before_;
};

// Fails if the driver refuses a target or a shader. `before` stays as it is.
base::Result<Frame> buildFrame(const FrameSpec& spec, Programs& programs, const Frame& before);

// Records the passes, each in a timer zone of its name.
void recordPasses(FrameContext& context, gpu::GpuTimer& timer);

// Returns the names of all passes, in the order of a frame.
std::vector<std::string_view> passNames();

// Returns the passes with the targets that they read and write, a line each: "shade: G-buffer, depth →
// scene".
std::string textOf(const Frame& frame);

// A depth behind all surfaces, a thousand kilometers away: only the sky's is 0.
constexpr float kBehindAll = kNearPlane / 1e6f;

// Draws over the bound framebuffer, at depth 0 (farthest): one triangle over all of it, or one for each of
// the rectangles.
void drawFullscreen(FrameContext& context, const gpu::Program& program, const gpu::PipelineState& state,
                    const gpu::TextureSet& textures, std::span<const ScreenRect> within = {});

}  // namespace terrane::render
