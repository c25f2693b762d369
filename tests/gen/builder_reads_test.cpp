// Reads of passes: fields of earlier passes, here and at offsets across chunks, blocks, random numbers.
#include <gtest/gtest.h>
#include <xxhash.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "terrane/shared/hash.h"
#include "tests/gen/gen_fixture.h"

namespace terrane::gen {
namespace {

using std::int32_t;
using std::int64_t;

// A number that no two columns near each other share.
Int mix(Int x, Int y) {
    return ((x * 7919 + y * 104729) >> 3) & 0x3FFF;
}
int32_t mix(int64_t x, int64_t y) {
    return (wrapped(x * 7919 + y * 104729) >> 3) & 0x3FFF;
}

TEST(BuilderReads, FieldsOfAllTypes) {
    expectBlocks(
        [](GeneratorBuilder& g) {
            const auto whole = g.field<Int>("whole");
            const auto part = g.field<Float>("part");
            const auto isEven = g.field<Bool>("is even");
            const auto soil = g.field<Block>("soil");
            g.pass2D("first", [&](Pass& p) {
                p.set(whole, mix(p.x(), p.y()));
                p.set(isEven, (p.x() & 1) == 0);
            });
            g.pass2D("second", [&](Pass& p) {
                p.set(part, Float(p.read(whole)) * 0.5f);
                p.set(soil, select(p.read(isEven), p.block("stone"), p.block("dirt")));
            });
            g.pass3D("blocks", [&](Pass& p) {
                const Block high = Block(Int(p.read(part) * 2.0f) + p.z());
                p.setBlock(select(p.z() < 100, p.read(soil), high));
            });
        },
        [](int32_t x, int32_t y, int32_t z) {
            if (z < 100) return x % 2 == 0 ? 1 : 2;
            return mix(x, y) + z;
        });
}

TEST(BuilderReads, FieldsSetInBranches) {
    expectBlocks(
        [](GeneratorBuilder& g) {
            const auto f = g.field<Int>("f"), never = g.field<Int>("never taken");
            g.pass2D("columns", [&](Pass& p) {
                p.if_((p.x() & 3) == 1, [&] { p.set(f, p.y() & 31); });
                p.if_((p.x() & 3) == 2, [&] { p.set(f, Int(77)); });
                p.if_(p.x() < p.x(), [&] { p.set(never, Int(5)); });
            });
            g.pass3D("blocks", [&](Pass& p) { p.setBlock(Block(p.read(f) + p.read(never) * 100)); });
        },
        [](int32_t x, int32_t y, int32_t) {
            if ((x & 3) == 1) return y & 31;
            return (x & 3) == 2 ? 77 : 0;
        });
}

// Beyond the edge of the world coordinates wrap.
TEST(BuilderReads, FieldsAtFixedOffsets) {
    expectBlocks(
        [](GeneratorBuilder& g) {
            const auto f = g.field<Int>("f"), sum = g.field<Int>("sum");
            g.pass2D("first", [&](Pass& p) { p.set(f, mix(p.x(), p.y())); });
            g.pass2D("second", [&](Pass& p) {
                p.set(sum, p.readAt(f, {1, 0}) + p.readAt(f, {-1, 0}) * 3 + p.readAt(f, {0, 16}) * 5 +
                               p.readAt(f, {-16, -16}) * 7 + p.readAt(f, {16, -16}) * 11 + p.read(f));
            });
            g.pass3D("blocks", [&](Pass& p) {
                p.setBlock(Block(p.read(sum) + p.readAt(f, {-5, 12}) * p.z()));
            });
        },
        [](int64_t x, int64_t y, int32_t z) {
            return mix(x + 1, y) + mix(x - 1, y) * 3 + mix(x, y + 16) * 5 + mix(x - 16, y - 16) * 7 +
                   mix(x + 16, y - 16) * 11 + mix(x, y) + mix(x - 5, y + 12) * z;
        });
}

// Offsets that are computed, by column and by voxel; what is larger than 16 is clamped.
TEST(BuilderReads, FieldsAtComputedOffsets) {
    expectBlocks(
        [](GeneratorBuilder& g) {
            const auto f = g.field<Int>("f");
            g.pass2D("columns", [&](Pass& p) { p.set(f, mix(p.x(), p.y())); });
            g.pass3D("blocks", [&](Pass& p) {
                const Int dx = (mix(p.x(), p.y()) & 63) - 32, dy = p.z() - 128;
                p.setBlock(
                    Block(p.readAt(f, {dx, dy}) + p.readAt(f, {dy, Int(3)}) * 3 + p.readAt(f, {-3, dx})));
            });
        },
        [](int64_t x, int64_t y, int32_t z) {
            const int32_t dx = std::clamp((mix(x, y) & 63) - 32, -16, 16), dy = std::clamp(z - 128, -16, 16);
            return mix(x + dx, y + dy) + mix(x + dy, y + 3) * 3 + mix(x - 3, y + dx);
        });
}

// Each pass looks 16 blocks farther: the third reads what was computed three chunks away.
TEST(BuilderReads, OffsetsOfSeveralPassesAddUp) {
    expectBlocks(
        [](GeneratorBuilder& g) {
            const auto a = g.field<Int>("a"), b = g.field<Int>("b"), c = g.field<Int>("c");
            g.pass2D("a", [&](Pass& p) { p.set(a, mix(p.x(), p.y())); });
            g.pass2D("b", [&](Pass& p) { p.set(b, p.readAt(a, {16, 0}) + p.readAt(a, {0, -16})); });
            g.pass2D("c", [&](Pass& p) { p.set(c, p.readAt(b, {16, 16}) + p.readAt(a, {-16, 2})); });
            g.pass3D("blocks", [&](Pass& p) {
                p.setBlock(Block(p.readAt(c, {16, -16}) + p.readAt(b, {-1, 1})));
            });
        },
        [](int64_t x, int64_t y, int32_t) {
            const auto b = [](int64_t px, int64_t py) { return mix(px + 16, py) + mix(px, py - 16); };
            const auto c = [&](int64_t px, int64_t py) { return b(px + 16, py + 16) + mix(px - 16, py + 2); };
            return c(x + 16, y - 16) + b(x - 1, y + 1);
        });
}

TEST(BuilderReads, BlocksOfTheEarlier3DPass) {
    expectBlocks(
        [](GeneratorBuilder& g) {
            const auto top = g.field<Int>("top");
            g.pass3D("first", [](Pass& p) { p.setBlock(Block((p.x() & 255) * 3 + p.z())); });
            g.pass3D("second", [](Pass& p) {
                p.if_((p.z() & 7) == 0,
                      [&] { p.setBlock(Block(select(p.blockHere() == Block(90), Int(1), Int(2)))); });
            });
            g.pass2D("between", [&](Pass& p) {
                const Block found = p.blockInColumn(p.y() & 255);
                p.set(top, select(found == Block(2), Int(1000), Int(2000)));
            });
            g.pass3D("third",
                     [&](Pass& p) { p.setBlock(select(p.z() > 250, Block(p.read(top)), p.blockHere())); });
        },
        [](int32_t x, int32_t y, int32_t z) {
            const auto second = [&](int32_t layer) {
                const int32_t first = (x & 255) * 3 + layer;
                if (layer % 8 != 0) return first;
                return first == 90 ? 1 : 2;
            };
            if (z > 250) return second(y & 255) == 2 ? 1000 : 2000;
            return second(z);
        });
}

// z is absolute and clamped into the world.
TEST(BuilderReads, BlocksInTheColumn) {
    expectBlocks(
        [&](GeneratorBuilder& g) {
            g.pass3D("first", [](Pass& p) { p.setBlock(Block((p.x() & 15) * 20 + (p.z() >> 4))); });
            g.pass3D("second", [&](Pass& p) {
                const Int below(p.blockInColumn(p.z() - 40)), above(p.blockInColumn(p.z() + 40));
                p.setBlock(Block(below * 100 + above));
            });
        },
        [](int32_t x, int32_t, int32_t z) {
            const auto first = [&](int32_t layer) {
                return (x & 15) * 20 + (std::clamp(layer, 0, 255) >> 4);
            };
            return first(z - 40) * 100 + first(z + 40);
        });
}

// Offsets are clamped to 16 blocks, heights into the world.
TEST(BuilderReads, BlocksOfOtherColumns) {
    expectBlocks(
        [](GeneratorBuilder& g) {
            g.pass3D("first", [](Pass& p) { p.setBlock(Block(mix(p.x(), p.y()) + p.z())); });
            g.pass3D("second", [](Pass& p) {
                const Int dx = (mix(p.x(), p.y()) & 63) - 32, dy = p.z() - 128;
                const Int computed(p.blockAt({dx, dy}, p.z() * 2)), fixed(p.blockAt({-16, 3}, 7));
                p.setBlock(Block(computed * 3 + fixed));
            });
        },
        [](int64_t x, int64_t y, int32_t z) {
            const int32_t dx = std::clamp((mix(x, y) & 63) - 32, -16, 16), dy = std::clamp(z - 128, -16, 16);
            const auto first = [](int64_t px, int64_t py, int32_t pz) {
                return static_cast<std::uint16_t>(mix(px, py) + std::clamp(pz, 0, 255));
            };
            return first(x + dx, y + dy, z * 2) * 3 + first(x - 16, y + 3, 7);
        });
}

// Later passes read the value that a 3D pass wrote at one height of each column, also in neighboring chunks.
TEST(BuilderReads, FieldsWrittenBy3DPasses) {
    expectBlocks(
        [](GeneratorBuilder& g) {
            const auto found = g.field<Int>("found"), low = g.field<Int>("low");
            g.pass3D("first", [&](Pass& p) {
                p.setBlock(Block(p.z() * 5 + p.x()));
                p.setAt(found, p.y() & 255, p.z() * 3 + p.x());
                p.setAt(low, -9, p.z() + 70);
            });
            g.pass2D("between", [&](Pass&) {});
            g.pass3D("second", [&](Pass& p) {
                p.setBlock(Block(p.readAt(found, {5, -16}) + p.read(found) * 7 + p.read(low) * p.z()));
            });
        },
        [](int64_t x, int64_t y, int32_t z) {
            const auto found = [](int64_t px, int64_t py) { return wrapped((py & 255) * 3 + px); };
            return wrapped(std::int64_t{found(x + 5, y - 16)} + std::int64_t{found(x, y)} * 7 + 70 * z);
        });
}

// Worlds depend on how names become seeds: the lower half of XXH3 of kind and name, seeded with the world's.
std::uint32_t randomSeed(const std::string& name, std::uint64_t worldSeed) {
    const std::string text = "random " + name;
    return static_cast<std::uint32_t>(XXH3_64bits_withSeed(text.data(), text.size(), worldSeed));
}

TEST(BuilderReads, RandomNumbersByPosition) {
    const std::uint32_t flat = randomSeed("flat", kTestSeed), solid = randomSeed("solid", kTestSeed);
    expectNumbers(
        [](Pass& p) {
            const Float a = p.random2D("flat", p.x(), p.y()), b = p.random3D("solid", p.x(), p.y(), p.z());
            const Float c = p.random2D("flat", p.x() + 16, p.y() - p.z()), d = p.random3D("solid", 1, 2, 3);
            return Int(a * 0x1p14f) + Int(b * 0x1p13f) * 3 + Int(c * 0x1p12f) * 5 + Int(d * 100.0f);
        },
        [&](int32_t x, int32_t y, int32_t z) {
            const auto u = [](int32_t v) { return static_cast<std::uint32_t>(v); };
            const auto part = [](std::uint32_t h, int bits) {
                return static_cast<int32_t>(h >> (32 - bits));
            };
            const float d = static_cast<float>(shared::hash3(1, 2, 3, solid) >> 8) * 0x1p-24f;
            return part(shared::hash2(u(x), u(y), flat), 14) +
                   part(shared::hash3(u(x), u(y), u(z), solid), 13) * 3 +
                   part(shared::hash2(u(x) + 16, u(y) - u(z), flat), 12) * 5 +
                   static_cast<int32_t>(d * 100.0f);
        });
}

TEST(BuilderReads, RandomNumbersLieBelowOne) {
    expectNumbers(
        [](Pass& p) {
            const Float r = p.random3D("r", p.x(), p.y(), p.z());
            return select(r >= 0.0f && r < 1.0f, Int(1), Int(0));
        },
        [](int32_t, int32_t, int32_t) { return 1; });
}

}  // namespace
}  // namespace terrane::gen
