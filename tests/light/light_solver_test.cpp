#include "terrane/light/light_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>

#include "terrane/shared/hash.h"
#include "tests/light/content_blocks.h"

namespace terrane::light {
namespace {

using world::BlockId;
using world::kChunkHeight;
using world::kChunkSize;

constexpr int kComponents = 4;  // red, green, blue, daylight

// An area filled block by block; x and y count from its corner.
class TestArea {
  public:
    using Source = std::function<BlockId(int x, int y, int z)>;

    TestArea(int chunksX, int chunksY, const Source& source) : chunksX_(chunksX), chunksY_(chunksY) {
        for (int cy = 0; cy < chunksY; ++cy) {
            for (int cx = 0; cx < chunksX; ++cx) chunks_.push_back(makeChunk(cx, cy, source));
        }
    }

    int width() const { return chunksX_ * kChunkSize; }
    int height() const { return chunksY_ * kChunkSize; }
    std::size_t index(int x, int y, int z) const {
        return static_cast<std::size_t>(x + width() * (y + height() * z));
    }
    const world::BlockType& type(int x, int y, int z) const {
        const auto& chunk = chunks_[static_cast<std::size_t>(x / kChunkSize + chunksX_ * (y / kChunkSize))];
        return contentBlocks().type(chunk.block(world::blockIndex(x & 15, y & 15, z)));
    }
    std::vector<LightValue> solve() const {
        LightArea area{chunksX_, chunksY_, {}};
        for (const world::Chunk& chunk : chunks_) area.chunks.push_back(&chunk);
        return solveLight(area, contentBlocks());
    }

  private:
    static world::Chunk makeChunk(int cx, int cy, const Source& source) {
        world::Chunk chunk;
        std::array<BlockId, world::kBlocksPerSection> values;
        for (int section = 0; section < world::kSectionsPerChunk; ++section) {
            for (int i = 0; i < world::kBlocksPerSection; ++i) {
                values[static_cast<std::size_t>(i)] =
                    source(cx * kChunkSize + (i & 15), cy * kChunkSize + ((i >> 4) & 15),
                           section * world::kSectionSize + (i >> 8));
            }
            chunk.setSection(section, world::Section::fromValues(values));
        }
        return chunk;
    }

    int chunksX_, chunksY_;
    std::vector<world::Chunk> chunks_;
};

// Blocks lie below the first height, so that both the ground and the sky are there; no colour reaches the
// second.
constexpr int kFilledHeight = 40;
constexpr int kReferenceHeight = kFilledHeight + 16;

// The formula of light_solver.h, applied to every voxel until nothing changes. A border of darkness that lets
// nothing through stands around the area.
class Reference {
  public:
    explicit Reference(const TestArea& area) : area_(area), row_(area.width() + 2) {
        for (int z = -1; z <= kReferenceHeight; ++z) {
            for (int y = -1; y <= area.height(); ++y) {
                for (int x = -1; x <= area.width(); ++x) addVoxel(x, y, z);
            }
        }
    }

    // Index x + width (y + height z), up to kReferenceHeight.
    std::vector<int> solve(int component) {
        setSources(component);
        while (raiseAll()) continue;
        std::vector<int> result;
        for (const int at : inside_) result.push_back(level_[static_cast<std::size_t>(at)]);
        return result;
    }

  private:
    void addVoxel(int x, int y, int z) {
        const bool isInside =
            x >= 0 && y >= 0 && z >= 0 && x < area_.width() && y < area_.height() && z < kReferenceHeight;
        if (isInside) inside_.push_back(static_cast<int>(types_.size()));
        types_.push_back(isInside ? &area_.type(x, y, z) : nullptr);
    }

    int layer() const { return row_ * (area_.height() + 2); }

    int source(int component, int at) const {
        const auto typeAt = [&](int index) { return types_[static_cast<std::size_t>(index)]; };
        if (component < 3) return typeAt(at)->emission[static_cast<std::size_t>(component)];
        int level = 15;
        for (int above = at; typeAt(above); above += layer()) level -= typeAt(above)->opacity;
        return std::max(0, level);
    }

    void setSources(int component) {
        level_.assign(types_.size(), 0);
        for (const int at : inside_) level_[static_cast<std::size_t>(at)] = source(component, at);
    }

    bool raiseAll() {
        bool changed = false;
        int* const level = level_.data();
        for (const int at : inside_) {
            const int loss = 1 + types_[static_cast<std::size_t>(at)]->opacity;
            for (const int step : {1, row_, layer()}) {
                const int brighter =
                    level[at - step] > level[at + step] ? level[at - step] : level[at + step];
                if (brighter - loss <= level[at]) continue;
                level[at] = brighter - loss;
                changed = true;
            }
        }
        return changed;
    }

    const TestArea& area_;
    int row_;
    std::vector<const world::BlockType*> types_;  // with the border, where they are null
    std::vector<int> inside_;                     // indices of the others
    std::vector<int> level_;
};

int component(LightValue value, int number) {
    return value >> (4 * number) & 15;
}

void expectReference(const TestArea& area) {
    const std::vector<LightValue> light = area.solve();
    ASSERT_EQ(light.size(), area.index(0, 0, kChunkHeight));
    Reference reference(area);
    for (int c = 0; c < kComponents; ++c) {
        const std::vector<int> expected = reference.solve(c);
        for (std::size_t at = 0; at < expected.size(); ++at) {
            ASSERT_EQ(component(light[at], c), expected[at]) << "component " << c << " at index " << at;
        }
    }
    for (std::size_t at = area.index(0, 0, kReferenceHeight); at < light.size(); ++at) {
        ASSERT_EQ(light[at], 15 << 12);
    }
}

BlockId anyBlock(std::uint32_t hash) {
    return static_cast<BlockId>(hash % contentBlocks().types().size());
}

std::uint32_t hashAt(int x, int y, int z, std::uint32_t seed) {
    return shared::hash3(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                         static_cast<std::uint32_t>(z), seed);
}

// One block in `airShare` is not air.
TestArea::Source scattered(std::uint32_t seed, std::uint32_t airShare) {
    return [=](int x, int y, int z) {
        const std::uint32_t hash = hashAt(x, y, z, seed);
        return z < kFilledHeight && hash % airShare == 0 ? anyBlock(hash / airShare) : world::kAir;
    };
}

// Rooms of stone with holes and a few lamps.
TestArea::Source caves(std::uint32_t seed) {
    return [=](int x, int y, int z) {
        const std::uint32_t hash = hashAt(x, y, z, seed);
        if (z >= kFilledHeight) return world::kAir;
        const bool isWall = x % 7 == 0 || y % 6 == 0 || z % 5 == 0;
        if (isWall) return hash % 12 == 0 ? world::kAir : contentBlock("stone");
        return hash % 90 == 0 ? anyBlock(hash / 90) : world::kAir;
    };
}

TestArea::Source layers(std::uint32_t seed) {
    return [=](int x, int y, int z) {
        const std::uint32_t hash = hashAt(x / 5, y / 5, z, seed);
        return z < kFilledHeight && hash % 6 == 0 ? anyBlock(hash / 6) : world::kAir;
    };
}

TEST(LightSolver, EqualsTheFormulaIteratedUntilStable) {
    for (std::uint32_t seed = 0; seed < 3; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        expectReference(TestArea(1, 1, scattered(seed, 1)));
        expectReference(TestArea(1, 1, scattered(seed, 8)));
        expectReference(TestArea(1, 1, layers(seed)));
        expectReference(TestArea(1, 2, caves(seed)));
        expectReference(TestArea(2, 1, scattered(seed, 60)));
        if (HasFailure()) return;
    }
    expectReference(TestArea(2, 2, caves(9)));
}

// Light reaches 15 blocks: what lies beyond the next chunk cannot matter.
TEST(LightSolver, IsExactOneChunkInside) {
    const TestArea::Source world = caves(4);
    const TestArea small(3, 3, [&](int x, int y, int z) { return world(x + 16, y + 16, z); });
    const TestArea large(5, 5, world);
    const std::vector<LightValue> inSmall = small.solve(), inLarge = large.solve();
    for (int z = 0; z < kChunkHeight; ++z) {
        for (int y = 16; y < 32; ++y) {
            for (int x = 16; x < 32; ++x) {
                ASSERT_EQ(inSmall[small.index(x, y, z)], inLarge[large.index(x + 16, y + 16, z)])
                    << x << ' ' << y << ' ' << z;
            }
        }
    }
}

TEST(LightSolver, AirIsDaylightOnly) {
    const TestArea area(1, 1, [](int, int, int) { return world::kAir; });
    for (const LightValue value : area.solve()) ASSERT_EQ(value, 15 << 12);
}

// A layer of one block over the whole area, so that nothing comes from the side.
int daylightBelow(std::string_view name, int layers) {
    const BlockId id = contentBlock(name);
    const TestArea area(1, 1, [&](int, int, int z) { return z >= 50 && z < 50 + layers ? id : world::kAir; });
    const std::vector<LightValue> light = area.solve();
    EXPECT_EQ(component(light[area.index(7, 7, 50 + layers)], 3), 15) << name << " above";
    EXPECT_EQ(component(light[area.index(7, 7, 0)], 3), component(light[area.index(7, 7, 49)], 3))
        << name << ": nothing is lost with distance straight down";
    return component(light[area.index(7, 7, 49)], 3);
}

TEST(LightSolver, DaylightLosesTheOpacitiesOfItsColumn) {
    EXPECT_EQ(daylightBelow("stone", 1), 0);
    EXPECT_EQ(daylightBelow("lamp_red", 1), 0);
    EXPECT_EQ(daylightBelow("water", 1), 14);
    EXPECT_EQ(daylightBelow("water", 9), 6);
    EXPECT_EQ(daylightBelow("water", 20), 0);
    EXPECT_EQ(daylightBelow("oak_leaves", 2), 9);
    EXPECT_EQ(daylightBelow("cyan_glass", 4), 3);
    EXPECT_EQ(daylightBelow("cactus", 1), 4);
    EXPECT_EQ(daylightBelow("wheat", 1), 11);
    EXPECT_EQ(daylightBelow("glowing_mushroom", 3), 15);
}

TEST(LightSolver, DaylightFadesUnderARoof) {
    const BlockId stone = contentBlock("stone");
    const TestArea area(2, 1, [&](int x, int, int z) { return z == 60 && x >= 8 ? stone : world::kAir; });
    const std::vector<LightValue> light = area.solve();
    for (int x = 0; x < 32; ++x) {
        EXPECT_EQ(component(light[area.index(x, 5, 30)], 3), x < 8 ? 15 : std::max(0, 15 - (x - 7))) << x;
    }
}

// One lamp in the middle of 2 × 2 chunks, in `medium`.
struct LampLight {
    LampLight(std::string_view lamp, std::string_view medium)
        : area(2, 2,
               [&](int x, int y, int z) {
                   if (x == 16 && y == 16 && z == 100) return contentBlock(lamp);
                   return medium.empty() ? world::kAir : contentBlock(medium);
               }),
          light(area.solve()) {}

    std::array<int, 3> at(int dx, int dy, int dz) const {
        const LightValue value = light[area.index(16 + dx, 16 + dy, 100 + dz)];
        return {component(value, 0), component(value, 1), component(value, 2)};
    }

    TestArea area;
    std::vector<LightValue> light;
};

using Colour = std::array<int, 3>;

TEST(LightSolver, LampFallsOffByOneABlock) {
    const LampLight white("lamp_white", "");
    EXPECT_EQ(white.at(0, 0, 0), (Colour{15, 13, 13}));
    EXPECT_EQ(white.at(1, 0, 0), (Colour{14, 12, 12}));
    EXPECT_EQ(white.at(-3, 0, 0), (Colour{12, 10, 10}));
    EXPECT_EQ(white.at(2, -3, 4), (Colour{6, 4, 4}));
    EXPECT_EQ(white.at(0, 0, 13), (Colour{2, 0, 0}));
    EXPECT_EQ(white.at(0, -14, 0), (Colour{1, 0, 0}));
    EXPECT_EQ(white.at(7, 0, -8), (Colour{0, 0, 0}));
    EXPECT_EQ(LampLight("lamp_green", "").at(0, 5, 0), (Colour{0, 10, 0}));
    EXPECT_EQ(LampLight("lamp_blue", "").at(0, 0, -5), (Colour{0, 0, 10}));
    EXPECT_EQ(LampLight("glowing_mushroom", "").at(1, 1, 0), (Colour{3, 8, 6}));
}

TEST(LightSolver, LampFallsOffByOpacityAsWell) {
    const LampLight inWater("lamp_red", "water");
    for (int d = 0; d < 15; ++d) EXPECT_EQ(inWater.at(d, 0, 0), (Colour{std::max(0, 15 - 2 * d), 0, 0}));
    EXPECT_EQ(LampLight("lamp_red", "oak_leaves").at(0, 3, 0), (Colour{3, 0, 0}));
    EXPECT_EQ(LampLight("lamp_red", "stone").at(1, 0, 0), (Colour{0, 0, 0}));
}

TEST(LightSolver, ColoursDoNotMix) {
    const TestArea area(2, 1, [](int x, int y, int z) {
        if (y != 8 || z != 100) return world::kAir;
        return x == 8 ? contentBlock("lamp_red") : x == 18 ? contentBlock("lamp_blue") : world::kAir;
    });
    const std::vector<LightValue> light = area.solve();
    EXPECT_EQ(light[area.index(13, 8, 100)], 15 << 12 | 10 << 8 | 10);
    EXPECT_EQ(light[area.index(9, 8, 100)], 15 << 12 | 6 << 8 | 14);
}

}  // namespace
}  // namespace terrane::light
