#include "terrane/world/sky/environment.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace terrane::world {

namespace {

constexpr float kGroundAlbedo = 0.3f;
// The horizon hides a disc, not a point: light fades over this much of the sine.
constexpr float kHorizonFade = 0.01f;

// Rows: equal steps of the root of the altitude. Columns: of the root of the sine over the horizon's sine.
template <int Columns, int Rows>
struct Grid {
    std::array<glm::vec3, std::size_t{Columns} * Rows> entries;

    glm::vec3& at(int column, int row) { return entries[static_cast<std::size_t>(row * Columns + column)]; }
    glm::vec3 sample(float x, float y) const {
        x *= Columns - 1;
        y *= Rows - 1;
        const int column = std::min(static_cast<int>(x), Columns - 2),
                  row = std::min(static_cast<int>(y), Rows - 2);
        const glm::vec3* first = &entries[static_cast<std::size_t>(row * Columns + column)];
        const float u = x - static_cast<float>(column), v = y - static_cast<float>(row);
        return glm::mix(glm::mix(first[0], first[1], u), glm::mix(first[Columns], first[Columns + 1], u), v);
    }
};

constexpr int kSines = 96, kAltitudes = 24, kAroundSines = 64, kAroundAltitudes = 10;
constexpr float kLowestSine = -0.35f;  // of the table of scattered light: the sun 20° down

float horizonSine(float altitude) {
    const float share = kPlanetRadius / (kPlanetRadius + altitude);
    return -std::sqrt(std::max(1 - share * share, 0.0f));
}

float altitudeOf(int row, int rows) {
    const float root = static_cast<float>(row) / static_cast<float>(rows - 1);
    return kAirTop * root * root;
}

struct Tables {
    Grid<kSines, kAltitudes> direct;
    Grid<kAroundSines, kAroundAltitudes> around;

    Tables();
    glm::vec3 directAt(float altitude, float sine) const {
        const float horizon = horizonSine(altitude), over = sine - horizon;
        if (over <= -kHorizonFade) return glm::vec3(0);
        const float x = std::sqrt(glm::clamp(over / (1 - horizon), 0.0f, 1.0f));
        const float y = std::sqrt(glm::clamp(altitude / kAirTop, 0.0f, 1.0f));
        return direct.sample(x, y) * glm::smoothstep(-kHorizonFade, kHorizonFade, over);
    }
    glm::vec3 aroundAt(float altitude, float sine) const {
        return around.sample(glm::clamp((sine - kLowestSine) / (1 - kLowestSine), 0.0f, 1.0f),
                             std::sqrt(glm::clamp(altitude / kAirTop, 0.0f, 1.0f)));
    }
    glm::vec3 scattered(float altitude, float sine) const;
};

struct Gathered {
    // As seen from there: light that was scattered once, and the same if the light were 1 everywhere.
    glm::vec3 light{0}, share{0};
};

// Integrates along a direction, with phase functions that are equal on all sides (Hillaire 2020, equations 5
// to 8).
Gathered gather(const Tables& tables, float altitude, glm::vec3 direction, glm::vec3 toLight) {
    constexpr int kSteps = 12;
    const float from = kPlanetRadius + altitude, top = kPlanetRadius + kAirTop, along = from * direction.z;
    const float nearest2 = from * from - along * along;
    const bool hitsGround = direction.z < 0 && nearest2 < kPlanetRadius * kPlanetRadius;
    const float length = hitsGround ? -along - std::sqrt(kPlanetRadius * kPlanetRadius - nearest2)
                                    : std::sqrt(std::max(top * top - nearest2, 0.0f)) - along;
    const float cosine = glm::dot(direction, toLight);
    const auto lightSine = [&](float t, float radius) { return (from * toLight.z + t * cosine) / radius; };
    Gathered sum;
    glm::vec3 left(1);
    float a = 0;
    for (int k = 0; k < kSteps; ++k) {
        const float part = static_cast<float>(k + 1) / kSteps, b = length * part * part, t = 0.5f * (a + b);
        const float radius = std::sqrt(nearest2 + (along + t) * (along + t)), up = radius - kPlanetRadius;
        const AirDensity density = airDensity(up);
        const glm::vec3 lost = extinction(density), after = glm::exp(-lost * (b - a));
        const glm::vec3 scattering = kRayleigh * density.rayleigh + glm::vec3(kHazeScattering * density.haze);
        const glm::vec3 seen = left * scattering * (1.0f - after) / lost;
        sum.light += seen * tables.directAt(up, lightSine(t, radius)) / (4 * std::numbers::pi_v<float>);
        sum.share += seen;
        left *= after;
        a = b;
    }
    if (hitsGround) {
        const float sine = lightSine(length, kPlanetRadius);
        sum.light += left * (kGroundAlbedo / std::numbers::pi_v<float> * std::max(sine, 0.0f)) *
                     tables.directAt(0, sine);
    }
    return sum;
}

// Each further scattering keeps the same share of light: a geometric series.
glm::vec3 Tables::scattered(float altitude, float sine) const {
    constexpr int kRings = 8, kAzimuths = 4;
    const glm::vec3 toLight(std::sqrt(std::max(1 - sine * sine, 0.0f)), 0, sine);
    Gathered mean;
    for (int ring = 0; ring < kRings; ++ring) {
        const float up = (2 * static_cast<float>(ring) + 1) / kRings - 1, level = std::sqrt(1 - up * up);
        for (int k = 0; k < kAzimuths; ++k) {
            const float azimuth = std::numbers::pi_v<float> * (static_cast<float>(k) + 0.5f) / kAzimuths;
            const Gathered g =
                gather(*this, altitude, {level * std::cos(azimuth), level * std::sin(azimuth), up}, toLight);
            mean.light += g.light / static_cast<float>(kRings * kAzimuths);
            mean.share += g.share / static_cast<float>(kRings * kAzimuths);
        }
    }
    return mean.light / (1.0f - mean.share);
}

Tables::Tables() {
    for (int row = 0; row < kAltitudes; ++row) {
        const float altitude = altitudeOf(row, kAltitudes), horizon = horizonSine(altitude);
        for (int column = 0; column < kSines; ++column) {
            const float root = static_cast<float>(column) / (kSines - 1);
            // Just over the horizon, so that rounding does not hide the light.
            const float sine = std::min(horizon + (1 - horizon) * root * root + 1e-5f, 1.0f);
            direct.at(column, row) = transmittanceToSpace(altitude, sine);
        }
    }
    for (int row = 0; row < kAroundAltitudes; ++row) {
        for (int column = 0; column < kAroundSines; ++column) {
            const float sine =
                kLowestSine + (1 - kLowestSine) * static_cast<float>(column) / (kAroundSines - 1);
            around.at(column, row) = scattered(altitudeOf(row, kAroundAltitudes), sine);
        }
    }
}

}  // namespace

AirLight airLight(float altitude, float sine) {
    static const Tables tables;
    return {tables.directAt(altitude, sine), tables.aroundAt(altitude, sine)};
}

namespace {

constexpr int kSteps = 24;  // along a line of sight

// A step on a line of sight: what it scatters does not depend on the azimuth.
struct Step {
    float along;         // blocks from the eye to its middle
    float altitude;      // of its middle
    glm::vec3 rayleigh;  // share of light there that reaches the eye, scattered by molecules
    glm::vec3 haze;      // by haze
};
using Line = std::array<Step, kSteps>;

// Within a step the light falls off as in even air (Hillaire 2020, section 5.3).
Line lineOfSight(float sine) {
    const float from = kPlanetRadius + kEyeAltitude, top = kPlanetRadius + kAirTop;
    const float start = from * sine, nearest2 = from * from * (1 - sine * sine);
    const float length = std::sqrt(top * top - nearest2) - start;
    Line line;
    glm::vec3 left(1);
    float a = 0;
    for (int k = 0; k < kSteps; ++k) {
        const float share = static_cast<float>(k + 1) / kSteps, b = length * share * share * share;
        Step& s = line[static_cast<std::size_t>(k)];
        s.along = 0.5f * (a + b);
        const float middle = start + s.along;
        s.altitude = std::sqrt(nearest2 + middle * middle) - kPlanetRadius;
        const AirDensity density = airDensity(s.altitude);
        const glm::vec3 lost = extinction(density), after = glm::exp(-lost * (b - a));
        const glm::vec3 seen = left * (1.0f - after) / lost;
        s.rayleigh = kRayleigh * density.rayleigh * seen;
        s.haze = kHazeScattering * density.haze * seen;
        left *= after;
        a = b;
    }
    return line;
}

glm::vec3 radianceAlong(const Line& line, glm::vec3 direction, glm::vec3 toLight) {
    const float cosine = glm::dot(direction, toLight);
    const float rayleigh = rayleighPhase(cosine), haze = hazePhase(cosine);
    const float from = kPlanetRadius + kEyeAltitude;
    glm::vec3 sum(0);
    for (const Step& s : line) {
        // The upward direction turns on the way: far toward the light it stands higher.
        const float sine = (from * toLight.z + s.along * cosine) / (kPlanetRadius + s.altitude);
        const AirLight light = airLight(s.altitude, sine);
        sum += light.direct * (s.rayleigh * rayleigh + s.haze * haze) + light.around * (s.rayleigh + s.haze);
    }
    return sum;
}

glm::vec3 directionOf(float sine, float azimuth) {
    const float level = std::sqrt(1 - sine * sine);
    return {level * std::cos(azimuth), level * std::sin(azimuth), sine};
}

glm::vec3 integratedIrradiance(float lightSine) {
    constexpr int kAzimuths = 8, kRings = 8;
    const glm::vec3 toLight = directionOf(lightSine, 0);
    glm::vec3 sum(0);
    for (int ring = 0; ring < kRings; ++ring) {
        // Rings of equal share of the irradiance: equal steps of sine².
        const float sine = std::sqrt((static_cast<float>(ring) + 0.5f) / kRings);
        const Line line = lineOfSight(sine);
        for (int k = 0; k < kAzimuths; ++k) {
            const float azimuth = std::numbers::pi_v<float> * (static_cast<float>(k) + 0.5f) / kAzimuths;
            sum += radianceAlong(line, directionOf(sine, azimuth), toLight);
        }
    }
    return std::numbers::pi_v<float> / (kAzimuths * kRings) * sum;
}

// By the sine of the light's elevation, from kLowest up.
struct IrradianceTable {
    static constexpr int kEntries = 96;
    static constexpr float kLowest = -0.35f;
    std::array<glm::vec3, kEntries> entries;

    IrradianceTable() {
        for (int k = 0; k < kEntries; ++k) {
            const float t = static_cast<float>(k) / (kEntries - 1);
            entries[static_cast<std::size_t>(k)] = integratedIrradiance(kLowest + (1 - kLowest) * t);
        }
    }
};

}  // namespace

glm::vec3 directLight(float sine) {
    const float above = glm::smoothstep(-kDiscFade, kDiscFade, sine);
    return airLight(kEyeAltitude, std::max(sine, 0.0f)).direct * above;
}

glm::vec3 skyRadiance(glm::vec3 direction, glm::vec3 toLight) {
    assert(direction.z >= 0 && "the sky is above the horizon");
    return radianceAlong(lineOfSight(direction.z), direction, toLight);
}

glm::vec3 skyIrradiance(float sine) {
    static const IrradianceTable table;
    const float at =
        glm::clamp((sine - IrradianceTable::kLowest) / (1 - IrradianceTable::kLowest), 0.0f, 1.0f) *
        (IrradianceTable::kEntries - 1);
    const int k = std::min(static_cast<int>(at), IrradianceTable::kEntries - 2);
    return glm::mix(table.entries[static_cast<std::size_t>(k)],
                    table.entries[static_cast<std::size_t>(k) + 1], at - static_cast<float>(k));
}

SkyTable skyTable(float sine) {
    SkyTable table;
    const glm::vec3 toLight = directionOf(sine, 0);
    for (int row = 0; row < SkyTable::kRows; ++row) {
        const float root = static_cast<float>(row) / (SkyTable::kRows - 1), up = root * root;
        const Line line = lineOfSight(up);
        for (int column = 0; column < SkyTable::kColumns; ++column) {
            const float half = static_cast<float>(column) / (SkyTable::kColumns - 1);
            const glm::vec3 direction = directionOf(up, 2 * std::asin(half));
            table.radiance[static_cast<std::size_t>(row * SkyTable::kColumns + column)] =
                radianceAlong(line, direction, toLight);
        }
    }
    return table;
}

glm::vec3 sampled(const SkyTable& table, glm::vec3 direction, glm::vec3 toLight) {
    const glm::vec2 a(direction), b(toLight);
    const float cosine = glm::dot(a, b) / std::max(glm::length(a) * glm::length(b), 1e-6f);
    const float x = std::sqrt(std::max(0.5f - 0.5f * cosine, 0.0f)) * (SkyTable::kColumns - 1);
    const float y = std::sqrt(std::max(direction.z, 0.0f)) * (SkyTable::kRows - 1);
    const int column = std::min(static_cast<int>(x), SkyTable::kColumns - 2);
    const int row = std::min(static_cast<int>(y), SkyTable::kRows - 2);
    const auto at = [&](int c, int r) {
        return table.radiance[static_cast<std::size_t>(r * SkyTable::kColumns + c)];
    };
    const float u = x - static_cast<float>(column), v = y - static_cast<float>(row);
    return glm::mix(glm::mix(at(column, row), at(column + 1, row), u),
                    glm::mix(at(column, row + 1), at(column + 1, row + 1), u), v);
}

namespace {

// From kMoonSets the moon stays under the horizon; at kSunRises, in the dark, the sun takes its place. The
// reverse from kSunSets to kMoonRises.
constexpr float kMoonSets = 0.12f, kSunRises = 0.15f, kSunSets = 0.85f, kMoonRises = 0.88f;

// To the eye a light a hundredth as strong is a sixteenth as bright: brightness grows with the power 0.6 of
// luminance (near the exponents of S. S. Stevens, On the Psychophysical Law, 1957). So twilight and the
// zenith are not black.
constexpr float kEyePower = 0.6f;
// Factors from the curve to colors, chosen for the brightness of noon.
constexpr float kSunScale = 0.90f, kAmbientScale = 2.75f, kSkyScale = 2.3f;
// Colors of the sky are this much farther from grey than three samples of the spectrum give.
constexpr float kVividness = 1.35f;

// Moonlight in proportion to sunlight, as the eye sees it: far brighter than in nature, so that players can
// see. The sky is darker than that, for the stars.
struct LightScales {
    glm::vec3 direct, ambient, sky;
};
constexpr LightScales kSun{glm::vec3(kSunScale), glm::vec3(kAmbientScale), glm::vec3(kSkyScale)};
constexpr glm::vec3 kMoonColor{0.62f, 0.92f, 1.6f};
constexpr LightScales kMoon{kSunScale * 0.125f * kMoonColor, kAmbientScale * 0.03f * kMoonColor,
                            kSkyScale * 0.028f * kMoonColor};

// Light without sun and moon: airglow and stars.
constexpr glm::vec3 kNightAmbient{0.018f, 0.024f, 0.046f};
constexpr glm::vec3 kNightZenith{0.0016f, 0.0024f, 0.0070f}, kNightHorizon{0.0048f, 0.0070f, 0.0165f};

float fraction(float v) {
    return v - std::floor(v);
}

float luminance(glm::vec3 v) {
    return glm::dot(v, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

glm::vec3 asSeen(glm::vec3 light) {
    const float bright = luminance(light);
    return bright > 1e-12f ? light * std::pow(bright, kEyePower - 1) : glm::vec3(0);
}

const LightScales& scalesOf(bool isMoon) {
    return isMoon ? kMoon : kSun;
}

// A quarter as colorful as the sky: clouds and ground reflect light of all colors.
glm::vec3 ambientOf(float sine, bool isMoon) {
    const glm::vec3 sky = asSeen(skyIrradiance(sine));
    return scalesOf(isMoon).ambient * glm::mix(glm::vec3(luminance(sky)), sky, 0.25f) + kNightAmbient;
}

glm::vec3 colorOf(glm::vec3 radiance, float sine, bool isMoon) {
    const float nearHorizon = std::exp(-5.5f * sine);
    const glm::vec3 seen = asSeen(radiance);
    const glm::vec3 vivid = glm::max(glm::mix(glm::vec3(luminance(seen)), seen, kVividness), 0.05f * seen);
    return scalesOf(isMoon).sky * vivid + glm::mix(kNightZenith, kNightHorizon, nearHorizon);
}

// Sun and moon share one path from east (-x) to west, tilted to the south (-y … +y); the moon runs it
// backwards and faster, through the night.
glm::vec3 lightDirection(float time) {
    const bool isSun = time >= kSunRises && time < kSunSets;
    const bool isMoon = time < kMoonSets || time >= kMoonRises;
    float path = time < 0.5f ? 0.0f : 1.0f;
    if (isSun) path = (time - kSunRises) / (kSunSets - kSunRises);
    if (isMoon) path = 1.0f - fraction(time - kMoonRises) / fraction(kMoonSets - kMoonRises);
    const float angle = 3.14159265f * path;
    return glm::normalize(
        glm::vec3(-std::cos(angle), 0.5f * std::sin(angle), 1.25f * std::sin(angle) - 0.25f));
}

void setSkyColors(Environment& e) {
    const glm::vec3 ahead = glm::normalize(glm::vec3(e.lightDirection.x, e.lightDirection.y, 0));
    const glm::vec3 aside(-ahead.y, ahead.x, 0);
    const auto at = [&](glm::vec3 level) {
        return skyColor(glm::normalize(level + glm::vec3(0, 0, 0.08f)), e.lightDirection, e.isMoon);
    };
    const glm::vec3 under = at(ahead), beside = at(aside), opposite = at(-ahead);
    e.zenithColor = skyColor({0, 0, 1}, e.lightDirection, e.isMoon);
    e.horizonColor = 0.25f * (under + 2.0f * beside + opposite);
    e.glowColor = glm::max(under - beside, glm::vec3(0));
}

}  // namespace

glm::vec3 skyColor(glm::vec3 direction, glm::vec3 toLight, bool isMoon) {
    return colorOf(skyRadiance(direction, toLight), direction.z, isMoon);
}

SkyTable skyColorTable(float sine, bool isMoon) {
    SkyTable table = skyTable(sine);
    for (std::size_t k = 0; k < table.radiance.size(); ++k) {
        const float root = static_cast<float>(k / SkyTable::kColumns) / (SkyTable::kRows - 1);
        table.radiance[k] = colorOf(table.radiance[k], root * root, isMoon);
    }
    return table;
}

float ambientGreen(float sine, bool isMoon) {
    return ambientOf(sine, isMoon).y;
}

Environment environmentAt(float timeDay) {
    const float time = fraction(timeDay);
    const bool isSun = time >= kSunRises && time < kSunSets;
    Environment e{};
    e.lightDirection = lightDirection(time);
    e.isMoon = !isSun;
    const float sine = e.lightDirection.z;
    e.lightColor = scalesOf(e.isMoon).direct * asSeen(directLight(sine));
    e.ambientColor = ambientOf(sine, e.isMoon);
    setSkyColors(e);
    e.starTurn = time;
    // Unlike its light on the ground the disc keeps its color down to the horizon, which hides it.
    const glm::vec3 disc = asSeen(directLight(std::max(sine, kDiscFade)));
    e.discColor = (isSun ? 8.0f : 9.0f) * scalesOf(e.isMoon).direct * disc;
    e.starLight = glm::smoothstep(0.0f, 1.0f, glm::clamp((std::abs(time - 0.5f) - 0.29f) / 0.1f, 0.0f, 1.0f));
    e.discRadius = isSun ? 0.045f : 0.03f;
    e.lampShare = 0.8f * glm::clamp(e.ambientColor.y / 0.56f, 0.0f, 1.0f);
    return e;
}

}  // namespace terrane::world
