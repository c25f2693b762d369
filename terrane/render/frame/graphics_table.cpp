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
constexpr std::array kRenderScales = {25, 33, 40, 50, 60, 67, 75, 85, 100, 150, 200, 300, 400};
constexpr std::array kHorizons = {0, 128, 256, 512, 1024, 2048, 4096};
constexpr std::array kDetails = {8, 12, 16, 20, 24, 28, 32};

template <std::size_t kCount>
int indexOf(const std::array<int, kCount>& values, int value) {
    return static_cast<int>(std::ranges::find(values, value) - values.begin());
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

struct RowTexts {
    std::string_view name, description;
    const char *label = nullptr, *tip = nullptr;
    std::vector<const char*> valueLabels = {};
};

template <auto kMember>
GraphicsRow rowOf(std::vector<std::string_view> valueNames, RowTexts texts) {
    return {texts.name,         texts.description,           std::move(valueNames),
            getMember<kMember>, setMember<kMember>,          texts.label,
            texts.tip,          std::move(texts.valueLabels)};
}
template <auto kMember>
GraphicsRow switchOf(RowTexts texts) {
    return rowOf<kMember>({"off", "on"}, std::move(texts));
}

std::vector<GraphicsRow> makeTable() {
    return {
        {.name = "samples",
         .description = "Anti-aliasing: MSAA samples per pixel",
         .valueNames = {"1", "2", "4", "8"},
         .get = [](const GraphicsSettings& s) { return indexOf(kSamples, s.render.msaaSamples); },
         .set = [](GraphicsSettings& s,
                   int value) { s.render.msaaSamples = kSamples[static_cast<std::size_t>(value)]; },
         .label = "Anti-aliasing",
         .tip = "Samples per pixel (MSAA).\nCost: high; four samples at least double the frame time.",
         .valueLabels = {"Off", "2 samples", "4 samples", "8 samples"}},
        rowOf<&RenderOptions::shading>(
            {"off", "sample", "pixel", "corners"},
            {"shading", "Shading, per MSAA sample, per pixel, or at the corners of quads alone"}),
        rowOf<&RenderOptions::light>(
            {"classic", "smooth"},
            {"light",
             "Interpolation of light between blocks: as stored, or with soft corners and round edges",
             "Light",
             "Steps from block to block, or smooth transitions.\nCost: low.",
             {"Classic", "Smooth"}}),
        rowOf<&RenderOptions::shadows>(
            {"off", "near", "far", "horizon", "rays"},
            {"shadows",
             "Distance up to which sun and moon cast shadows: none, 50 blocks, 800 blocks, or all that is "
             "visible, from maps or by rays",
             "Shadows",
             "How far the sun and the moon cast shadows.\nCost: medium, higher while you move.",
             {"Off", "Near", "Far", "To the horizon", "By rays"}}),
        {.name = "shadow-size",
         .description = "Texels along a side of each shadow map",
         .valueNames = {"1024", "2048", "4096"},
         .get = [](const GraphicsSettings& s) { return indexOf(kShadowSizes, s.render.shadowSize); },
         .set = [](GraphicsSettings& s,
                   int value) { s.render.shadowSize = kShadowSizes[static_cast<std::size_t>(value)]; }},
        switchOf<&RenderOptions::softShadows>(
            {"soft-shadows", "Shadow edges that widen with the distance to the caster", "Soft shadows",
             "Shadows get softer with the distance to what casts them.\nCost: low."}),
        rowOf<&RenderOptions::occlusion>(
            {"off", "on", "raw"},
            {"ssao",
             "Ambient occlusion in screen space",
             "Ambient occlusion",
             "Corners and gaps are a little darker (SSAO).\nCost: a fourteenth of the frame "
             "time.",
             {"Off", "On", "Coarse"}}),
        switchOf<&RenderOptions::depthOfField>({"depth-of-field", "Depth of field: blur distant objects",
                                                "Depth of field", "Distant things are blurred.\nCost: low."}),
        switchOf<&RenderOptions::distanceFog>({"distance-fog",
                                               "Distance fog: distant terrain fades into the sky",
                                               "Distance fog", "Far land fades into the sky.\nCost: none."}),
        switchOf<&RenderOptions::godRays>({"god-rays", "Rays of light around objects in front of the sun",
                                           "Sun rays",
                                           "Rays of light between things in front of the sun.\nCost: low."}),
        switchOf<&RenderOptions::bloom>({"bloom", "Light that spreads around lamps and the sun", "Bloom",
                                         "Light spreads around what shines.\nCost: low."}),
        switchOf<&RenderOptions::clouds>(
            {"clouds", "Clouds", "Clouds", "Clouds in the sky and their shadows.\nCost: medium."}),
        switchOf<&RenderOptions::animation>({"animation", "Moving plants, leaves and water", "Moving plants",
                                             "Plants, leaves and water move.\nCost: low."}),
        switchOf<&RenderOptions::adaptation>(
            {"adaptation", "Eyes that adapt to caves and nights, which become brighter then", "Adapting eyes",
             "Dark places become readable after a moment.\nCost: none."}),
        switchOf<&RenderOptions::sharpFiltering>(
            {"sharp-filtering", "Sharp texels with smooth edges in near textures"}),
        switchOf<&RenderOptions::msaaAlphaTest>(
            {"msaa-alpha-test", "Anti-aliasing of holes in leaves and plants"}),
        rowOf<&RenderOptions::transparencyLayers>(
            {"0", "1", "2", "3"}, {"layers", "Transparency layers (depth peeling) of water and glass"}),
        rowOf<&RenderOptions::water>(
            {"plain", "full"}, {"water",
                                "Water: full adds reflections, swell, foam and caustics",
                                "Water",
                                "Full: reflected shores, waves, foam.\nCost: medium where water is in view.",
                                {"Plain", "Full"}}),
        rowOf<&RenderOptions::singleTransparencyLayer>({"all", "1", "2", "3"},
                                                       {"single-layer", "Show one transparency layer alone"}),
        rowOf<&RenderOptions::tJunctions>(
            {"open", "filled", "covered"},
            {"t-junctions", "Treatment of cracks at T-junctions between quads"}),
        switchOf<&RenderOptions::occlusionCulling>(
            {"occlusion-culling", "Do not draw terrain that other terrain hides"}),
        switchOf<&RenderOptions::leafBacks>(
            {"leaf-backs", "Draw back sides of leaves, which one sees through holes"}),
        {.name = "merging",
         .description = "Method that merges equal faces into quads",
         .valueNames = {mesh::kMergeMethodNames.begin(), mesh::kMergeMethodNames.end()},
         .get = [](const GraphicsSettings& s) { return static_cast<int>(s.mesh.method); },
         .set = [](GraphicsSettings& s,
                   int value) { s.mesh.method = static_cast<mesh::MergeMethod>(value); }},
        {.name = "mesh-section-height",
         .description = "Height in blocks of the mesh sections that are culled and drawn",
         .valueNames = {"8", "16", "32", "64", "128"},
         .get =
             [](const GraphicsSettings& s) { return indexOf(kMeshSectionHeights, s.mesh.meshSectionHeight); },
         .set =
             [](GraphicsSettings& s, int value) {
                 s.mesh.meshSectionHeight = kMeshSectionHeights[static_cast<std::size_t>(value)];
             }},
        {.name = "horizon",
         .description = "Distance of land beyond the view distance, in chunks",
         .valueNames = {"0", "128", "256", "512", "1024", "2048", "4096"},
         .get = [](const GraphicsSettings& s) { return indexOf(kHorizons, s.horizon); },
         .set = [](GraphicsSettings& s,
                   int value) { s.horizon = kHorizons[static_cast<std::size_t>(value)]; },
         .label = "Distant land",
         .tip = "How far coarser land continues beyond the view distance.\nCost: medium, also in memory.",
         .valueLabels = {"None", "2 km", "4 km", "8 km", "16 km", "33 km", "65 km"},
         .isOfPreset = false},
        {.name = "detail",
         .description =
             "Detail of the land beyond the view distance: tiles from the camera to the edge of each level",
         .valueNames = {"8", "12", "16", "20", "24", "28", "32"},
         .get = [](const GraphicsSettings& s) { return indexOf(kDetails, s.detail); },
         .set = [](GraphicsSettings& s, int value) { s.detail = kDetails[static_cast<std::size_t>(value)]; }},
        {.name = "render-scale",
         .description =
             "Size of the image that is drawn, in percent of the one that is shown, along each side",
         .valueNames = {"25", "33", "40", "50", "60", "67", "75", "85", "100", "150", "200", "300", "400"},
         .get = [](const GraphicsSettings& s) { return indexOf(kRenderScales, s.render.renderScale); },
         .set = [](GraphicsSettings& s,
                   int value) { s.render.renderScale = kRenderScales[static_cast<std::size_t>(value)]; },
         .label = "Render scale",
         .tip = "Draws the world smaller and enlarges the image; text stays sharp.\nSaves time where pixels "
                "take it.",
         .valueLabels = {"25 %", "33 %", "40 %", "50 %", "60 %", "67 %", "75 %", "85 %", "100 %", "150 %",
                         "200 %", "300 %", "400 %"},
         .isOfPreset = false},
        {.name = "upscaling",
         .description = "Enlargement of a smaller image: by blending, in square pixels, along edges (FSR 1), "
                        "or as suits the driver",
         .valueNames = {"auto", "linear", "nearest", "edges"},
         .get = getMember<&RenderOptions::upscaling>,
         .set = setMember<&RenderOptions::upscaling>,
         .label = "Enlargement",
         .tip = "How a smaller image is enlarged: see the render scale.\nCost: low on a graphics card.",
         .valueLabels = {"Automatic", "Soft", "Square pixels", "Along edges"},
         .isOfPreset = false},
        {.name = "renderer",
         .description = "How visible surfaces are found: quads by the rasterizer, or blocks by rays",
         .valueNames = {"quads", "rays"},
         .get = getMember<&RenderOptions::surfaces>,
         .set = setMember<&RenderOptions::surfaces>,
         .isOfPreset = false},
        {.name = "draw",
         .description = "Culling and draw calls: in lists by the graphics card, one by one by the processor, "
                        "or as suits the driver",
         .valueNames = {"auto", "indirect", "loop"},
         .get = getMember<&RenderOptions::draw>,
         .set = setMember<&RenderOptions::draw>,
         .isOfPreset = false},
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
    return base::expectedOneOf(allPresetNames(), preset);
}

GraphicsSettings settingsOf(const GraphicsChoices& choices, bool isSoftwareRenderer) {
    GraphicsSettings settings = withPreset({}, choices.preset, isSoftwareRenderer);
    for (const auto& [row, value] : choices.changed) graphicsTable()[row].set(settings, value);
    if (choices.viewDistance) settings.viewDistance = *choices.viewDistance;
    return settings;
}

}  // namespace terrane::render
