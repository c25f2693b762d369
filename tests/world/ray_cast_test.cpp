#include "terrane/world/ray_cast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <random>

#include "tests/world/lowest_highest.h"
#include "tests/world/put_block.h"

namespace terrane::world {
namespace {

constexpr BlockId kRock = 1, kPlant = 2, kWater = 3, kSlab = 4;

const BlockRegistry& registry() {
    static const BlockRegistry result = *BlockRegistry::parse(
        "[[block]]\nname = \"rock\"\nshape = \"cube\"\ntexture = \"a\"\n"
        "[[block]]\nname = \"plant\"\nshape = \"cross\"\ntexture = \"a\"\nopacity = 0\ncollides = false\n"
        "selection = [[0.25, 0.25, 0], [0.75, 0.75, 0.5]]\n"
        "[[block]]\nname = \"water\"\nshape = \"liquid\"\ntexture = \"a\"\nopacity = 1\nselectable = false\n"
        "[[block]]\nname = \"slab\"\nshape = \"cube\"\ntexture = \"a\"\nselection = [[0, 0, 0.5], [1, 1, "
        "1]]\n",
        "test");
    return result;
}

// Chunks around a block, so that blocks near it can be set.
World worldAround(BlockPos at) {
    World world;
    const ChunkPos center = chunkOf(at);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            if (const ChunkPos pos{center.x + x, center.y + y}; isInWorld(pos))
                world.insert(pos, std::make_shared<Chunk>());
    return world;
}

std::optional<RayHit> cast(const World& world, glm::dvec3 origin, glm::dvec3 direction,
                           double maxDistance = 20) {
    return castRay(world, registry(), {.origin = origin, .direction = direction}, maxDistance);
}

TEST(RayCast, FaceAndDistanceAlongEachAxis) {
    World world = worldAround({5, 5, 5});
    putBlock(world, {5, 5, 5}, kRock);
    const glm::dvec3 center(5.5, 5.5, 5.5);
    for (int face = 0; face < kFaceCount; ++face) {
        glm::dvec3 outward(0);
        outward[face / 2] = face % 2 ? 1 : -1;
        const auto hit = cast(world, center + 4.0 * outward, -3.0 * outward);
        ASSERT_TRUE(hit) << face;
        EXPECT_EQ(hit->block, (BlockPos{5, 5, 5}));
        EXPECT_EQ(hit->face, face);
        EXPECT_DOUBLE_EQ(hit->distance, 3.5);
        EXPECT_FALSE(cast(world, center + 4.0 * outward, outward)) << "away from it";
    }
}

TEST(RayCast, NoFurtherThanTheMaximum) {
    World world = worldAround({0, 0, 0});
    putBlock(world, {10, 0, 0}, kRock);
    EXPECT_TRUE(cast(world, {0.5, 0.5, 0.5}, {1, 0, 0}, 9.5));
    EXPECT_FALSE(cast(world, {0.5, 0.5, 0.5}, {1, 0, 0}, 9.4999));
    EXPECT_FALSE(cast(world, {9.5, 0.5, 0.5}, {1, 0, 0}, -1));
}

TEST(RayCast, SelectionBoxes) {
    World world = worldAround({0, 0, 0});
    putBlock(world, {3, 0, 5}, kPlant);
    putBlock(world, {6, 0, 5}, kRock);
    const auto low = cast(world, {0.5, 0.5, 5.25}, {1, 0, 0});
    ASSERT_TRUE(low);
    EXPECT_EQ(low->block, (BlockPos{3, 0, 5}));
    EXPECT_DOUBLE_EQ(low->distance, 2.75);
    const auto above = cast(world, {0.5, 0.5, 5.75}, {1, 0, 0});
    ASSERT_TRUE(above);
    EXPECT_EQ(above->block, (BlockPos{6, 0, 5}));
    const auto down = cast(world, {3.5, 0.5, 7}, {0, 0, -1});
    ASSERT_TRUE(down);
    EXPECT_EQ(down->face, kFacePosZ);
    EXPECT_DOUBLE_EQ(down->distance, 1.5);
}

TEST(RayCast, PassesWhatIsNotSelectable) {
    World world = worldAround({0, 0, 0});
    for (int x = 0; x < 4; ++x) putBlock(world, {x, 0, 0}, kWater);
    putBlock(world, {4, 0, 0}, kRock);
    const auto hit = cast(world, {0.5, 0.5, 0.5}, {1, 0, 0});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->block, (BlockPos{4, 0, 0}));
}

TEST(RayCast, UnknownBlocksAreHit) {
    World world = worldAround({0, 0, 0});
    putBlock(world, {4, 0, 0}, 60000);
    EXPECT_TRUE(cast(world, {0.5, 0.5, 0.5}, {1, 0, 0}));
}

TEST(RayCast, FromInsideABox) {
    World world = worldAround({0, 0, 0});
    putBlock(world, {0, 0, 0}, kRock);
    const auto hit = cast(world, {0.5, 0.5, 0.5}, {0.1, 0, 1});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->block, (BlockPos{0, 0, 0}));
    EXPECT_EQ(hit->distance, 0);
    EXPECT_EQ(hit->face, kFaceNegZ);
}

TEST(RayCast, FromOutsideTheHeight) {
    World world = worldAround({0, 0, 0});
    putBlock(world, {0, 0, 255}, kRock);
    putBlock(world, {1, 0, 0}, kRock);
    EXPECT_DOUBLE_EQ(cast(world, {0.5, 0.5, 300}, {0, 0, -1}, 100)->distance, 44);
    EXPECT_DOUBLE_EQ(cast(world, {1.5, 0.5, -10}, {0, 0, 1}, 100)->distance, 10);
    EXPECT_FALSE(cast(world, {0.5, 0.5, 300}, {1, 0, 0}, 1e18)) << "ends, though nothing is there";
    EXPECT_FALSE(cast(world, {0.5, 0.5, 300}, {0, 0, 1}, 1e18));
}

TEST(RayCast, RaysThatAreNone) {
    World world = worldAround({0, 0, 0});
    putBlock(world, {0, 0, 0}, kRock);
    const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
    EXPECT_FALSE(cast(world, {0.5, 0.5, 0.5}, {0, 0, 0}));
    EXPECT_FALSE(cast(world, {0.5, 0.5, 0.5}, {nan, 0, 0}));
    EXPECT_FALSE(cast(world, {0.5, 0.5, 0.5}, {infinity, 0, 0}));
    EXPECT_FALSE(cast(world, {0.5, nan, 0.5}, {1, 0, 0}));
    EXPECT_FALSE(cast(world, {infinity, 0.5, 0.5}, {1, 0, 0}));
    EXPECT_FALSE(cast(world, {1e300, 0.5, 0.5}, {-1, 0, 0}));
    EXPECT_FALSE(cast(world, {0.5, 0.5, 0.5}, {1, 0, 0}, nan));
}

TEST(RayCast, LengthOfTheDirectionDoesNotMatter) {
    World world = worldAround({0, 0, 0});
    putBlock(world, {3, 4, 0}, kRock);
    for (const double scale : {1e-300, 1.0, 1e300}) {
        const auto hit = cast(world, {0.5, 0.5, 0.5}, scale * glm::dvec3(3, 4, 0));
        ASSERT_TRUE(hit) << scale;
        EXPECT_NEAR(hit->distance, 4.375, 1e-12);
        EXPECT_EQ(hit->face, kFaceNegY);
    }
}

TEST(RayCast, AtTheCornersOfTheWorld) {
    for (const std::int32_t x : {kLowest, kHighest})
        for (const std::int32_t y : {kLowest, kHighest}) {
            World world = worldAround({x, y, 0});
            putBlock(world, {x, y, 100}, kRock);
            const double inward = x < 0 ? 1 : -1;
            const glm::dvec3 center(x + 0.5, y + 0.5, 100.5);
            const auto hit = cast(world, center + glm::dvec3(5 * inward, 0, 0), {-inward, 0, 0});
            ASSERT_TRUE(hit);
            EXPECT_EQ(hit->block, (BlockPos{x, y, 100}));
            EXPECT_EQ(hit->face, x < 0 ? kFacePosX : kFaceNegX);
            EXPECT_DOUBLE_EQ(hit->distance, 4.5);
            EXPECT_TRUE(cast(world, center - glm::dvec3(5 * inward, 0, 0), {inward, 0, 0}))
                << "from beyond the edge";
            EXPECT_FALSE(cast(world, center - glm::dvec3(inward, 0, 0), {-inward, 0, 0}, 1e18));
        }
}

constexpr int kFilledSide = 12;  // blocks along each side of the random worlds' filled part

// A world with random blocks in a cube whose lowest corner is `corner`.
World randomWorld(BlockPos corner, int percentFilled, std::mt19937& random) {
    World world = worldAround(corner);
    for (int z = 0; z < kFilledSide; ++z)
        for (int y = 0; y < kFilledSide; ++y)
            for (int x = 0; x < kFilledSide; ++x)
                if (static_cast<int>(random() % 100) < percentFilled)
                    putBlock(world, {corner.x + x, corner.y + y, corner.z + z},
                             static_cast<BlockId>(1 + random() % 4));
    return world;
}

// A ray from a random point in or near that cube. Its origin is a multiple of 2^-10: exact also at 2^31.
Ray randomRay(BlockPos corner, std::mt19937& random) {
    const auto coordinate = [&](std::int32_t low) {
        return static_cast<double>(low) - 2 +
               static_cast<double>(random() % ((kFilledSide + 4) * 1024)) / 1024;
    };
    const auto component = [&] { return random() % 8 ? static_cast<double>(random() % 2001) - 1000 : 0.0; };
    return {.origin = {coordinate(corner.x), coordinate(corner.y), coordinate(corner.z)},
            .direction = {component(), component(), component()}};
}

struct Span {
    double enter = -1e300, leave = 1e300;
};

// The part of the ray inside a selection box, in coordinates relative to `corner`.
Span insideBox(const Ray& ray, BlockPos corner, BlockPos block, const Box& box) {
    Span span;
    const glm::dvec3 origin = ray.origin - glm::dvec3(corner.x, corner.y, corner.z);
    const glm::dvec3 direction = glm::normalize(ray.direction);
    const std::array<int, 3> cell{block.x - corner.x, block.y - corner.y, block.z - corner.z};
    for (int axis = 0; axis < 3; ++axis) {
        const double low = cell[static_cast<std::size_t>(axis)] + double{box.min[axis]} - origin[axis];
        const double high = cell[static_cast<std::size_t>(axis)] + double{box.max[axis]} - origin[axis];
        if (direction[axis] == 0) {
            if (low > 0 || high < 0) span.leave = -1e300;
            continue;
        }
        span.enter = std::max(span.enter, std::min(low / direction[axis], high / direction[axis]));
        span.leave = std::min(span.leave, std::max(low / direction[axis], high / direction[axis]));
    }
    return span;
}

// Tests every block of the cube for the nearest box that the ray enters, without code of castRay().
std::optional<RayHit> exhaustive(const World& world, const Ray& ray, BlockPos corner) {
    std::optional<RayHit> nearest;
    for (int i = 0; i < kFilledSide * kFilledSide * kFilledSide; ++i) {
        const BlockPos block{corner.x + i % kFilledSide, corner.y + i / kFilledSide % kFilledSide,
                             corner.z + i / kFilledSide / kFilledSide};
        const BlockType& type = registry().type(world.block(block));
        if (!type.selectable) continue;
        const Span span = insideBox(ray, corner, block, type.selection);
        if (span.enter + 1e-9 >= span.leave || span.leave <= 1e-9) continue;
        const double distance = std::max(span.enter, 0.0);
        if (!nearest || distance < nearest->distance) nearest = RayHit{.block = block, .distance = distance};
    }
    return nearest;
}

// The ray enters in the plane of the reported face.
void expectOnFace(const Ray& ray, BlockPos corner, const World& world, const RayHit& hit) {
    if (hit.distance == 0) return;
    const int axis = hit.face / 2;
    const Box& box = registry().type(world.block(hit.block)).selection;
    const glm::dvec3 block(hit.block.x - corner.x, hit.block.y - corner.y, hit.block.z - corner.z);
    const glm::dvec3 direction = glm::normalize(ray.direction);
    const double at = ray.origin[axis] -
                      (axis == 0   ? corner.x
                       : axis == 1 ? corner.y
                                   : corner.z) +
                      hit.distance * direction[axis];
    EXPECT_NEAR(at, block[axis] + double{hit.face % 2 ? box.max[axis] : box.min[axis]}, 1e-9);
    EXPECT_EQ(hit.face % 2 == 1, direction[axis] < 0) << "faces look against the ray";
}

TEST(RayCast, EqualsLookingAtEveryBlock) {
    std::mt19937 random(1);
    int hits = 0, ties = 0;
    for (const BlockPos corner : {BlockPos{-6, -6, 20}, BlockPos{kLowest, kLowest, 0},
                                  BlockPos{kHighest - kFilledSide + 1, kLowest + 100, 255 - kFilledSide + 1}})
        for (int round = 0; round < 12; ++round) {
            const World world = randomWorld(corner, 1 + round * 2, random);
            for (int i = 0; i < 150; ++i) {
                const Ray ray = randomRay(corner, random);
                if (ray.direction == glm::dvec3(0)) continue;
                const auto hit = castRay(world, registry(), ray, 100);
                const auto expected = exhaustive(world, ray, corner);
                // Rays with small integer components graze edges; a graze may count or not.
                if (hit && (!expected || hit->block != expected->block)) {
                    const Box& box = registry().type(world.block(hit->block)).selection;
                    const Span span = insideBox(ray, corner, hit->block, box);
                    const bool graze = span.leave - std::max(span.enter, 0.0) < 1e-8;
                    ASSERT_TRUE(graze || (expected && std::abs(hit->distance - expected->distance) < 1e-9));
                    ++ties;
                    continue;
                }
                ASSERT_EQ(hit.has_value(), expected.has_value());
                if (!hit) continue;
                ASSERT_NEAR(hit->distance, expected->distance, 1e-9);
                expectOnFace(ray, corner, world, *hit);
                ++hits;
            }
        }
    EXPECT_GT(hits, 1000);
    EXPECT_LT(ties, hits / 100);
}

// Walks in small steps until a point lies in a selection box.
std::optional<RayHit> stepping(const World& world, const Ray& ray, double maxDistance, double step) {
    const glm::dvec3 direction = glm::normalize(ray.direction);
    for (double distance = 0; distance <= maxDistance; distance += step) {
        const glm::dvec3 point = ray.origin + distance * direction, cell = glm::floor(point);
        const BlockPos block{static_cast<std::int32_t>(cell.x), static_cast<std::int32_t>(cell.y),
                             static_cast<std::int32_t>(cell.z)};
        const BlockType& type = registry().type(world.block(block));
        const glm::dvec3 inside = point - cell, min(type.selection.min), max(type.selection.max);
        if (type.selectable && glm::all(glm::lessThanEqual(min, inside)) &&
            glm::all(glm::lessThan(inside, max)))
            return RayHit{.block = block, .distance = distance};
    }
    return std::nullopt;
}

// Stepping can miss a corner that is shorter than a step, but never finds an earlier hit.
TEST(RayCast, EqualsStepping) {
    constexpr double kStep = 1 / 512.0, kReach = 16;
    const BlockPos corner{-6, -6, 20};
    std::mt19937 random(2);
    int hits = 0, missed = 0;
    for (int round = 0; round < 10; ++round) {
        const World world = randomWorld(corner, 2 + round * 2, random);
        for (int i = 0; i < 80; ++i) {
            const Ray ray = randomRay(corner, random);
            if (ray.direction == glm::dvec3(0)) continue;
            const auto hit = castRay(world, registry(), ray, kReach);
            const auto seen = stepping(world, ray, kReach, kStep);
            if (seen) {
                ASSERT_TRUE(hit);
                ASSERT_LE(hit->distance, seen->distance + 1e-9);
            }
            if (hit && seen && hit->block == seen->block) {
                ASSERT_NEAR(hit->distance, seen->distance, kStep + 1e-9);
                ++hits;
            } else if (hit) {
                const Box& box = registry().type(world.block(hit->block)).selection;
                const Span span = insideBox(ray, corner, hit->block, box);
                ASSERT_LE(std::min(span.leave, kReach) - std::max(span.enter, 0.0), kStep + 1e-9);
                ++missed;
            }
        }
    }
    EXPECT_GT(hits, 100);
    EXPECT_LE(missed, 2 + hits / 50);
}

}  // namespace
}  // namespace terrane::world
