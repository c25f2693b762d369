// The options of each shader that has variants, as types: a pass requests a variant, its defines are the
// shader's macros, and tests compile all of them. `samples` are those of a pixel. All are plain values; any
// thread may use them.
#pragma once

#include <vector>

#include "terrane/gpu/shader_loader.h"
#include "terrane/mesh/draw_bucket.h"
#include "terrane/render/frame/render_options.h"
#include "terrane/shared/variants.h"

namespace terrane::render {

// The features of the world's faces that shaders need; without them shaders are shorter. Like size and
// options, they select the frame.
struct QuadFeatures {
    bool hasFaceSampling = false;  // see needsFaceSampling()
    bool hasTint = false;          // see TintTextures
    bool hasLand = false;          // land to the horizon affects light: see LandTextures

    bool operator==(const QuadFeatures&) const = default;
};

enum class ShadowEdges : std::uint8_t {
    None = SHADOW_NONE,
    Hard = SHADOW_HARD,
    Soft = SHADOW_SOFT,
    Rays = SHADOW_RAYS
};
enum class LightDetail : std::uint8_t {
    Classic = LIGHT_CLASSIC,
    Smooth = LIGHT_SMOOTH,
    Simple = LIGHT_SIMPLE
};
enum class QuadPass : std::uint8_t {
    Surfaces = PASS_SURFACES,
    Layers = PASS_LAYERS,
    Shadows = PASS_SHADOWS,
    Corners = PASS_CORNERS  // see Shading::Corners
};

// Returns whether a shader reads the land up to the horizon (land_map.h) with these options, if there is
// land.
bool readsLand(const RenderOptions& options);
bool castsShadows(const RenderOptions& options);
bool hasShadowMap(const RenderOptions& options);  // else shadows are found by rays, or there are none
// Return whether quads are drawn, and whether rays are cast, with these options.
bool readsQuads(const RenderOptions& options);
bool readsBlocks(const RenderOptions& options);

// Light of sun and moon in shading.
struct SunVariant {
    ShadowEdges shadows = ShadowEdges::None;
    bool usesLand = false;

    static SunVariant of(const RenderOptions& options, const QuadFeatures& features);
};

struct GBufferVariant {
    mesh::AlphaClass alphaClass = mesh::AlphaClass::Opaque;
    int samples = 1;  // in which holes are tested; 1: the center of the pixel
    bool isSmooth = false;
    bool hasFaceSampling = false, hasTint = false;

    gpu::ShaderDefines defines() const;
    static std::vector<GBufferVariant> all();
};

// corners.vert.glsl, corners.frag.glsl
struct CornersVariant {
    mesh::AlphaClass alphaClass = mesh::AlphaClass::Opaque;
    bool hasTint = false, isUnderWater = false;

    gpu::ShaderDefines defines() const;
    static std::vector<CornersVariant> all();
};

// corner_sky.vert.glsl, corner_sky.frag.glsl
struct CornerSkyVariant {
    bool isUnderWater = false;

    gpu::ShaderDefines defines() const;
    static std::vector<CornerSkyVariant> all();
};

struct ShadowVariant {
    mesh::AlphaClass alphaClass = mesh::AlphaClass::Opaque;
    bool hasFaceSampling = false;

    gpu::ShaderDefines defines() const;
    static std::vector<ShadowVariant> all();
};

// depth_peel.frag.glsl
struct PeelVariant {
    int samples = 1;
    bool isNext = false;  // a layer behind another
    bool hasFaceSampling = false, hasTint = false;

    gpu::ShaderDefines defines() const;
    static std::vector<PeelVariant> all();
};

enum class RayLayer : std::uint8_t {
    Surfaces = RAY_SURFACES,  // behind all blended faces
    First = RAY_FIRST_LAYER,
    Next = RAY_NEXT_LAYER
};
// rays/rays.frag.glsl
struct RayVariant {
    RayLayer layer = RayLayer::Surfaces;
    int samples = 1;
    bool isSmooth = false;
    bool hasFaceSampling = false, hasTint = false;

    gpu::ShaderDefines defines() const;
    static std::vector<RayVariant> all();
};

struct TransparencyVariant {
    int samples = 1, layers = 1;
    SunVariant sun;
    bool hasOcclusion = false, hasWaterDetail = false, isUnderWater = false;
    LightDetail light = LightDetail::Classic;
    bool drawsQuads = false;  // instead of the whole screen: with one sample
    bool isDirect = false;    // display colors: see isDirectImage()

    gpu::ShaderDefines defines() const;
    static std::vector<TransparencyVariant> all();
};

struct ShadeVariant {
    int samples = 1;
    bool isPerSample = false, hasOcclusion = false, isUnderWater = false;
    bool isOverSky = false, isDirect = false;
    bool isFar = false;  // pixels of far tiles
    LightDetail light = LightDetail::Classic;
    SunVariant sun;

    gpu::ShaderDefines defines() const;
    static std::vector<ShadeVariant> all();
};

struct SkyVariant {
    bool hasClouds = false, isNight = false, isDirect = false;

    gpu::ShaderDefines defines() const;
    static std::vector<SkyVariant> all();
};

// clouds.frag.glsl
struct CloudVariant {
    int samples = 1;

    gpu::ShaderDefines defines() const;
    static std::vector<CloudVariant> all();
};

enum class MaskOf : std::uint8_t { Surfaces = MASK_SURFACES, Sky = MASK_SKY, Layers = MASK_LAYERS };
struct MaskVariant {
    int samples = 4;
    MaskOf of = MaskOf::Surfaces;

    gpu::ShaderDefines defines() const;
    static std::vector<MaskVariant> all();
};

struct OcclusionVariant {
    int samples = 1;
    bool isNearestLayer = false;

    gpu::ShaderDefines defines() const;
    static std::vector<OcclusionVariant> all();
};

enum class Axis : std::uint8_t { X = AXIS_X, Y = AXIS_Y };
// occlusion_blur.frag.glsl
struct OcclusionBlurVariant {
    OcclusionVariant occlusion;
    Axis axis = Axis::X;

    gpu::ShaderDefines defines() const;
    static std::vector<OcclusionBlurVariant> all();
};

struct DepthOfFieldVariant {
    int samples = 1;
    Axis axis = Axis::X;

    gpu::ShaderDefines defines() const;
    static std::vector<DepthOfFieldVariant> all();
};

struct FinalVariant {
    int samples = 1;
    bool hasDepthOfField = false, hasGodRays = false, hasBloom = false, showsOcclusion = false;

    gpu::ShaderDefines defines() const;
    static std::vector<FinalVariant> all();
};

enum class Resizing : std::uint8_t {
    Linear = RESIZE_LINEAR,
    Nearest = RESIZE_NEAREST,
    Edges = RESIZE_EDGES,
    Sharpen = RESIZE_SHARPEN
};
struct ResizeVariant {
    Resizing resizing = Resizing::Linear;

    gpu::ShaderDefines defines() const;
    static std::vector<ResizeVariant> all();
};

struct DebugViewVariant {
    int samples = 1;
    LightDetail light = LightDetail::Classic;

    gpu::ShaderDefines defines() const;
    static std::vector<DebugViewVariant> all();
};

struct HoleFillVariant {
    int samples = 1;

    gpu::ShaderDefines defines() const;
    static std::vector<HoleFillVariant> all();
};

struct HiZVariant {
    int samples = 1;
    bool isFinest = true;

    gpu::ShaderDefines defines() const;
    static std::vector<HiZVariant> all();
};

struct FigureVariant {
    QuadPass pass = QuadPass::Surfaces;
    bool isUnderWater = false;  // at corners

    gpu::ShaderDefines defines() const;
    static std::vector<FigureVariant> all();
};

// Returns the defines of all variants of a shader, by its path without "terrane/render/" and ".glsl":
// "effects/hole_fill.frag". A shader without variants has one empty variant.
std::vector<gpu::ShaderDefines> allVariants(std::string_view shader);

}  // namespace terrane::render
