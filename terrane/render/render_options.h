// How a frame is drawn: every choice that a user has, as one plain value, and named sets of them. Any
// thread.
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
};

// How light is sampled between blocks: docs/light.md.
enum class LightSampling : std::uint8_t { Classic, Smooth };

enum class Occlusion : std::uint8_t { Off, On, Raw };  // Raw shows it instead of the image

// Full adds what is mirrored of the shore, a swell, foam and light that waves bundle on the ground.
enum class Water : std::uint8_t { Plain, Full };

// What is done about the cracks between quads of different sizes.
enum class TJunctions : std::uint8_t {
    Open,     // nothing
    Filled,   // holes of one sample take on what is beside them: hole_fill.h
    Covered,  // quads overlap by a little, so that there are none: edge_expansion.glsl
};

// How far from the camera the sun and moon cast shadows.
enum class ShadowReach : std::uint8_t {
    Off,
    Near,     // 50 blocks
    Far,      // 800 blocks
    Horizon,  // as far as one sees
};

struct RenderOptions {
    int msaaSamples = 2;  // a pixel: 1, 2, 4, 8; the driver may take the next number it has
    Shading shading = Shading::Sample;
    LightSampling light = LightSampling::Classic;
    ShadowReach shadows = ShadowReach::Near;
    int shadowSize = 2048;     // texels a side of each shadow map: 1024, 2048, 4096
    bool softShadows = false;  // edges widen with the distance of what casts them
    Occlusion occlusion = Occlusion::Off;
    bool depthOfField = true;
    bool distanceFog = true;
    bool godRays = true;
    bool clouds = true;
    bool animation = true;
    bool sharpFiltering = true;  // magnified texels with sharp and smooth edges
    bool msaaAlphaTest = true;   // holes in leaves and plants are found for each sample
    Water water = Water::Full;
    int transparencyLayers = 3;       // of blended faces, 0 to 3
    int singleTransparencyLayer = 0;  // shows this one alone, 1 to 3; 0: all
    TJunctions tJunctions = TJunctions::Covered;
    bool occlusionCulling = true;  // of mesh sections behind others

    bool operator==(const RenderOptions&) const = default;
};

constexpr int kDefaultDetail = 12;

// All that a user sets about what is on screen: how it is drawn, out of which meshes, and how far.
struct GraphicsSettings {
    RenderOptions render;
    mesh::MeshOptions mesh;
    int viewDistance = 16;        // chunks
    int horizon = 1024;           // how far land goes on beyond them, chunks; 0: not at all
    int detail = kDefaultDetail;  // tiles a ring of a level of detail: see stream::TileView

    bool operator==(const GraphicsSettings&) const = default;
};

struct Preset {
    std::string_view name;
    RenderOptions options;
    mesh::MeshOptions mesh = {};
    int detail = kDefaultDetail;
    std::optional<int> viewDistance = {}, horizon = {};  // none: as they are
    // GPU time of a frame, low's is 1: docs/rendering.md. None: no measurement picks it.
    std::optional<double> relativeCost = {};
};

// low, medium, high, ultra, thesis.
const std::array<Preset, 5>& presets();
// Null where there is none of the name. "auto" is high on a graphics card and low without one.
const Preset* findPreset(std::string_view name, bool isSoftwareRenderer);
// There is a preset of the name.
GraphicsSettings withPreset(const GraphicsSettings& before, std::string_view name, bool isSoftwareRenderer);

}  // namespace terrane::render
