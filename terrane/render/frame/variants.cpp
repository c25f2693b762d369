#include "terrane/render/frame/variants.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <utility>

namespace terrane::render {
namespace {

using Macro = std::pair<const char*, int>;

gpu::ShaderDefines defined(std::initializer_list<Macro> values) {
    gpu::ShaderDefines defines;
    for (const auto& [name, value] : values) defines.emplace_back(name, std::to_string(value));
    return defines;
}

template <class Enum>
int number(Enum value) {
    return static_cast<int>(value);
}

// Each variant with each of the values.
template <class Variant, class Value, class Set>
std::vector<Variant> with(const std::vector<Variant>& variants, std::initializer_list<Value> values,
                          Set set) {
    std::vector<Variant> all;
    for (const Variant& variant : variants) {
        for (const Value& value : values) {
            all.push_back(variant);
            set(all.back(), value);
        }
    }
    return all;
}
template <class Variant>
std::vector<Variant> with(const std::vector<Variant>& variants, bool Variant::*member) {
    return with(variants, {false, true}, [=](Variant& v, bool value) { v.*member = value; });
}
template <class Variant, class Value>
std::vector<Variant> with(const std::vector<Variant>& variants, Value Variant::*member,
                          std::initializer_list<Value> values) {
    return with(variants, values, [=](Variant& v, Value value) { v.*member = value; });
}
// One sample a pixel, or several.
template <class Variant>
std::vector<Variant> withSamples() {
    return with(std::vector<Variant>{{}}, &Variant::samples, {1, 4});
}

template <class Variant>
std::vector<Variant> withSun(const std::vector<Variant>& variants) {
    constexpr SunVariant kSuns[] = {{},
                                    {ShadowEdges::Hard, false},
                                    {ShadowEdges::Hard, true},
                                    {ShadowEdges::Soft, false},
                                    {ShadowEdges::Soft, true},
                                    {ShadowEdges::Rays, false}};
    std::vector<Variant> all;
    for (const SunVariant& sun : kSuns) {
        for (Variant variant : variants) {
            variant.sun = sun;
            all.push_back(variant);
        }
    }
    return all;
}

template <class Variant, class Rule>
std::vector<Variant> only(std::vector<Variant> variants, Rule isSelectable) {
    std::erase_if(variants, [&](const Variant& v) { return !isSelectable(v); });
    return variants;
}

}  // namespace

bool castsShadows(const RenderOptions& options) {
    return options.shadows != ShadowReach::Off && options.shading != Shading::Off &&
           options.shading != Shading::Corners;
}

bool hasShadowMap(const RenderOptions& options) {
    return castsShadows(options) && options.shadows != ShadowReach::Rays;
}

bool readsQuads(const RenderOptions& options) {
    return options.surfaces == SurfaceMethod::Quads || hasShadowMap(options);
}

bool readsBlocks(const RenderOptions& options) {
    return options.surfaces == SurfaceMethod::Rays ||
           (castsShadows(options) && options.shadows == ShadowReach::Rays);
}

bool readsLand(const RenderOptions& options) {
    return castsShadows(options) && options.shadows == ShadowReach::Horizon;
}

SunVariant SunVariant::of(const RenderOptions& options, const QuadFeatures& features) {
    if (!castsShadows(options)) return {};
    if (options.shadows == ShadowReach::Rays) return {ShadowEdges::Rays, false};
    return {options.softShadows ? ShadowEdges::Soft : ShadowEdges::Hard,
            features.hasLand && readsLand(options)};
}

gpu::ShaderDefines GBufferVariant::defines() const {
    return defined({{"PASS", number(QuadPass::Surfaces)},
                    {"ALPHA_CLASS", number(alphaClass)},
                    {"MSAA_SAMPLES", samples},
                    {"SMOOTH", isSmooth},
                    {"FACE_SAMPLING", hasFaceSampling},
                    {"TINT", hasTint}});
}

std::vector<GBufferVariant> GBufferVariant::all() {
    auto variants = with(withSamples<GBufferVariant>(), &GBufferVariant::alphaClass,
                         {mesh::AlphaClass::Opaque, mesh::AlphaClass::Tested});
    variants = only(variants, [](const GBufferVariant& v) {
        return v.alphaClass == mesh::AlphaClass::Tested || v.samples == 1;
    });
    variants = with(variants, &GBufferVariant::isSmooth);
    return with(with(variants, &GBufferVariant::hasFaceSampling), &GBufferVariant::hasTint);
}

namespace {

// Of corner_shade.glsl.
gpu::ShaderDefines withCornerShading(gpu::ShaderDefines defines, bool isUnderWater) {
    const gpu::ShaderDefines shading = defined(
        {{"LIGHT", number(LightDetail::Classic)}, {"LAND", 0}, {"FAR", 0}, {"UNDER_WATER", isUnderWater}});
    defines.insert(defines.end(), shading.begin(), shading.end());
    return defines;
}

}  // namespace

gpu::ShaderDefines CornersVariant::defines() const {
    return withCornerShading(defined({{"PASS", number(QuadPass::Corners)},
                                      {"ALPHA_CLASS", number(alphaClass)},
                                      {"FACE_SAMPLING", 0},
                                      {"TINT", hasTint}}),
                             isUnderWater);
}

std::vector<CornersVariant> CornersVariant::all() {
    const auto variants =
        with(std::vector<CornersVariant>{{}}, &CornersVariant::alphaClass,
             {mesh::AlphaClass::Opaque, mesh::AlphaClass::Tested, mesh::AlphaClass::Blended});
    return with(with(variants, &CornersVariant::hasTint), &CornersVariant::isUnderWater);
}

gpu::ShaderDefines CornerSkyVariant::defines() const {
    return defined({{"UNDER_WATER", isUnderWater}});
}

std::vector<CornerSkyVariant> CornerSkyVariant::all() {
    return with(std::vector<CornerSkyVariant>{{}}, &CornerSkyVariant::isUnderWater);
}

gpu::ShaderDefines ShadowVariant::defines() const {
    return defined({{"PASS", number(QuadPass::Shadows)},
                    {"ALPHA_CLASS", number(alphaClass)},
                    {"FACE_SAMPLING", hasFaceSampling},
                    {"TINT", 0}});
}

std::vector<ShadowVariant> ShadowVariant::all() {
    return {{mesh::AlphaClass::Opaque, false},
            {mesh::AlphaClass::Tested, false},
            {mesh::AlphaClass::Tested, true}};
}

gpu::ShaderDefines PeelVariant::defines() const {
    return defined({{"PASS", number(QuadPass::Layers)},
                    {"ALPHA_CLASS", number(mesh::AlphaClass::Blended)},
                    {"MSAA_SAMPLES", samples},
                    {"NEXT", isNext},
                    {"FACE_SAMPLING", hasFaceSampling},
                    {"TINT", hasTint}});
}

std::vector<PeelVariant> PeelVariant::all() {
    auto variants = with(withSamples<PeelVariant>(), &PeelVariant::isNext);
    return with(with(variants, &PeelVariant::hasFaceSampling), &PeelVariant::hasTint);
}

gpu::ShaderDefines TransparencyVariant::defines() const {
    return defined({{"PASS", number(QuadPass::Layers)},
                    {"ALPHA_CLASS", number(mesh::AlphaClass::Blended)},
                    {"MSAA_SAMPLES", samples},
                    {"LAYERS", layers},
                    {"SHADOW", number(sun.shadows)},
                    {"LAND", sun.usesLand},
                    {"OCCLUSION", hasOcclusion},
                    {"LIGHT", number(light)},
                    {"QUADS", drawsQuads},
                    {"DIRECT", isDirect},
                    {"OVER_SKY", !isDirect},
                    {"SMOOTH", 0},
                    {"FACE_SAMPLING", 0},
                    {"TINT", 0},
                    {"WATER_DETAIL", hasWaterDetail},
                    {"UNDER_WATER", isUnderWater},
                    {"FAR", 0}});
}

// With several samples a pixel, layers are shaded over the whole screen. Display colors exclude what
// isDirectImage() does.
std::vector<TransparencyVariant> TransparencyVariant::all() {
    auto variants =
        withSun(with(withSamples<TransparencyVariant>(), &TransparencyVariant::layers, {1, 2, 3}));
    variants = with(variants, &TransparencyVariant::light, {LightDetail::Classic, LightDetail::Smooth});
    for (const auto member : {&TransparencyVariant::hasOcclusion, &TransparencyVariant::hasWaterDetail,
                              &TransparencyVariant::isUnderWater, &TransparencyVariant::drawsQuads,
                              &TransparencyVariant::isDirect})
        variants = with(variants, member);
    return only(variants, [](const TransparencyVariant& v) {
        if (v.samples > 1) return !v.drawsQuads && !v.isDirect;
        return !v.isDirect || (v.drawsQuads && !v.hasOcclusion && !v.hasWaterDetail);
    });
}

gpu::ShaderDefines RayVariant::defines() const {
    return defined({{"PASS", PASS_RAYS},
                    {"RAY_LAYER", number(layer)},
                    {"MSAA_SAMPLES", samples},
                    {"SMOOTH", isSmooth},
                    {"FACE_SAMPLING", hasFaceSampling},
                    {"TINT", hasTint}});
}

std::vector<RayVariant> RayVariant::all() {
    auto variants = with(withSamples<RayVariant>(), &RayVariant::layer,
                         {RayLayer::Surfaces, RayLayer::First, RayLayer::Next});
    variants = only(with(variants, &RayVariant::isSmooth),
                    [](const RayVariant& v) { return v.isSmooth || v.layer == RayLayer::Surfaces; });
    return with(with(variants, &RayVariant::hasFaceSampling), &RayVariant::hasTint);
}

gpu::ShaderDefines ShadeVariant::defines() const {
    return defined({{"MSAA_SAMPLES", samples},
                    {"PER_SAMPLE", isPerSample},
                    {"LIGHT", number(light)},
                    {"SHADOW", number(sun.shadows)},
                    {"LAND", sun.usesLand},
                    {"OCCLUSION", hasOcclusion},
                    {"OVER_SKY", isOverSky},
                    {"DIRECT", isDirect},
                    {"UNDER_WATER", isUnderWater},
                    {"FAR", isFar},
                    {"PASS", PASS_RAYS},
                    {"SMOOTH", 0},
                    {"FACE_SAMPLING", 0}});
}

// With several samples a pixel, surfaces are shaded over the sky, and in air distant pixels have shaders of
// their own, which read less light or none.
std::vector<ShadeVariant> ShadeVariant::all() {
    auto variants = withSun(with(withSamples<ShadeVariant>(), &ShadeVariant::light,
                                 {LightDetail::Classic, LightDetail::Smooth, LightDetail::Simple}));
    for (const auto member :
         {&ShadeVariant::isPerSample, &ShadeVariant::hasOcclusion, &ShadeVariant::isUnderWater,
          &ShadeVariant::isOverSky, &ShadeVariant::isDirect, &ShadeVariant::isFar})
        variants = with(variants, member);
    return only(variants, [](const ShadeVariant& v) {
        if (v.samples == 1)
            return v.light != LightDetail::Simple && !v.isFar &&
                   !(v.isDirect && (v.isOverSky || v.hasOcclusion));
        if (!v.isOverSky || v.isDirect) return false;
        if (v.isFar) return v.light == LightDetail::Classic && !v.isUnderWater;
        return v.light != LightDetail::Simple || !v.isUnderWater;
    });
}

gpu::ShaderDefines SkyVariant::defines() const {
    return defined({{"CLOUDS", hasClouds}, {"NIGHT", isNight}, {"DIRECT", isDirect}});
}

std::vector<SkyVariant> SkyVariant::all() {
    const auto variants =
        with(with(with(std::vector<SkyVariant>{{}}, &SkyVariant::hasClouds), &SkyVariant::isNight),
             &SkyVariant::isDirect);
    return only(variants, [](const SkyVariant& v) { return !(v.hasClouds && v.isDirect); });
}

gpu::ShaderDefines CloudVariant::defines() const {
    return defined({{"MSAA_SAMPLES", samples}});
}

std::vector<CloudVariant> CloudVariant::all() {
    return withSamples<CloudVariant>();
}

gpu::ShaderDefines MaskVariant::defines() const {
    return defined({{"MSAA_SAMPLES", samples}, {"MASK", number(of)}});
}

std::vector<MaskVariant> MaskVariant::all() {
    return {{4, MaskOf::Surfaces}, {4, MaskOf::Sky}, {4, MaskOf::Layers}};
}

gpu::ShaderDefines OcclusionVariant::defines() const {
    return defined({{"MSAA_SAMPLES", samples}, {"NEAREST_LAYER", isNearestLayer}});
}

std::vector<OcclusionVariant> OcclusionVariant::all() {
    return with(withSamples<OcclusionVariant>(), &OcclusionVariant::isNearestLayer);
}

gpu::ShaderDefines OcclusionBlurVariant::defines() const {
    return defined({{"AXIS", number(axis)},
                    {"MSAA_SAMPLES", occlusion.samples},
                    {"NEAREST_LAYER", occlusion.isNearestLayer}});
}

std::vector<OcclusionBlurVariant> OcclusionBlurVariant::all() {
    std::vector<OcclusionBlurVariant> variants;
    for (const OcclusionVariant& occlusion : OcclusionVariant::all())
        for (const Axis axis : {Axis::X, Axis::Y}) variants.push_back({occlusion, axis});
    return variants;
}

gpu::ShaderDefines DepthOfFieldVariant::defines() const {
    return defined({{"AXIS", number(axis)}, {"MSAA_SAMPLES", samples}});
}

std::vector<DepthOfFieldVariant> DepthOfFieldVariant::all() {
    return {{1, Axis::X}, {4, Axis::X}, {1, Axis::Y}};
}

gpu::ShaderDefines FinalVariant::defines() const {
    return defined({{"MSAA_SAMPLES", samples},
                    {"DEPTH_OF_FIELD", hasDepthOfField},
                    {"GOD_RAYS", hasGodRays},
                    {"BLOOM", hasBloom},
                    {"RAW_OCCLUSION", showsOcclusion}});
}

std::vector<FinalVariant> FinalVariant::all() {
    auto variants = with(withSamples<FinalVariant>(), &FinalVariant::hasDepthOfField);
    variants = with(with(variants, &FinalVariant::hasGodRays), &FinalVariant::hasBloom);
    return with(variants, &FinalVariant::showsOcclusion);
}

gpu::ShaderDefines ResizeVariant::defines() const {
    return defined({{"RESIZING", number(resizing)}});
}

std::vector<ResizeVariant> ResizeVariant::all() {
    return {{Resizing::Linear}, {Resizing::Nearest}, {Resizing::Edges}, {Resizing::Sharpen}};
}

gpu::ShaderDefines DebugViewVariant::defines() const {
    return defined({{"MSAA_SAMPLES", samples}, {"LIGHT", number(light)}});
}

std::vector<DebugViewVariant> DebugViewVariant::all() {
    return with(withSamples<DebugViewVariant>(), &DebugViewVariant::light,
                {LightDetail::Classic, LightDetail::Smooth});
}

gpu::ShaderDefines HoleFillVariant::defines() const {
    return defined({{"MSAA_SAMPLES", samples}});
}

std::vector<HoleFillVariant> HoleFillVariant::all() {
    return withSamples<HoleFillVariant>();
}

gpu::ShaderDefines HiZVariant::defines() const {
    return defined({{"LEVEL_0", isFinest}, {"MSAA_SAMPLES", samples}});
}

std::vector<HiZVariant> HiZVariant::all() {
    return {{1, true}, {4, true}, {1, false}};
}

gpu::ShaderDefines FigureVariant::defines() const {
    return withCornerShading(defined({{"PASS", number(pass)}}), isUnderWater);
}

std::vector<FigureVariant> FigureVariant::all() {
    return {{QuadPass::Surfaces}, {QuadPass::Shadows}, {QuadPass::Corners}, {QuadPass::Corners, true}};
}

namespace {

template <class Variant>
std::vector<gpu::ShaderDefines> definesOf(const std::vector<Variant>& variants) {
    std::vector<gpu::ShaderDefines> defines;
    for (const Variant& variant : variants) defines.push_back(variant.defines());
    return defines;
}

// What quad.vert.glsl knows of the passes that it serves.
std::vector<gpu::ShaderDefines> quadVariants() {
    std::vector<gpu::ShaderDefines> all;
    const auto add = [&](std::vector<gpu::ShaderDefines> variants) {
        for (gpu::ShaderDefines& defines : variants) {
            std::erase_if(defines, [](const auto& macro) {
                constexpr std::array kKnown = {"PASS", "ALPHA_CLASS", "FACE_SAMPLING", "TINT"};
                return std::ranges::find(kKnown, macro.first) == kKnown.end();
            });
            if (std::ranges::find(all, defines) == all.end()) all.push_back(std::move(defines));
        }
    };
    add(definesOf(GBufferVariant::all()));
    add(definesOf(ShadowVariant::all()));
    add(definesOf(PeelVariant::all()));
    add(definesOf(TransparencyVariant::all()));
    return all;
}

}  // namespace

std::vector<gpu::ShaderDefines> allVariants(std::string_view shader) {
    struct Row {
        std::string_view shader;
        std::vector<gpu::ShaderDefines> (*variants)();
    };
    static constexpr Row kRows[] = {
        {"quads/quad.vert", quadVariants},
        {"quads/gbuffer.frag", [] { return definesOf(GBufferVariant::all()); }},
        {"shadow/shadow.frag", [] { return definesOf(ShadowVariant::all()); }},
        {"shading/depth_peel.frag", [] { return definesOf(PeelVariant::all()); }},
        {"rays/rays.frag", [] { return definesOf(RayVariant::all()); }},
        {"shading/transparency.frag", [] { return definesOf(TransparencyVariant::all()); }},
        {"shading/shade.frag", [] { return definesOf(ShadeVariant::all()); }},
        {"shading/pixel_mask.frag", [] { return definesOf(MaskVariant::all()); }},
        {"sky/sky.frag", [] { return definesOf(SkyVariant::all()); }},
        {"sky/clouds.frag", [] { return definesOf(CloudVariant::all()); }},
        {"effects/ambient_occlusion.frag", [] { return definesOf(OcclusionVariant::all()); }},
        {"effects/occlusion_blur.frag", [] { return definesOf(OcclusionBlurVariant::all()); }},
        {"effects/depth_of_field.frag", [] { return definesOf(DepthOfFieldVariant::all()); }},
        {"effects/hole_fill.frag", [] { return definesOf(HoleFillVariant::all()); }},
        {"frame/final.frag", [] { return definesOf(FinalVariant::all()); }},
        {"effects/resize.frag", [] { return definesOf(ResizeVariant::all()); }},
        {"frame/debug_view.frag", [] { return definesOf(DebugViewVariant::all()); }},
        {"cull/hi_z.comp", [] { return definesOf(HiZVariant::all()); }},
        {"figures/figure.vert", [] { return definesOf(FigureVariant::all()); }},
        {"figures/figure.frag",
         [] {
             return definesOf(only(FigureVariant::all(),
                                   [](const FigureVariant& v) { return v.pass != QuadPass::Shadows; }));
         }},
        {"figures/figure_shadow.frag",
         [] { return definesOf(std::vector<FigureVariant>{{QuadPass::Shadows}}); }},
        {"corners/corners.vert", [] { return definesOf(CornersVariant::all()); }},
        {"corners/corners.frag", [] { return definesOf(CornersVariant::all()); }},
        {"corners/corner_sky.frag", [] { return definesOf(CornerSkyVariant::all()); }},
        {"corners/corner_sky.vert", [] { return definesOf(CornerSkyVariant::all()); }},
    };
    const auto found = std::ranges::find(kRows, shader, &Row::shader);
    return found == std::end(kRows) ? std::vector<gpu::ShaderDefines>{{}} : found->variants();
}

}  // namespace terrane::render
