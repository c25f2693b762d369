// The surfaces along rays against the quads of the mesher, and against shapes whose surfaces are known.

#include "terrane/rays/surfaces.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "terrane/mesh/shape_faces.h"
#include "tests/mesh/random_blocks.h"
#include "tests/support/depth.h"

namespace terrane::rays {
namespace {

using mesh::idOf, mesh::testBlocks;

constexpr world::Heights kHeights{0, 64};

// A chunk as a scene, with those beside for the rules of its borders.
struct DrawnArea {
    explicit DrawnArea(const mesh::Area& area) : area_(area), cells_(makeScene(area.center.heights(), 1, 4)) {
        setTile(cells_, {0, 0}, buildColumn(area.center, drawnBlocks(testBlocks())));
        scene.cells = raysThrough(cells_);
        scene.blocks = scene.farBlocks = &testBlocks();
        scene.shapeFaces = mesh::shapeFaces(testBlocks());
        scene.chunkAt = [this](world::ChunkPos pos) -> const world::Chunk* {
            if (pos == world::ChunkPos{0, 0}) return &area_.center;
            if (pos.x * pos.x + pos.y * pos.y != 1) return nullptr;
            return &area_.beside[static_cast<std::size_t>(pos.x != 0 ? pos.x > 0 : 2 + (pos.y > 0))];
        };
    }
    DrawnArea(const DrawnArea&) = delete;

    std::vector<Surface> surfaces(const shared::Ray& ray) const {
        std::vector<Surface> all;
        forEachSurface(scene, ray, [&](const Surface& surface) {
            all.push_back(surface);
            return false;
        });
        return all;
    }

    SurfaceScene scene;

  private:
    const mesh::Area& area_;
    Scene cells_;
};

// A surface of a quad.
struct QuadHit {
    double t;
    unsigned shapeFace, material;
};

// A quad of a mesh in blocks.
struct PlacedQuad {
    std::array<glm::dvec3, 4> corners;  // (0, 0), (1, 0), (0, 1), (1, 1)
    unsigned shapeFace, material;
    bool isTwoSided;
};

std::vector<PlacedQuad> quadsOf(const mesh::Area& area, std::span<const shared::ShapeFace> shapes) {
    std::vector<PlacedQuad> quads;
    const mesh::ChunkMesh made = mesh::meshOf(area);
    for (const mesh::MeshSection& section : made.meshSections) {
        const std::uint32_t first = mesh::firstQuad(section);
        for (std::uint32_t k = first; k < first + mesh::quadCount(section); ++k) {
            const shared::Quad quad = made.quads[k];
            PlacedQuad placed{.corners = {},
                              .shapeFace = quadShapeFace(quad),
                              .material = quadMaterial(quad),
                              .isTwoSided = false};
            const shared::ShapeFace& shape = shapes[placed.shapeFace];
            placed.isTwoSided = testBlocks().materials()[placed.material].twoSided || isTwoSidedFace(shape);
            const shared::vec4 cell(quadX(quad), quadY(quad),
                                    static_cast<int>(quadZ(quad)) + quadBase(section), 0);
            for (unsigned n = 0; n < 4; ++n) {
                placed.corners[n] = shared::shapeFaceCorner(shape, cell, glm::vec2(n & 1, n >> 1),
                                                            glm::vec2(quadExtentU(quad), quadExtentV(quad)));
            }
            quads.push_back(placed);
        }
    }
    return quads;
}

// Where a line meets the plane of a quad, and whether that is inside of all edges.
std::optional<double> hitQuad(const PlacedQuad& quad, const glm::dvec3& origin, const glm::dvec3& direction) {
    const std::array<glm::dvec3, 4> around{quad.corners[0], quad.corners[1], quad.corners[3],
                                           quad.corners[2]};
    const glm::dvec3 normal = glm::cross(around[2] - around[0], around[3] - around[1]);
    const double along = glm::dot(normal, direction);
    if (along == 0 || (along > 0 && !quad.isTwoSided)) return std::nullopt;
    const double t = glm::dot(normal, around[0] - origin) / along;
    const glm::dvec3 at = origin + direction * t;
    for (std::size_t n = 0; n < 4; ++n) {
        const glm::dvec3 edge = around[(n + 1) % 4] - around[n];
        if (glm::dot(glm::cross(edge, at - around[n]), normal) < -1e-9) return std::nullopt;
    }
    return t;
}

std::vector<QuadHit> hitQuads(const std::vector<PlacedQuad>& quads, const shared::Ray& ray, double end) {
    glm::dvec3 origin, direction;
    for (int axis = 0; axis < 3; ++axis) {
        const bool isMirrored = ray.mirror[axis] != 0;
        origin[axis] = (ray.cell[axis] ^ ray.mirror[axis]) +
                       (isMirrored ? 1.0 - double{ray.start[axis]} : double{ray.start[axis]});
        direction[axis] = (isMirrored ? -1.0 : 1.0) * double{ray.direction[axis]};
    }
    std::vector<QuadHit> hits;
    for (const PlacedQuad& quad : quads) {
        const std::optional<double> t = hitQuad(quad, origin, direction);
        if (t && *t >= 0 && *t <= end) hits.push_back({*t, quad.shapeFace, quad.material});
    }
    std::sort(hits.begin(), hits.end(), [](const QuadHit& a, const QuadHit& b) { return a.t < b.t; });
    return hits;
}

// From inside of the chunk or above it: meshes leave out the bottom of the world.
shared::Ray anyRay(std::mt19937& random) {
    std::uniform_real_distribution<float> unit(0, 1);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    return shared::makeRay({below(16), below(16), below(70), 0},
                           {unit(random), unit(random), unit(random), 0},
                           {unit(random) - .5f, unit(random) - .5f, unit(random) - .5f, 0}, 1e6f);
}

// The surfaces of both, in the same order; those at one place may be exchanged.
std::string difference(const std::vector<QuadHit>& quads, const std::vector<Surface>& surfaces) {
    if (quads.size() != surfaces.size())
        return fmt::format("{} quads, {} surfaces", quads.size(), surfaces.size());
    for (std::size_t k = 0; k < quads.size(); ++k) {
        const bool isFound = std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface& surface) {
            return surface.face.shapeFace == quads[k].shapeFace &&
                   surface.face.material == quads[k].material &&
                   std::abs(double{surface.t} - quads[k].t) < 1e-4 * (1 + quads[k].t);
        });
        if (!isFound || std::abs(double{surfaces[k].t} - quads[k].t) > 1e-4 * (1 + quads[k].t))
            return fmt::format("at {}: shape face {}, material {}", quads[k].t, quads[k].shapeFace,
                               quads[k].material);
    }
    return "";
}

TEST(SurfacesTest, RaysMeetTheQuadsOfMeshes) {
    std::mt19937 random(1);
    const StopTable cubes =
        stopTable(testBlocks(), [](const world::BlockType& type) { return type.opaqueCube; });
    std::size_t met = 0;
    for (int k = 0; k < static_cast<int>(mesh::Mix::Count) * atDepth(1, 8); ++k) {
        const auto mix = static_cast<mesh::Mix>(k % static_cast<int>(mesh::Mix::Count));
        const auto seed = static_cast<unsigned>(k);
        mesh::Area area(mesh::randomBlocks(mix, seed), kHeights);
        area.addBlockState(seed);
        if (k % 2 == 0) area.addFlow(seed);
        const DrawnArea drawn(area);
        Scene opaque = makeScene(kHeights, 1, 4);
        setTile(opaque, {0, 0}, buildColumn(area.center, cubes));
        const std::vector<PlacedQuad> quads = quadsOf(area, drawn.scene.shapeFaces);
        for (int n = 0; n < 300; ++n) {
            const shared::Ray ray = anyRay(random);
            const shared::RayHit end = shared::castRay(raysThrough(opaque), ray);
            if (end.face == shared::kRayFaceNone) continue;
            const double t = end.face == shared::kRayMiss ? 1e6 : double{end.t} * (1 + 1e-6) + 1e-6;
            const std::vector<Surface> surfaces = drawn.surfaces(ray);
            met += surfaces.size();
            ASSERT_EQ(difference(hitQuads(quads, ray, t), surfaces), "")
                << "mix " << k << ", ray " << n << " from " << (ray.cell.x ^ ray.mirror.x) << ","
                << (ray.cell.y ^ ray.mirror.y) << "," << (ray.cell.z ^ ray.mirror.z);
        }
    }
    EXPECT_GT(met, 5'000u);
}

shared::Ray rayFrom(glm::dvec3 origin, glm::vec3 direction) {
    const glm::dvec3 cell = glm::floor(origin);
    return shared::makeRay(glm::ivec4(cell, 0), glm::vec4(origin - cell, 0), glm::vec4(direction, 0), 1e6f);
}

TEST(SurfacesTest, LiquidsLieLower) {
    const mesh::Area area = mesh::placed({{5, 5, 10, "water"}, {5, 5, 9, "water"}, {5, 5, 8, "stone"}});
    const DrawnArea drawn(area);
    const auto down = drawn.surfaces(rayFrom({5.5, 5.5, 20}, {0, 0, -1}));
    ASSERT_EQ(down.size(), 2u);
    EXPECT_EQ(down[0].face.shapeFace, shared::kShapeFaceLiquidTop);
    EXPECT_NEAR(down[0].t, 20 - (10 + 14.0 / 16), 1e-5);
    EXPECT_EQ(down[1].face.shapeFace, shared::kShapeFaceCube + world::kFacePosZ);  // of the stone
    EXPECT_NEAR(down[1].t, 11, 1e-5);
}

TEST(SurfacesTest, PlantsAreCrossedTwice) {
    const mesh::Area area = mesh::placed({{5, 5, 10, "tuft"}});
    const DrawnArea drawn(area);
    const auto across = drawn.surfaces(rayFrom({0, 5.4, 10.25}, {1, 0, 0}));
    ASSERT_EQ(across.size(), 2u);
    EXPECT_NEAR(across[0].t, 5.4, 1e-5);
    EXPECT_NEAR(across[1].t, 5.6, 1e-5);
    for (const Surface& surface : across)
        EXPECT_NEAR(surface.texel.y, .75f, 1e-5) << "a quarter above the ground";
    EXPECT_TRUE(drawn.surfaces(rayFrom({0, 5.1, 10.25}, {1, 0, 0})).empty()) << "beside the planes";
}

// Texture coordinates of cubes are those of their faces in the table.
TEST(SurfacesTest, CubesHaveTheirTexture) {
    const mesh::Area area = mesh::placed({{5, 5, 10, "stone"}});
    const DrawnArea drawn(area);
    const glm::dvec3 middle{5.5, 5.5, 10.5};
    for (int side = 0; side < world::kFaceCount; ++side) {
        glm::vec3 direction(0);
        direction[side / 2] = side % 2 == 0 ? 1.f : -1.f;
        glm::dvec3 aside(.2, .3, .1);
        aside[side / 2] = 0;
        const auto met = drawn.surfaces(rayFrom(middle + aside - 3.0 * glm::dvec3(direction), direction));
        ASSERT_EQ(met.size(), 1u) << side;
        EXPECT_EQ(met[0].face.shapeFace, shared::kShapeFaceCube + static_cast<unsigned>(side));
        EXPECT_NEAR(met[0].t, 2.5, 1e-5);
        const shared::ShapeFace& shape = drawn.scene.shapeFaces[met[0].face.shapeFace];
        const glm::vec3 low(shared::shapeFaceCorner(shape, glm::vec4(0), {0, 0}, {1, 1}));
        const glm::vec3 at = glm::vec3(aside) + .5f - low;
        const glm::vec2 corner{glm::dot(at, glm::vec3(shape.axisU)), glm::dot(at, glm::vec3(shape.axisV))};
        EXPECT_NEAR(met[0].texel.x, corner.x, 1e-5) << side;
        EXPECT_NEAR(met[0].texel.y, 1 - corner.y, 1e-5) << side;
    }
}

TEST(SurfacesTest, TheFirstOneThatStopsEndsTheRay) {
    const mesh::Area area = mesh::placed({{3, 5, 10, "glass"}, {5, 5, 10, "tuft"}, {8, 5, 10, "stone"}});
    const DrawnArea drawn(area);
    int passed = 0;
    forEachSurface(drawn.scene, rayFrom({0, 5.4, 10.25}, {1, 0, 0}),
                   [&](const Surface&) { return ++passed == 3; });
    EXPECT_EQ(passed, 3) << "two sides of the glass, a plane of the plant";
    EXPECT_EQ(drawn.surfaces(rayFrom({0, 5.4, 10.25}, {1, 0, 0})).size(), 5u);
    EXPECT_TRUE(drawn.surfaces(rayFrom({8.5, 5.5, 10.5}, {1, 0, 0})).empty()) << "from inside of a cube";
}

}  // namespace
}  // namespace terrane::rays
