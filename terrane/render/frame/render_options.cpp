#include "terrane/render/frame/render_options.h"

#include <algorithm>
#include <cassert>

#include "terrane/base/result.h"

namespace terrane::render {

namespace {

// Few effects: for drawing without a graphics card.
constexpr RenderOptions low() {
    RenderOptions o;
    o.msaaSamples = 1;
    o.shadows = ShadowReach::Off;
    o.depthOfField = o.godRays = o.bloom = o.msaaAlphaTest = o.sharpFiltering = o.clouds = false;
    o.transparencyLayers = 1;
    o.water = Water::Plain;
    return o;
}

// Without a graphics card a frame takes 0.5 to 0.63 of that of low.
constexpr RenderOptions minimal() {
    RenderOptions o = low();
    o.shading = Shading::Corners;
    o.leafBacks = false;
    return o;
}

constexpr RenderOptions medium() {
    RenderOptions o;
    o.msaaSamples = 2;
    o.light = LightSampling::Smooth;
    o.shadows = ShadowReach::Horizon;
    o.depthOfField = false;
    o.transparencyLayers = 2;
    return o;
}

constexpr RenderOptions high() {
    RenderOptions o;
    o.msaaSamples = 4;
    o.light = LightSampling::Smooth;
    o.shadows = ShadowReach::Horizon;
    o.softShadows = true;
    o.occlusion = Occlusion::On;
    o.depthOfField = false;
    return o;
}

constexpr int kUltraDetail = 24;  // far columns are half as wide as by default

// For a strong graphics card.
constexpr RenderOptions ultra() {
    RenderOptions o = high();
    o.shadowSize = 4096;
    return o;
}

// Options of the thesis's measurements, in its terms: samples 2, shadows 2048, three layers, squares ext in
// mesh sections of 64 blocks, T-junctions hidden after the image, 65 x 65 chunks and nothing beyond.
constexpr Preset thesis() {
    Preset preset{.name = "thesis"};
    preset.options.water = Water::Plain;
    preset.options.adaptation = preset.options.bloom = false;
    preset.options.tJunctions = TJunctions::Filled;
    preset.mesh = {.method = mesh::MergeMethod::SquaresExt, .meshSectionHeight = 64};
    preset.viewDistance = 32;
    preset.horizon = 0;
    return preset;
}

}  // namespace

RenderOptions drawnOptions(RenderOptions options) {
    if (options.surfaces == SurfaceMethod::Rays) {
        options.occlusionCulling = false;
        options.tJunctions = TJunctions::Open;
    }
    if (options.shading != Shading::Corners) return options;
    options.msaaSamples = 1;
    options.light = LightSampling::Classic;
    options.shadows = ShadowReach::Off;
    options.occlusion = Occlusion::Off;
    options.depthOfField = options.godRays = options.bloom = options.clouds = options.sharpFiltering = false;
    options.water = Water::Plain;
    options.transparencyLayers = std::min(options.transparencyLayers, 1);
    options.singleTransparencyLayer = 0;
    if (options.tJunctions == TJunctions::Filled) options.tJunctions = TJunctions::Covered;
    return options;
}

const std::array<Preset, 6>& presets() {
    static constexpr std::array<Preset, 6> kPresets = {
        {{.name = "minimal",
          .label = "Minimal",
          .about = "For slow machines without a graphics card. Light is computed at corners only.",
          .options = minimal(),
          .relativeCost = 0.61},
         {.name = "low",
          .label = "Low",
          .about = "For machines without a graphics card. No distant shadows, one sample per pixel.",
          .options = low(),
          .relativeCost = 1.0},
         {.name = "medium",
          .label = "Medium",
          .about = "Anti-aliasing, clouds, sun rays.",
          .options = medium(),
          .relativeCost = 3.8},
         {.name = "high",
          .label = "High",
          .about = "Also ambient occlusion.",
          .options = high(),
          .relativeCost = 4.48},
         {.name = "ultra",
          .label = "Ultra",
          .about = "Finer shadows and distant land. Takes more memory.",
          .options = ultra(),
          .detail = kUltraDetail,
          .relativeCost = 4.54},
         thesis()}};
    return kPresets;
}

const Preset* findPreset(std::string_view name, bool isSoftwareRenderer) {
    if (name == "auto") name = isSoftwareRenderer ? "low" : "high";
    const auto found = std::ranges::find(presets(), name, &Preset::name);
    return found == presets().end() ? nullptr : &*found;
}

GraphicsSettings withPreset(const GraphicsSettings& before, std::string_view name, bool isSoftwareRenderer) {
    const Preset* preset = findPreset(name, isSoftwareRenderer);
    base::require(preset != nullptr, "withPreset: no preset has this name");
    GraphicsSettings settings{preset->options, preset->mesh,
                              preset->viewDistance.value_or(before.viewDistance),
                              preset->horizon.value_or(before.horizon), preset->detail};
    settings.render.draw = before.render.draw;
    settings.render.surfaces = before.render.surfaces;
    settings.render.renderScale = before.render.renderScale;
    settings.render.upscaling = before.render.upscaling;
    return settings;
}

PresetChoice choosePreset(double lowMilliseconds, double framesPerSecond) {
    assert(lowMilliseconds > 0 && "a frame takes time");
    PresetChoice choice;
    double dearest = 0;
    for (const Preset& preset : presets()) {
        const double cost = preset.relativeCost.value_or(0), milliseconds = cost * lowMilliseconds;
        const bool isWithin = milliseconds <= targetMilliseconds(framesPerSecond);
        if (cost <= dearest || (choice.preset && !isWithin)) continue;
        dearest = cost;
        choice = {&preset, 1000 / milliseconds};
    }
    return choice;
}

}  // namespace terrane::render
