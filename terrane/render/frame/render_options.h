// Options of drawing: every user option as one plain value, and presets. Any thread may use it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "terrane/mesh/mesh_options.h"

namespace terrane::render {

enum class Shading : std::uint8_t {
    Off,     // the colors of the blocks alone
    Sample,  // each sample of a pixel by itself
    Pixel,   // once a pixel: the nearest depth, the mean of colors and normals
    // At the corners of quads, in the pass that draws them: light, air and water are interpolated between.
    // For software renderers. What other passes add is left out: see drawnOptions().
    Corners,
};

// Sampling of light between blocks: docs/light.md.
enum class LightSampling : std::uint8_t { Classic, Smooth };

enum class Occlusion : std::uint8_t { Off, On, Raw };  // Raw shows it instead of the image

// Full adds reflections of the shore, swell, foam and caustics.
enum class Water : std::uint8_t { Plain, Full };

// The treatment of cracks between quads of different sizes.
enum class TJunctions : std::uint8_t {
    Open,     // nothing
    Filled,   // holes of one sample take the value of a neighbor: hole_fill.cpp
    Covered,  // quads overlap by a little, so that there are no cracks: edge_expansion.glsl
};

// The distance from the camera up to which sun and moon cast shadows.
enum class ShadowReach : std::uint8_t {
    Off,
    Near,     // 50 blocks
    Far,      // 800 blocks
    Horizon,  // as far as land is visible
    Rays,     // the same, by one ray for each shaded point: docs/rays.md
};

// How visible surfaces are found.
enum class SurfaceMethod : std::uint8_t {
    Quads,  // drawn by the rasterizer
    Rays,   // one ray for each sample: docs/rays.md
};

// Who selects the draws, and how they reach the driver: docs/rendering.md, Draw calls.
enum class DrawMethod : std::uint8_t {
    Auto,      // the loop without a graphics card and for drivers that draw lists wrongly
    Indirect,  // one call draws a list that the GPU wrote
    Loop,      // the CPU culls, and calls once for each command
};

// How an image that is drawn smaller than the screen is enlarged.
enum class Upscaling : std::uint8_t {
    Auto,  // Linear without a graphics card, else Edges
    Linear,
    Nearest,  // square pixels
    Edges,    // along edges, and sharpened
};

struct RenderOptions {
    int msaaSamples = 2;  // a pixel: 1, 2, 4, 8; the driver may take the next number it has
    Shading shading = Shading::Sample;
    LightSampling light = LightSampling::Classic;
    ShadowReach shadows = ShadowReach::Near;
    int shadowSize = 2048;     // texels a side of each shadow map: 1024, 2048, 4096
    bool softShadows = false;  // edges widen with the distance to the caster
    Occlusion occlusion = Occlusion::Off;
    bool depthOfField = true;
    bool distanceFog = true;
    bool godRays = true;
    bool bloom = true;  // around what is brighter than the screen
    bool clouds = true;
    bool animation = true;
    bool adaptation = true;      // the eye adapts to the dark
    bool sharpFiltering = true;  // magnified texels with sharp and smooth edges
    bool msaaAlphaTest = true;   // holes in leaves and plants are found for each sample
    Water water = Water::Full;
    int transparencyLayers = 3;       // of blended faces, 0 to 3
    int singleTransparencyLayer = 0;  // shows this one alone, 1 to 3; 0: all
    TJunctions tJunctions = TJunctions::Covered;
    bool occlusionCulling = true;  // of mesh sections behind others
    bool leafBacks = true;         // back sides of leaves, seen through holes; with occlusion culling
    int renderScale = 100;         // size of the drawn image, percent of the screen's: no preset sets it
    Upscaling upscaling = Upscaling::Auto;          // no preset sets it
    DrawMethod draw = DrawMethod::Auto;             // no preset sets it
    SurfaceMethod surfaces = SurfaceMethod::Quads;  // no preset sets it

    bool operator==(const RenderOptions&) const = default;
};

// Returns the options without those that have no effect together with others: shading at corners has no
// G-buffer that shadows, clouds and effects could read, and rays cull nothing and leave no cracks.
RenderOptions drawnOptions(RenderOptions options);

constexpr int kDefaultDetail = 12;
constexpr int kMaxViewDistance = 64;  // chunks

// All settings of the image: how it is drawn, from which meshes, and how far.
struct GraphicsSettings {
    RenderOptions render;
    mesh::MeshOptions mesh;
    int viewDistance = 16;        // chunks
    int horizon = 1024;           // distance of land beyond them, chunks; 0: none
    int detail = kDefaultDetail;  // tiles a ring of a level of detail: see stream::TileView

    bool operator==(const GraphicsSettings&) const = default;
};

struct Preset {
    std::string_view name;
    const char* label =
        nullptr;  // for players, in English; null: only on the command line and for developers
    const char* about = nullptr;
    RenderOptions options = {};
    mesh::MeshOptions mesh = {};
    int detail = kDefaultDetail;
    std::optional<int> viewDistance = {}, horizon = {};  // none: unchanged
    // GPU time of a frame relative to low: docs/rendering.md. None: render_options.h never selects it.
    std::optional<double> relativeCost = {};
};

// Returns the presets minimal, low, medium, high, ultra and thesis.
const std::array<Preset, 6>& presets();
// Returns the preset of a name; null if there is none. "auto" is high on a graphics card and low without one.
const Preset* findPreset(std::string_view name, bool isSoftwareRenderer);
// Returns the settings with those of a preset. A preset of the name must exist.
GraphicsSettings withPreset(const GraphicsSettings& before, std::string_view name, bool isSoftwareRenderer);

// Selects the best preset for a machine from a measurement of low. Any thread may use it.
//
// Frames a second that the choice aims at: 30 without a graphics card.
constexpr double targetFramesPerSecond(bool isSoftwareRenderer) {
    return isSoftwareRenderer ? 30 : 60;
}
// A fifth of the frame is left for the interface, the system and views that cost more.
constexpr double targetMilliseconds(double framesPerSecond) {
    return 0.8 * 1000 / framesPerSecond;
}

struct PresetChoice {
    const Preset* preset = nullptr;
    double framesPerSecond = 0;  // expected
};

// Returns the most expensive preset whose frame is expected to take at most targetMilliseconds(); the
// cheapest if none does. `lowMilliseconds`: GPU time of a frame with low, above 0.
PresetChoice choosePreset(double lowMilliseconds, double framesPerSecond);

}  // namespace terrane::render
