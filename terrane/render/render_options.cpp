#include "terrane/render/render_options.h"

namespace terrane::render {
namespace {

// Next to nothing besides the image: for drawing without a graphics card.
constexpr RenderOptions low() {
    RenderOptions o;
    o.msaaSamples = 1;
    o.shadowSize = 0;
    o.depthOfField = o.godRays = o.msaaAlphaTest = o.sharpFiltering = o.clouds = false;
    o.transparencyLayers = 1;
    return o;
}

constexpr RenderOptions medium() {
    RenderOptions o;
    o.msaaSamples = 2;
    o.light = LightSampling::Smooth;
    o.shadowSize = 2048;
    o.depthOfField = false;
    o.transparencyLayers = 2;
    return o;
}

constexpr RenderOptions high() {
    RenderOptions o;
    o.msaaSamples = 4;
    o.light = LightSampling::Smooth;
    o.shadowSize = 4096;
    o.occlusion = Occlusion::On;
    o.depthOfField = false;
    return o;
}

}  // namespace

// What RenderOptions says by itself is the set that the thesis measured with.
const std::array<Preset, 4>& presets() {
    static constexpr std::array<Preset, 4> kPresets = {
        {{"low", low()}, {"medium", medium()}, {"high", high()}, {"thesis", RenderOptions{}}}};
    return kPresets;
}

std::optional<RenderOptions> findPreset(std::string_view name, bool isSoftwareRenderer) {
    if (name == "auto") name = isSoftwareRenderer ? "low" : "high";
    for (const Preset& preset : presets()) {
        if (preset.name == name) return preset.options;
    }
    return std::nullopt;
}

}  // namespace terrane::render
