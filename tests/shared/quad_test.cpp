#include "terrane/shared/quad.h"

#include <gtest/gtest.h>

#include <random>

namespace terrane::shared {
namespace {

void expectRoundTrip(const QuadFields& f) {
    const Quad q = packQuad(f);
    EXPECT_EQ(quadX(q), f.x);
    EXPECT_EQ(quadY(q), f.y);
    EXPECT_EQ(quadZ(q), f.z);
    EXPECT_EQ(quadShapeFace(q), f.shapeFace);
    EXPECT_EQ(quadExtentU(q), f.extentU);
    EXPECT_EQ(quadExtentV(q), f.extentV);
    EXPECT_EQ(quadMaterial(q), f.material);
}

// Every combination of each field's lowest and highest value: no field reaches into another.
TEST(Quad, RoundTripOfExtremes) {
    for (uint bits = 0; bits < 128; ++bits) {
        const auto pick = [&](uint bit, uint low, uint high) { return bits >> bit & 1u ? high : low; };
        expectRoundTrip({.x = pick(0, 0, 15),
                         .y = pick(1, 0, 15),
                         .z = pick(2, 0, 255),
                         .shapeFace = pick(3, 0, 2047),
                         .extentU = pick(4, 1, 16),
                         .extentV = pick(5, 1, 16),
                         .material = pick(6, 0, 65535)});
    }
}

TEST(Quad, RoundTripOfRandomFields) {
    std::mt19937 random(1);
    const auto below = [&](uint limit) { return static_cast<uint>(random() % limit); };
    for (int i = 0; i < 10000; ++i)
        expectRoundTrip({.x = below(16),
                         .y = below(16),
                         .z = below(256),
                         .shapeFace = below(2048),
                         .extentU = 1 + below(16),
                         .extentV = 1 + below(16),
                         .material = below(65536)});
}

TEST(Quad, KnownWords) {
    const Quad q =
        packQuad({.x = 1, .y = 2, .z = 3, .shapeFace = 4, .extentU = 6, .extentV = 7, .material = 8});
    EXPECT_EQ(q, (Quad{0x65040321u, 0x00000008u}));
    EXPECT_FALSE(q == (Quad{0x65040321u, 0x00000009u}));
}

static_assert(quadZ(packQuad({.x = 0, .y = 0, .z = 255, .shapeFace = 0})) == 255,
              "packing works at compile time");

}  // namespace
}  // namespace terrane::shared
