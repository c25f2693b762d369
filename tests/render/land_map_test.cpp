#include "terrane/render/land/land_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <random>

#include "terrane/render/land/land_textures.h"

namespace terrane::render {
namespace {

constexpr int kAll = LandTextures::kAllLevels;
constexpr double kReach = 12000;  // six levels

// Height of the land at a place, blocks.
using Land = std::function<double(double x, double y)>;

double hills(double x, double y) {
    return 90 + 30 * std::sin(x / 900) * std::cos(y / 700) + 50 * std::sin(x / 2600 + y / 3100);
}

// Steep enough for shadows.
double ranges(double x, double y) {
    return hills(x, y) / 2 + 60 + 45 * std::sin(x / 290 + std::cos(y / 500));
}

world::LandTile tileOf(const Land& land, world::ChunkPos pos) {
    world::LandTile tile;
    const double width = world::columnWidth(pos.level);
    for (std::size_t k = 0; k < world::LandTile::kColumns; ++k) {
        const double x = (16.0 * pos.x + static_cast<double>(k % 16) + 0.5) * width;
        const double y = (16.0 * pos.y + static_cast<double>(k / 16) + 0.5) * width;
        tile.height[k] = static_cast<std::int16_t>(std::clamp(std::lround(land(x, y)), 0l, 256l));
        tile.ground[k] = static_cast<world::BlockId>(1 + (static_cast<int>(std::floor(x / 512)) & 1));
    }
    return tile;
}

world::TopColors colors() {
    return {{}, {glm::vec3(255, 0, 0), false}, {glm::vec3(0, 255, 255), false}};
}

LandMap mapWith(double reach = kReach) {
    LandMap map(colors());
    map.setReach(reach);
    return map;
}

void fill(LandMap& map, const Land& land, world::ChunkPos camera, std::size_t limit = SIZE_MAX) {
    for (const world::ChunkPos tile : map.clipmap().missing(camera, map.reach(), limit))
        map.set(tile, tileOf(land, tile));
}

LandLight lightAt(double azimuth, double elevation) {
    return {glm::vec3(std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
                      std::sin(elevation)),
            0.045f};
}

// Share of the light at a place, as land_light.glsl computes it, by a level or by the finest that has the
// place.
struct Found {
    int level = -1;
    float share = 1, sky = 1;
};

float between(const LandLevel& level, glm::dvec2 uv, const std::function<float(std::size_t)>& value) {
    const glm::dvec2 at = glm::clamp(uv * 256.0 - 0.5, glm::dvec2(0), glm::dvec2(254.999));
    const auto x = static_cast<std::size_t>(at.x), y = static_cast<std::size_t>(at.y);
    const double u = at.x - static_cast<double>(x), v = at.y - static_cast<double>(y);
    const std::size_t k = y * 256 + x;
    EXPECT_LT(k + 257, level.edges.size());
    return static_cast<float>((1 - v) * ((1 - u) * value(k) + u * value(k + 1)) +
                              v * ((1 - u) * value(k + 256) + u * value(k + 257)));
}

Found foundIn(const LandMap& map, const Camera& camera, glm::dvec3 place, int number) {
    const shared::LandFrame frame = landFrame(map, camera);
    const world::ChunkPos chunk = cameraChunk(camera);
    const glm::vec4 l = frame.levels[number];
    const glm::dvec2 from = glm::dvec2(place) - 16.0 * glm::dvec2(chunk.x, chunk.y);
    const glm::dvec2 uv = glm::dvec2(l.x, l.y) + from * static_cast<double>(l.z);
    const LandLevel& level = map.level(number);
    const glm::dvec2 away = glm::abs(uv - 0.5);
    if (std::max(away.x, away.y) >= 0.5 * shared::kLandUsed * l.w) return {};
    const float begin = between(level, uv, [&](std::size_t k) { return level.edges[k].begin; });
    const float edge = between(level, uv, [&](std::size_t k) { return level.edges[k].edge; });
    const float share = std::clamp((static_cast<float>(place.z) - begin) / edge, 0.0f, 1.0f);
    return {number, share * share * (3 - 2 * share),
            between(level, uv, [&](std::size_t k) { return level.sky[k]; })};
}

Found found(const LandMap& map, const Camera& camera, glm::dvec3 place) {
    for (int number = 0; number < kAll; ++number) {
        const Found f = foundIn(map, camera, place, number);
        if (f.level >= 0) return f;
    }
    return {};
}

TEST(LandMap, LevelsAreThereWhenTheirTilesAre) {
    LandMap map = mapWith();
    EXPECT_TRUE(map.update({}, lightAt(0, 0.3), kAll).empty());
    EXPECT_EQ(landFrame(map, {}).levels[0].w, 0.0f);
    for (int loaded = 0; loaded < 6; ++loaded) {
        fill(map, hills, {}, 256);
        const auto changed = map.update({}, lightAt(0, 0.3), kAll);
        EXPECT_EQ(changed, (std::vector<LandChange>{{5 - loaded, true}})) << "the coarsest first";
    }
    EXPECT_TRUE(map.clipmap().missing({}, kReach, SIZE_MAX).empty());
    EXPECT_TRUE(map.update({}, lightAt(0, 0.3), kAll).empty()) << "nothing is new";
    EXPECT_TRUE(map.update({}, lightAt(0.001, 0.3), kAll).empty()) << "a light that hardly moved";
    EXPECT_EQ(map.update({}, lightAt(0.01, 0.3), 2), (std::vector<LandChange>{{5, false}, {4, false}}));
    EXPECT_EQ(map.update({}, lightAt(0.01, 0.3), kAll).size(), 4u);
    map.setReach(1000);
    EXPECT_FALSE(map.level(5).exists());
    map.setReach(kReach);
    map.update({}, lightAt(0.01, 0.3), kAll);
    EXPECT_TRUE(map.level(5).exists()) << "its tiles are kept";
}

// A wall that the sun stands behind: dark before it, up to as far as its shadow is long.
TEST(LandMap, AWallThrowsItsShadow) {
    const auto wall = [](double x, double) { return x > 2000 && x < 2200 ? 200.0 : 60.0; };
    LandMap map = mapWith();
    fill(map, wall, {});
    map.update({}, lightAt(0, std::atan(0.1)), kAll);
    const auto shareAt = [&](double x, double z) { return found(map, {}, {x, 30, z}).share; };
    EXPECT_LT(shareAt(1900, 60), 0.05f);
    EXPECT_LT(shareAt(1200, 60), 0.05f) << "the shadow is 1,400 blocks long";
    EXPECT_GT(shareAt(300, 60), 0.95f);
    EXPECT_GT(shareAt(1900, 230), 0.95f) << "above it";
    EXPECT_GT(shareAt(2100, 200), 0.95f) << "on top";
    EXPECT_GT(shareAt(2500, 60), 0.95f) << "on the sunny side";
    const float middle = shareAt(600, 60);
    EXPECT_GT(middle, 0.05f) << "the edge is soft";
    EXPECT_LT(middle, 0.95f);
}

// Heights are whole blocks, so that a slope is a stair: it is lit whole for a sun well above it.
TEST(LandMap, NoSlopeInTheLightHasSpots) {
    std::mt19937 random(5);
    const auto part = [&] { return std::uniform_real_distribution<double>(0, 1)(random); };
    for (int n = 0; n < 6; ++n) {
        const double azimuth = 6.283 * part(), elevation = 0.15 + 0.8 * part();
        const double toward = 6.283 * part(), rise = (std::tan(elevation) - 0.1) * 0.03 * part();
        const auto slope = [&](double x, double y) {
            return 128 + rise * (x * std::cos(toward) + y * std::sin(toward));
        };
        LandMap map = mapWith(1500);
        fill(map, slope, {});
        map.update({}, lightAt(azimuth, elevation), kAll);
        for (int k = 0; k < 2000; ++k) {
            const glm::dvec2 at = 3000.0 * (glm::dvec2(part(), part()) - 0.5);
            const Found f = found(map, {}, {at.x, at.y, std::floor(slope(at.x, at.y) + 0.5)});
            ASSERT_GE(f.level, 0);
            ASSERT_GT(f.share, 0.97f) << n << ": " << at.x << ' ' << at.y << " elevation " << elevation;
        }
    }
}

TEST(LandMap, LevelsAgree) {
    LandMap map = mapWith();
    fill(map, ranges, {});
    map.update({}, lightAt(0.7, 0.1), kAll);
    std::mt19937 random(9);
    const auto part = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
    for (int level = 0; level < 3; ++level) {  // beyond, ranges are no wider than a few texels
        double shares = 0, skies = 0, dark = 0;
        int count = 0;
        for (int k = 0; k < 4000; ++k) {
            const double half = 110 * kLandClipmap.texelBlocks(level);
            const glm::dvec2 at(half * part(), half * part());
            const glm::dvec3 place(at, ranges(at.x, at.y));
            const Found fine = foundIn(map, {}, place, level), coarse = foundIn(map, {}, place, level + 1);
            ASSERT_TRUE(fine.level == level && coarse.level == level + 1);
            shares += std::abs(fine.share - coarse.share);
            skies += std::abs(fine.sky - coarse.sky);
            dark += fine.share < 0.5f ? 1 : 0;
            ++count;
        }
        EXPECT_GT(dark, count / 50) << level;
        EXPECT_LT(shares / count, 0.06) << level;
        EXPECT_LT(skies / count, 0.02) << level;
    }
}

// Light continues over the edge of a level without a step.
TEST(LandMap, NoRingIsSeenWhereALevelEnds) {
    LandMap map = mapWith();
    const auto rough = [](double x, double y) {
        return hills(x, y) + 12 * std::sin(x / 37) * std::sin(y / 41);
    };
    fill(map, rough, {});
    map.update({}, lightAt(0.7, 0.1), kAll);
    std::mt19937 random(9);
    for (int level = 0; level < 5; ++level) {
        const double half = 128 * kLandClipmap.texelBlocks(level), ends = half * shared::kLandUsed;
        double sum = 0;
        for (int k = 0; k < 500; ++k) {
            const double y = std::uniform_real_distribution<double>(-0.9 * ends, 0.9 * ends)(random);
            const glm::dvec3 inner(ends - 0.01, y, rough(ends, y)), outer(ends + 0.01, y, inner.z);
            const Found in = found(map, {}, inner), out = found(map, {}, outer);
            ASSERT_EQ(in.level, level);
            ASSERT_EQ(out.level, level + 1);
            ASSERT_NEAR(in.share, out.share, 0.1f) << y;
            sum += std::abs(in.share - out.share);
            ASSERT_NEAR(in.sky, out.sky, 0.02f) << y;
        }
        EXPECT_LT(sum / 500, 0.01) << level;
    }
}

// Levels are computed one after the other, and a shadow's caster may be in the next one.
TEST(LandMap, AMountainFarAwayShadesFineLevels) {
    LandMap map = mapWith();
    const auto flat = [](double, double) { return 60.0; };
    fill(map, flat, {});
    const LandLight light = lightAt(0.01, 0.08);
    map.update({}, light, kAll);
    const glm::dvec3 place(850, 4, 60);
    EXPECT_GT(found(map, {}, place).share, 0.9f);
    const world::ChunkPos beside{4, 0, 4};  // 1,024 to 1,280 blocks away: beyond the finest level
    map.set(beside, tileOf([](double, double) { return 200.0; }, beside));
    EXPECT_EQ(map.update({}, light, kAll), (std::vector<LandChange>{{1, true}, {0, false}}));
    EXPECT_EQ(found(map, {}, place).level, 0);
    EXPECT_LT(found(map, {}, place).share, 0.1f);
}

// Whatever the path of a camera, the land is that of one that was always there.
TEST(LandMap, AFlightLeavesNothingBehind) {
    std::mt19937 random(13);
    LandMap map = mapWith(3000);
    world::ChunkPos camera{-1000, 77};
    for (int step = 0; step < 12; ++step) {
        const int stride = 1 << random() % 9;
        camera = world::offsetBy(camera, static_cast<int>(random() % 3 - 1) * stride,
                                 static_cast<int>(random() % 3 - 1) * stride);
        fill(map, hills, camera, random() % 2 == 0 ? 100 : SIZE_MAX);
        map.update(camera, lightAt(0.1 * step, 0.2), 1 + static_cast<int>(random() % 4));
    }
    fill(map, hills, camera);
    while (!map.update(camera, lightAt(2, 0.2), 1).empty()) continue;
    map.update(camera, lightAt(2, 0.2), kAll);
    LandMap fresh = mapWith(3000);
    fill(fresh, hills, camera);
    fresh.update(camera, lightAt(2, 0.2), kAll);
    for (int number = 0; number < 4; ++number) {
        const LandLevel &flown = map.level(number), &made = fresh.level(number);
        ASSERT_TRUE(made.exists() && flown.exists());
        ASSERT_EQ(flown.corner, made.corner);
        ASSERT_EQ(flown.heights, made.heights);
        for (std::size_t k = 0; k < made.edges.size(); ++k) {
            ASSERT_NEAR(flown.edges[k].begin, made.edges[k].begin, 0.01f) << number << ' ' << k;
            ASSERT_NEAR(flown.edges[k].edge, made.edges[k].edge, 0.01f);
            ASSERT_NEAR(flown.sky[k], made.sky[k], 0.01f) << number << ' ' << k;
            ASSERT_LT(glm::distance(flown.ground[k], made.ground[k]), 0.01f);
        }
    }
}

// A sun that moves faster than all levels are computed, one each frame.
TEST(LandMap, AFastLightReachesTheFinestLevel) {
    LandMap map = mapWith();
    fill(map, ranges, {});
    map.update({}, lightAt(0, 0.2), kAll);
    const std::vector<LandEdge> first = map.level(0).edges;
    for (int frame = 1; frame <= 20; ++frame) map.update({}, lightAt(0.1 * frame, 0.2), 1);
    std::size_t changed = 0;
    for (std::size_t k = 0; k < first.size(); ++k)
        changed += std::abs(first[k].begin - map.level(0).edges[k].begin) > 1;
    EXPECT_GT(changed, first.size() / 100);
}

// Neither a step of the camera nor one of the sun changes what is seen at once.
TEST(LandMap, SmallStepsChangeLittle) {
    LandMap map = mapWith();
    fill(map, hills, {});
    map.update({}, lightAt(0.7, 0.06), kAll);
    std::mt19937 random(21);
    std::vector<glm::dvec3> places;
    std::vector<float> before;
    for (int k = 0; k < 3000; ++k) {
        const double reach = std::ldexp(400.0, k % 5);
        std::uniform_real_distribution<double> part(-reach, reach);
        const double x = part(random), y = part(random);
        places.emplace_back(x, y, hills(x, y));
        before.push_back(found(map, {}, places.back()).share);
    }
    const auto expectNear = [&](const char* step, const Camera& camera, double mean) {
        double sum = 0;
        for (std::size_t k = 0; k < places.size(); ++k)
            sum += std::abs(found(map, camera, places[k]).share - before[k]);
        EXPECT_LT(sum / static_cast<double>(places.size()), mean) << step;
    };
    expectNear("chunk", {.position = {20, -9, 100}}, 1e-5);  // in another chunk
    map.update({}, lightAt(0.702, 0.06), kAll);
    expectNear("light", {}, 0.01);
    map.update({}, lightAt(0.7, 0.06), kAll);
    const Camera moved{.position = {400, 300, 100}};  // other tiles
    fill(map, hills, cameraChunk(moved));
    map.update(cameraChunk(moved), lightAt(0.7, 0.06), kAll);
    expectNear("tiles", moved, 0.01);
}

TEST(LandMap, TheGroundHasItsColor) {
    LandMap map = mapWith(500);
    fill(map, [](double, double) { return 60; }, {});
    map.update({}, lightAt(0.7, 0.5), kAll);
    const LandLevel& level = map.level(0);
    const auto at = [&](int x) {  // blocks
        return level.ground[static_cast<std::size_t>(128 * 256 + x / 8 - level.corner.x)];
    };
    EXPECT_EQ(at(100), glm::vec3(1, 0, 0));
    EXPECT_EQ(at(700), glm::vec3(0, 1, 1));
}

// Land of a world that lies lower has the same shadows, lower.
TEST(LandMap, ShadowsFollowTheHeightsOfTheWorld) {
    constexpr world::Heights kDeep{-1808, -1552};
    LandMap low = mapWith(), deep(colors(), kDeep);
    deep.setReach(kReach);
    const world::ChunkPos camera{5, -9};
    fill(low, ranges, camera);
    for (const world::ChunkPos tile : deep.clipmap().missing(camera, deep.reach(), SIZE_MAX)) {
        world::LandTile land = tileOf(ranges, tile);
        for (std::int16_t& height : land.height) height = static_cast<std::int16_t>(height + kDeep.bottom);
        deep.set(tile, land);
    }
    low.update(camera, lightAt(0.7, 0.1), kAll);
    deep.update(camera, lightAt(0.7, 0.1), kAll);
    EXPECT_EQ(deep.lowestEdge(), low.lowestEdge() + kDeep.bottom);
    for (int number = 0; number < kAll; ++number) {
        const LandLevel &a = low.level(number), &b = deep.level(number);
        ASSERT_EQ(a.edges.size(), b.edges.size());
        for (std::size_t k = 0; k < a.edges.size(); ++k) {
            ASSERT_NEAR(b.edges[k].begin, a.edges[k].begin + kDeep.bottom, 0.02f) << number << ' ' << k;
            ASSERT_NEAR(b.edges[k].edge, a.edges[k].edge, 0.02f);
            ASSERT_NEAR(b.sky[k], a.sky[k], 1e-4f);
        }
    }
}

}  // namespace
}  // namespace terrane::render
