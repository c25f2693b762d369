#include "terrane/render/frame/graphics_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "terrane/base/text.h"

namespace terrane::render {
namespace {

constexpr std::array kSamples = {1, 2, 4, 8};
constexpr std::array kShadowSizes = {1024, 2048, 4096};
constexpr std::array kMeshSectionHeights = {8, 16, 32, 64, 128};
constexpr std::array kHorizons = {0, 128, 256, 512, 1024, 2048, 4096};
constexpr std::array kDetails = {8, 12, 16, 20, 24, 28, 32};

template <std::size_t kCount>
int indexOf(const std::array<int, kCount>& values, int value) {
    return static_cast<int>(std::ranges::find(values, value) - values.begin());
}

GraphicsRow switchRow(std::string_view name, std::string_view description,
                      int (*get)(const GraphicsSettings&), void (*set)(GraphicsSettings&, int)) {
    return {name, description, {"off", "on"}, get, set};
}

// Rows for members that a value's index can be cast to.
template <auto kMember>
int getMember(const GraphicsSettings& s) {
    return static_cast<int>(s.render.*kMember);
}
template <auto kMember>
void setMember(GraphicsSettings& s, int value) {
    using Value = std::remove_reference_t<decltype(s.render.*kMember)>;
    s.render.*kMember = static_cast<Value>(value);
}
template <auto kMember>
GraphicsRow switchOf(std::string_view name, std::string_view description) {
    return switchRow(name, description, getMember<kMember>, setMember<kMember>);
}

std::vector<GraphicsRow> makeTable() {
    return {
        {"samples",
         "Anti-aliasing: MSAA samples per pixel",
         {"1", "2", "4", "8"},
         [](const GraphicsSettings& s) { return indexOf(kSamples, s.render.msaaSamples); },
         [](GraphicsSettings& s, int value) {
             s.render.msaaSamples = kSamples[static_cast<std::size_t>(value)];
         }},
        {"shading",
         "Shading, per MSAA sample or per pixel",
         {"off", "sample", "pixel"},
         getMember<&RenderOptions::shading>,
         setMember<&RenderOptions::shading>},
        {"light",
         "Interpolation of light between blocks: as stored, or with soft corners and round edges",
         {"classic", "smooth"},
         getMember<&RenderOptions::light>,
         setMember<&RenderOptions::light>},
        {"shadows",
         "Distance up to which sun and moon cast shadows: none, 50 blocks, 800 blocks, or all that is "
         "visible",
         {"off", "near", "far", "horizon"},
         getMember<&RenderOptions::shadows>,
         setMember<&RenderOptions::shadows>},
        {"shadow-size",
         "Texels along a side of each shadow map",
         {"1024", "2048", "4096"},
         [](const GraphicsSettings& s) { return indexOf(kShadowSizes, s.render.shadowSize); },
         [](GraphicsSettings& s, int value) {
             s.render.shadowSize = kShadowSizes[static_cast<std::size_t>(value)];
         }},
        switchOf<&RenderOptions::softShadows>("soft-shadows",
                                              "Shadow edges that widen with the distance to the caster"),
        {"ssao",
         "Ambient occlusion in screen space",
         {"off", "on", "raw"},
         getMember<&RenderOptions::occlusion>,
         setMember<&RenderOptions::occlusion>},
        switchOf<&RenderOptions::depthOfField>("depth-of-field", "Depth of field: blur distant objects"),
        switchOf<&RenderOptions::distanceFog>("distance-fog",
                                              "Distance fog: distant terrain fades into the sky"),
        switchOf<&RenderOptions::godRays>("god-rays", "Rays of light around objects in front of the sun"),
        switchOf<&RenderOptions::clouds>("clouds", "Clouds"),
        switchOf<&RenderOptions::animation>("animation", "Moving plants, leaves and water"),
        switchOf<&RenderOptions::sharpFiltering>("sharp-filtering",
                                                 "Sharp texels with smooth edges in near textures"),
        switchOf<&RenderOptions::msaaAlphaTest>("msaa-alpha-test",
                                                "Anti-aliasing of holes in leaves and plants"),
        {"layers",
         "Transparency layers (depth peeling) of water and glass",
         {"0", "1", "2", "3"},
         getMember<&RenderOptions::transparencyLayers>,
         setMember<&RenderOptions::transparencyLayers>},
        {"water",
         "Water: full adds reflections, swell, foam and caustics",
         {"plain", "full"},
         getMember<&RenderOptions::water>,
         setMember<&RenderOptions::water>},
        {"single-layer",
         "Show one transparency layer alone",
         {"all", "1", "2", "3"},
         getMember<&RenderOptions::singleTransparencyLayer>,
         setMember<&RenderOptions::singleTransparencyLayer>},
        {"t-junctions",
         "Treatment of cracks at T-junctions between quads",
         {"open", "filled", "covered"},
         getMember<&RenderOptions::tJunctions>,
         setMember<&RenderOptions::tJunctions>},
        switchOf<&RenderOptions::occlusionCulling>("occlusion-culling",
                                                   "Do not draw terrain that other terrain hides"),
        {"merging",
         "Method that merges equal faces into quads",
         {mesh::kMergeMethodNames.begin(), mesh::kMergeMethodNames.end()},
         [](const GraphicsSettings& s) { return static_cast<int>(s.mesh.method); },
         [](GraphicsSettings& s, int value) { s.mesh.method = static_cast<mesh::MergeMethod>(value); }},
        {"mesh-section-height",
         "Height in blocks of the mesh sections that are culled and drawn",
         {"8", "16", "32", "64", "128"},
         [](const GraphicsSettings& s) { return indexOf(kMeshSectionHeights, s.mesh.meshSectionHeight); },
         [](GraphicsSettings& s, int value) {
             s.mesh.meshSectionHeight = kMeshSectionHeights[static_cast<std::size_t>(value)];
         }},
        {"horizon",
         "Distance of land beyond the view distance, in chunks",
         {"0", "128", "256", "512", "1024", "2048", "4096"},
         [](const GraphicsSettings& s) { return indexOf(kHorizons, s.horizon); },
         [](GraphicsSettings& s, int value) { s.horizon = kHorizons[static_cast<std::size_t>(value)]; },
         false},
        {"detail",
         "Detail of the land beyond the view distance: tiles from the camera to the edge of each level",
         {"8", "12", "16", "20", "24", "28", "32"},
         [](const GraphicsSettings& s) { return indexOf(kDetails, s.detail); },
         [](GraphicsSettings& s, int value) { s.detail = kDetails[static_cast<std::size_t>(value)]; }},
    };
}

}  // namespace

std::span<const GraphicsRow> graphicsTable() {
    static const std::vector<GraphicsRow> table = makeTable();
    return table;
}

std::vector<std::string> namesOfPreset() {
    std::vector<std::string> names;
    for (const GraphicsRow& row : graphicsTable())
        if (row.isOfPreset) names.emplace_back(row.name);
    return names;
}

std::string valueNamesOf(const GraphicsRow& row) {
    return fmt::format("{}", fmt::join(row.valueNames, ", "));
}

std::optional<int> choiceOf(const GraphicsRow& row, std::string_view name) {
    // Accepts map sizes, which older settings files have for this row.
    if (row.name == "shadows" && (name == "1024" || name == "2048" || name == "4096")) name = "near";
    const auto found = std::ranges::find(row.valueNames, name);
    if (found == row.valueNames.end()) return std::nullopt;
    return static_cast<int>(found - row.valueNames.begin());
}

namespace {

std::vector<std::string> allPresetNames() {
    std::vector<std::string> names = {"auto"};
    for (const Preset& preset : presets()) names.emplace_back(preset.name);
    return names;
}

}  // namespace

std::string presetNames() {
    return fmt::format("{}", fmt::join(allPresetNames(), ", "));
}

std::string presetNameError(const std::string& preset) {
    if (findPreset(preset, false)) return {};
    return base::notOneOf(allPresetNames(), preset);
}

GraphicsSettings settingsOf(const GraphicsChoices& choices, bool isSoftwareRenderer) {
    GraphicsSettings settings = withPreset({}, choices.preset, isSoftwareRenderer);
    for (const auto& [row, value] : choices.changed) graphicsTable()[row].set(settings, value);
    if (choices.viewDistance) settings.viewDistance = *choices.viewDistance;
    return settings;
}

}  // namespace terrane::render
