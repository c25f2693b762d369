#include "terrane/render/sky/sky_texture.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "terrane/base/profile.h"
#include "terrane/shared/bindings.h"
#include "terrane/world/sky/air.h"

namespace terrane::render {

namespace {

constexpr int kSize = 256;

float bumps(float x, float y) {
    return octaves(x, y, 8, 3, 40);
}

std::uint8_t byteOf(float v) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(255 * v), 0L, 255L));
}

}  // namespace

SkyNoise SkyNoise::create() {
    std::vector<std::uint8_t> texels;
    texels.reserve(4 * kSize * kSize);
    constexpr float kStep = 1.0f / kSize, kSlope = 6;
    for (int row = 0; row < kSize; ++row) {
        for (int column = 0; column < kSize; ++column) {
            const float x = static_cast<float>(column) * kStep, y = static_cast<float>(row) * kStep;
            texels.push_back(byteOf(octaves(x, y, 4, 5, 1)));
            texels.push_back(byteOf(octaves(x, y, 16, 4, 20)));
            texels.push_back(byteOf(0.5f + kSlope * (bumps(x + kStep, y) - bumps(x, y))));
            texels.push_back(byteOf(0.5f + kSlope * (bumps(x, y + kStep) - bumps(x, y))));
        }
    }
    SkyNoise noise;
    noise.texture_ = gpu::Texture2D({kSize, kSize}, GL_RGBA8, gpu::fullLevels({kSize, kSize}), "noise");
    noise.texture_.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(texels)));
    noise.texture_.generateMipmaps();
    noise.sampler_ =
        gpu::Sampler({.minFilter = GL_LINEAR_MIPMAP_LINEAR, .wrapS = GL_REPEAT, .wrapT = GL_REPEAT}, "noise");
    return noise;
}

void SkyNoise::addTo(gpu::TextureSet& textures) const {
    textures.add(shared::kSkyNoiseUnit, texture_.id(), &sampler_);
}

namespace {

constexpr int kColumns = 256, kRows = 64;

float gauss(float v) {
    return std::exp(-v * v);
}

// `along`: 0…1 around the sky, 0.5 the brightest part; `across`: -1…1. Clouds of stars fade outward, wider
// and warmer in the middle; dark lanes of dust run along the band, in front of the brightest part.
glm::vec3 bandColor(float along, float across) {
    const float y = 0.5f + 0.25f * across;  // stretched along: a cell is twice as long as wide
    const float bend = 0.16f * (octaves(along, 0.3f, 4, 3, 70) - 0.5f);
    const float bulge = gauss((along - 0.5f) / 0.11f), from = across - bend;
    const float width = 0.26f + 0.2f * bulge;
    const float clumps = octaves(along, y, 16, 5, 80);
    const float stars = gauss(from / width) * (0.35f + 0.65f * bulge) * (0.35f + 1.3f * clumps);
    const float winding = 0.3f * (octaves(along, y, 8, 4, 90) - 0.5f);
    const float torn = glm::smoothstep(0.35f, 0.65f, octaves(along, y, 16, 4, 100));
    const float dust = gauss((from - winding) / (0.09f + 0.05f * bulge)) * (0.25f + 0.75f * torn);
    const glm::vec3 warm(1.0f, 0.88f, 0.78f), cold(0.6f, 0.76f, 1.0f);
    const glm::vec3 color = glm::mix(cold, warm, bulge);
    // Dust absorbs blue first.
    return color * stars * glm::mix(glm::vec3(1), glm::vec3(0.32f, 0.24f, 0.2f), dust) *
           glm::smoothstep(1.0f, 0.7f, std::abs(across));
}

std::uint8_t displayedByte(float v) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(255 * std::pow(v, 1 / 2.2f)), 0L, 255L));
}

}  // namespace

MilkyWay MilkyWay::create() {
    std::vector<std::uint8_t> texels;
    texels.reserve(4 * kColumns * kRows);
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            const glm::vec3 color = bandColor((static_cast<float>(column) + 0.5f) / kColumns,
                                              (2 * static_cast<float>(row) + 1) / kRows - 1);
            for (const float channel : {color.x, color.y, color.z}) texels.push_back(displayedByte(channel));
            texels.push_back(255);
        }
    }
    MilkyWay made;
    made.texture_ = gpu::Texture2D({kColumns, kRows}, GL_SRGB8_ALPHA8, 1, "milky way");
    made.texture_.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(texels)));
    made.sampler_ = gpu::Sampler({.wrapS = GL_REPEAT}, "milky way");
    return made;
}

void MilkyWay::addTo(gpu::TextureSet& textures) const {
    textures.add(shared::kMilkyWayUnit, texture_.id(), &sampler_);
}

namespace {

constexpr float kSteps = 2500;  // of the sine of the light's elevation
constexpr float kLog2E = 1.44269504f;
constexpr float kAureoleSharpness = 500, kSunAureole = 0.45f, kMoonAureole = 0.25f;

static_assert(shared::kSkyTableColumns == world::SkyTable::kColumns &&
              shared::kSkyTableRows == world::SkyTable::kRows);

}  // namespace

shared::AirFrame airUniforms(const world::Environment& e, const world::AirLevels& levels, float cameraZ) {
    const float ground = levels.sea - world::kSeaAltitude, floor = ground + world::kHazeFloor;
    const float altitude = std::max(cameraZ - ground, 0.0f), overFloor = std::max(cameraZ - floor, 0.0f);
    const glm::vec2 level(e.lightDirection), azimuth = level / std::max(glm::length(level), 1e-6f);
    shared::AirFrame frame{};
    const float haze = kLog2E * world::kHazeExtinction * std::exp(-altitude / world::kHazeScale);
    frame.lightAzimuth = glm::vec4(azimuth, e.ambientColor.y, haze * std::exp(overFloor / world::kHazeScale));
    frame.aureole = glm::vec4((e.isMoon ? kMoonAureole : kSunAureole) * e.lightColor, kAureoleSharpness);
    frame.depth = {kLog2E * world::kRayleigh.x * std::exp(-altitude / world::kRayleighScale), haze,
                   1 / world::kHazeScale, 0.5f / world::kRayleighScale};
    frame.levels = {floor, levels.clouds, 0, 0};
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
void SkyTexture::update(const world::Environment& e, const world::AirLevels& levels, float cameraZ,
                        gpu::MappedRing& ring) {
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
    const shared::AirFrame frame = airUniforms(e, levels, cameraZ);
    ring.writeUniform(shared::kAirBinding, frame);
}

void SkyTexture::addTo(gpu::TextureSet& textures) const {
    textures.add(shared::kSkyTableUnit, texture_.id(), &sampler_);
    milkyWay_.addTo(textures);
}

}  // namespace terrane::render
