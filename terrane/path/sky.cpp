#include "terrane/path/sky.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace terrane::path {
namespace {

using world::SkyTable;

constexpr int kCellColumns = SkyTable::kColumns - 1, kCellRows = SkyTable::kRows - 1;

// The borders of cells: azimuth from the light, and sine of the elevation.
float azimuthOf(int column) {
    return 2 * std::asin(static_cast<float>(column) / kCellColumns);
}
float sineOf(int row) {
    const float root = static_cast<float>(row) / kCellRows;
    return root * root;
}

// Of one of the two cells that lie to both sides of the light.
float solidAngle(int cell) {
    const int column = cell % kCellColumns, row = cell / kCellColumns;
    return (azimuthOf(column + 1) - azimuthOf(column)) * (sineOf(row + 1) - sineOf(row));
}

glm::vec3 meanOf(const SkyTable& table, int cell) {
    const int first = cell / kCellColumns * SkyTable::kColumns + cell % kCellColumns;
    const auto at = [&](int k) { return table.radiance[static_cast<std::size_t>(first + k)]; };
    return 0.25f * (at(0) + at(1) + at(SkyTable::kColumns) + at(SkyTable::kColumns + 1));
}

void setCumulative(Sky& sky) {
    float sum = 0;
    for (int cell = 0; cell < kCellColumns * kCellRows; ++cell) {
        sum += luminance(meanOf(sky.table, cell) * sky.lightShare) * solidAngle(cell);
        sky.cumulative.push_back(sum);
    }
    if (sum == 0) return sky.cumulative.clear();
    for (float& value : sky.cumulative) value /= sum;
    sky.cumulative.back() = 1;
}

glm::vec2 levelToLight(const Sky& sky) {
    const glm::vec2 level(sky.toLight);
    const float length = glm::length(level);
    return length > 1e-6f ? level / length : glm::vec2(1, 0);
}

// Mean radiance over a level surface, by the cosine.
glm::vec3 meanOverGround(const SkyTable& table) {
    glm::vec3 sum(0);
    for (int cell = 0; cell < kCellColumns * kCellRows; ++cell) {
        const int row = cell / kCellColumns;
        sum += meanOf(table, cell) * (2 * solidAngle(cell) * 0.5f * (sineOf(row) + sineOf(row + 1)));
    }
    return sum / kPi;
}

}  // namespace

Sky skyOf(const world::Environment& e, const shared::AirFrame& air) {
    Sky sky;
    sky.table = world::skyColorTable(e.lightDirection.z, e.isMoon);
    const float scale = air.lightAzimuth.z / world::ambientGreen(e.lightDirection.z, e.isMoon);
    for (glm::vec3& radiance : sky.table.radiance) radiance *= scale;
    sky.lightShare = e.ambientColor / meanOverGround(sky.table);
    sky.toLight = e.lightDirection;
    sky.aureole = glm::vec3(air.aureole);
    sky.aureoleSharpness = air.aureole.w;
    sky.discColor = e.discColor;
    sky.discCosine = std::cos(e.discRadius);
    // A disc of radiance 1 gives a surface that faces it π sin² of its radius.
    const float sine = std::sin(e.discRadius);
    sky.discRadiance = e.lightColor / (sine * sine);
    setCumulative(sky);
    return sky;
}

Sky evenSky(glm::vec3 radiance) {
    Sky sky;
    sky.table.radiance.fill(radiance);
    setCumulative(sky);
    return sky;
}

glm::vec3 seenSky(const Sky& sky, glm::vec3 direction) {
    const glm::vec3 above(direction.x, direction.y, std::max(direction.z, 0.0f));
    const float away = 1 + sky.aureoleSharpness * (1 - glm::dot(direction, sky.toLight));
    return world::sampled(sky.table, above, sky.toLight) + sky.aureole / (away * away);
}

glm::vec3 skyLight(const Sky& sky, glm::vec3 direction) {
    const glm::vec3 above(direction.x, direction.y, std::max(direction.z, 0.0f));
    return world::sampled(sky.table, above, sky.toLight) * sky.lightShare;
}

glm::vec3 sampleSky(const Sky& sky, glm::vec2 random) {
    const auto found = std::upper_bound(sky.cumulative.begin(), sky.cumulative.end(), random.x);
    const int cell = static_cast<int>(std::min(found, sky.cumulative.end() - 1) - sky.cumulative.begin());
    const float before = cell > 0 ? sky.cumulative[static_cast<std::size_t>(cell - 1)] : 0;
    const float share = sky.cumulative[static_cast<std::size_t>(cell)] - before;
    const float along = share > 0 ? (random.x - before) / share : 0.5f;
    const int column = cell % kCellColumns, row = cell / kCellColumns;
    const bool isLeft = random.y < 0.5f;
    const float up = isLeft ? 2 * random.y : 2 * random.y - 1;
    float azimuth = glm::mix(azimuthOf(column), azimuthOf(column + 1), glm::clamp(along, 0.0f, 1.0f));
    if (isLeft) azimuth = -azimuth;
    const float sine = glm::mix(sineOf(row), sineOf(row + 1), up);
    const float level = std::sqrt(std::max(1 - sine * sine, 0.0f));
    const glm::vec2 toLight = levelToLight(sky);
    const float c = level * std::cos(azimuth), s = level * std::sin(azimuth);
    return {c * toLight.x - s * toLight.y, c * toLight.y + s * toLight.x, sine};
}

float skyDensity(const Sky& sky, glm::vec3 direction) {
    if (direction.z < 0 || sky.cumulative.empty()) return 0;
    const float length = std::sqrt(direction.x * direction.x + direction.y * direction.y);
    const glm::vec2 toLight = levelToLight(sky);
    const float cosine = length > 1e-6f ? (direction.x * toLight.x + direction.y * toLight.y) / length : 1;
    const float across = std::sqrt(std::max(0.5f - 0.5f * cosine, 0.0f)), up = std::sqrt(direction.z);
    const int column = std::min(static_cast<int>(across * kCellColumns), kCellColumns - 1);
    const int row = std::min(static_cast<int>(up * kCellRows), kCellRows - 1);
    const int cell = row * kCellColumns + column;
    const float before = cell > 0 ? sky.cumulative[static_cast<std::size_t>(cell - 1)] : 0;
    return (sky.cumulative[static_cast<std::size_t>(cell)] - before) / (2 * solidAngle(cell));
}

glm::vec3 sampleDisc(const Sky& sky, glm::vec2 random) {
    const float cosine = 1 - random.x * (1 - sky.discCosine), angle = 2 * kPi * random.y;
    const float sine = std::sqrt(std::max(1 - cosine * cosine, 0.0f));
    const Frame frame = frameOf(sky.toLight);
    return glm::normalize(cosine * sky.toLight +
                          sine * (std::cos(angle) * frame.across + std::sin(angle) * frame.along));
}

// T. Duff et al., Building an Orthonormal Basis, Revisited, 2017.
Frame frameOf(glm::vec3 n) {
    const float sign = std::copysign(1.0f, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

}  // namespace terrane::path
