// Tests quads for visibility on vector units, by the rules of culling.h. Pure functions; any thread may use
// them.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "terrane/shared/culling.h"

namespace terrane::render {

// Hi-Z in memory: the farthest depths of squares of pixels, level after level from the finest, by y, then x.
struct DepthPyramid {
    struct Level {
        std::int32_t first = 0;  // its first texel
        glm::ivec2 size{0};
    };
    std::vector<Level> levels;
    std::vector<float> texels;

    // Makes room for an image whose finest level has `finest` texels.
    void resize(glm::ivec2 finest);
    // Computes all levels from the finest.
    void build();
    float farthestIn(const shared::HiZArea& area) const;
};

// What the test of a quad reads, beside the quad.
struct QuadTest {
    shared::CullView view;
    const DepthPyramid* pyramid;
    std::span<const shared::ShapeFace> shapeFaces;
    std::span<const std::uint32_t> isWaving;  // by material
    bool isTwoSided = false;                  // see footprintOfQuad()
    glm::vec3 slabCorner{0};
    float columnWidth = 1;
};

struct QuadTestResult {
    std::uint32_t newQuads = 0;
    bool isAnySeen = false;
};

// Sets the bits *seen* and *new* (cull_pass.h) of quads first … first + count − 1 of an arena. Writes the
// numbers of the new ones to `out`, in their order; it has room for count + kQuadLanes. `isDrawnEarly`: the
// early pass drew those that were seen.
constexpr std::uint32_t kQuadLanes = 16;
QuadTestResult testQuads(const QuadTest& test, std::span<shared::Quad> arena, std::uint32_t first,
                         std::uint32_t count, bool isDrawnEarly, std::uint32_t* out);

// Writes the numbers of the quads that were seen to `out`, as testQuads() does, and returns how many there
// are.
std::uint32_t listSeen(std::span<const shared::Quad> arena, std::uint32_t first, std::uint32_t count,
                       std::uint32_t* out);

}  // namespace terrane::render
