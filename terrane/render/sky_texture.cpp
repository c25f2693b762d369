#include "terrane/render/sky_texture.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <span>
#include <vector>

#include "terrane/base/profile.h"
#include "terrane/shared/bindings.h"
#include "terrane/world/air.h"

namespace terrane::render {
namespace {

constexpr float kSteps = 2500;  // of the sine of the light's elevation
constexpr float kLog2E = 1.44269504f;
constexpr float kAureoleSharpness = 500, kSunAureole = 0.45f, kMoonAureole = 0.25f;

static_assert(shared::kSkyTableColumns == world::SkyTable::kColumns &&
              shared::kSkyTableRows == world::SkyTable::kRows);

}  // namespace

shared::AirFrame airUniforms(const world::Environment& e, float altitudeZ) {
    const float altitude = std::max(altitudeZ - world::kSeaLevel, 0.0f);
    const glm::vec2 level(e.lightDirection), azimuth = level / std::max(glm::length(level), 1e-6f);
    shared::AirFrame frame{};
    frame.lightAzimuth = glm::vec4(azimuth, e.ambientColor.y, 0);
    frame.aureole = glm::vec4((e.isMoon ? kMoonAureole : kSunAureole) * e.lightColor, kAureoleSharpness);
    frame.depth = {kLog2E * world::kRayleigh.x * std::exp(-altitude / world::kRayleighScale),
                   kLog2E * world::kHazeExtinction * std::exp(-altitude / world::kHazeScale),
                   1 / world::kHazeScale, 0.5f / world::kRayleighScale};
    return frame;
}

SkyTexture SkyTexture::create() {
    SkyTexture sky;
    sky.texture_ = gpu::Texture2D({world::SkyTable::kColumns, world::SkyTable::kRows}, GL_RGBA16F, 1, "sky");
    sky.sampler_ = gpu::Sampler({}, "sky");
    sky.milkyWay_ = MilkyWay::create();
    return sky;
}

// The table is scaled by 1 / the ambient light of its step, and the frame multiplies it by its own: between
// steps only the shape of the sky is constant, not its brightness.
void SkyTexture::bind(const world::Environment& e, float altitudeZ, gpu::MappedRing& ring) {
    const int step = static_cast<int>(std::lround(e.lightDirection.z * kSteps));
    if (step != step_ || e.isMoon != isMoon_) {
        TERRANE_ZONE("sky table");
        const float sine = static_cast<float>(step) / kSteps;
        const world::SkyTable table = world::skyColorTable(sine, e.isMoon);
        const float scale = 1 / world::ambientGreen(sine, e.isMoon);
        std::vector<glm::u64> texels;
        texels.reserve(table.radiance.size());
        for (const glm::vec3 color : table.radiance)
            texels.push_back(glm::packHalf4x16(glm::vec4(scale * color, 1)));
        texture_.upload(0, GL_RGBA, GL_HALF_FLOAT, std::as_bytes(std::span(texels)));
        step_ = step;
        isMoon_ = e.isMoon;
    }
    const shared::AirFrame frame = airUniforms(e, altitudeZ);
    ring.writeUniform(shared::kAirBinding, frame);
    texture_.bind(shared::kSkyTableUnit);
    sampler_.bind(shared::kSkyTableUnit);
    milkyWay_.bind();
}

}  // namespace terrane::render
