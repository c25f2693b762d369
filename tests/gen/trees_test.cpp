// Grown shapes: whole, in bounds, the same everywhere.
#include "terrane/gen/generators/trees/trees.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "terrane/base/digest.h"
#include "terrane/gen/generators/trees/tree_math.h"
#include "tests/gen/gen_fixture.h"

namespace terrane::gen::trees {
namespace {

using Place = std::array<int, 3>;

// The voxels that hang together with the foot: by faces, of wood by corners too.
std::size_t joinedVoxels(const VoxelShape& shape) {
    std::map<Place, bool> isWood;  // by voxel
    for (const ShapeVoxel& v : shape.voxels) isWood[{v.x, v.y, v.z}] = shape.blocks[v.block].rank > 0;
    std::set<Place> joined = {{0, 0, 0}};
    std::vector<Place> open(joined.begin(), joined.end());
    while (!open.empty()) {
        const Place at = open.back();
        open.pop_back();
        for (int n = 0; n < 27; ++n) {
            const Place d = {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
            const Place next = {at[0] + d[0], at[1] + d[1], at[2] + d[2]};
            const bool isFace = std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]) == 1;
            if (!isWood.contains(next) || (!isFace && !(isWood[at] && isWood[next]))) continue;
            if (joined.insert(next).second) open.push_back(next);
        }
    }
    return joined.size();
}

TEST(Trees, AreWholeAndStandOnTheirFoot) {
    for (const Kind kind : allKinds()) {
        for (const VoxelShape& shape : shapesOf(kind)) {
            SCOPED_TRACE(shape.name);
            EXPECT_EQ(joinedVoxels(shape), shape.voxels.size());
            EXPECT_EQ(shapeMistake(shape, contentBlocks()), "");
            // Something of it lies in the earth, so that it stands on slopes.
            int lowest = 0;
            for (const ShapeVoxel& v : shape.voxels) lowest = std::min<int>(lowest, v.z);
            EXPECT_LE(lowest, -1);
        }
    }
}

TEST(Trees, OfEachKindThereAreDifferentOnes) {
    for (const Kind kind : allKinds()) {
        const std::vector<VoxelShape>& shapes = shapesOf(kind);
        EXPECT_GE(shapes.size(), 4u);
        for (std::size_t k = 1; k < shapes.size(); ++k) {
            for (std::size_t n = 0; n < k; ++n)
                EXPECT_NE(shapes[k].voxels, shapes[n].voxels) << shapes[k].name;
        }
    }
}

std::string digestOf(const std::vector<Kind>& kinds) {
    base::Digest digest;
    for (const Kind kind : kinds) {
        const std::vector<VoxelShape> again = growShapes(kind);
        EXPECT_EQ(again.size(), shapesOf(kind).size());
        for (std::size_t n = 0; n < again.size(); ++n) {
            EXPECT_EQ(again[n].voxels, shapesOf(kind)[n].voxels);
            digest.update(std::as_bytes(std::span(again[n].voxels)));
            for (const ShapeBlock& b : again[n].blocks) digest.update(std::as_bytes(std::span(b.name)));
        }
    }
    return digest.hex();
}

// The digests stand for every bit of every shape: they are the same on every machine. The kinds of the first
// one grow in worlds of `continents`.
TEST(Trees, GrowTheSameEverywhere) {
    const std::vector<Kind> kinds = allKinds();
    const auto middle = kinds.begin() + 1 + static_cast<int>(Kind::GiantMushroom);
    EXPECT_EQ(digestOf({kinds.begin(), middle}), "df69fa56a3d5222e944905552527811c");
    EXPECT_EQ(digestOf({middle, kinds.end()}), "8e23d31a2e823fa2c9ecb8020e5c947b");
}

struct Look {
    int low = 0, high = 0, reach = 0;  // z of wood or leaves; horizontally from the foot
    int wood = 0, leaves = 0;
    std::string leafBlock;
};

Look lookOf(const VoxelShape& shape) {
    Look look;
    for (const ShapeVoxel& v : shape.voxels) {
        look.low = std::min<int>(look.low, v.z);
        look.high = std::max<int>(look.high, v.z);
        look.reach = std::max({look.reach, std::abs(v.x), std::abs(v.y)});
        const bool isLeaf = shape.blocks[v.block].rank == 0;
        ++(isLeaf ? look.leaves : look.wood);
        if (isLeaf) look.leafBlock = shape.blocks[v.block].name;
    }
    return look;
}

// The blocks of a kind are those that columns too wide for shapes show.
TEST(Trees, HaveTheBlocksThatTheTableNames) {
    GeneratorBuilder builder("trees", contentBlocks());
    const TreeKinds kinds = record(builder);
    for (const Kind kind : allKinds()) {
        const KindRecord& entry = of(kinds, kind);
        for (const VoxelShape& shape : shapesOf(kind)) {
            const auto has = [&](std::string_view name) {
                return std::any_of(shape.blocks.begin(), shape.blocks.end(),
                                   [&](const ShapeBlock& b) { return b.name == name; });
            };
            SCOPED_TRACE(shape.name);
            const Look look = lookOf(shape);
            if (look.leaves > 0) {
                EXPECT_TRUE(has(entry.wood));
                EXPECT_EQ(look.leafBlock, entry.leaves);
            }
        }
    }
}

// No shape is cut off by the borders that shapes have: hardly a voxel lies on them.
TEST(Trees, EndInsideOfTheBounds) {
    for (const Kind kind : allKinds()) {
        for (const VoxelShape& shape : shapesOf(kind)) {
            SCOPED_TRACE(shape.name);
            int atBorder = 0;
            for (const ShapeVoxel& v : shape.voxels)
                atBorder += std::max(std::abs(v.x), std::abs(v.y)) == kMaxShapeReach || v.z == kMaxShapeZ;
            EXPECT_LE(atBorder, 12);
        }
    }
}

// The highest points of old and young ones.
float heightOf(Kind kind) {
    int sum = 0;
    for (const VoxelShape& shape : shapesOf(kind)) sum += statisticsOf(shape).height;
    return static_cast<float>(sum) / static_cast<float>(shapesOf(kind).size());
}

TEST(Trees, TheYoungAreLessThanHalfAsHighAsTheOld) {
    const std::map<Kind, Kind> grown = {{Kind::YoungOak, Kind::OldOak},
                                        {Kind::YoungBirch, Kind::Birch},
                                        {Kind::YoungSpruce, Kind::Spruce},
                                        {Kind::YoungFir, Kind::Fir}};
    for (const auto& [young, old] : grown) {
        EXPECT_LT(heightOf(young), .5f * heightOf(old)) << nameOf(young);
        EXPECT_EQ(lookOf(shapesOf(young).front()).leafBlock, lookOf(shapesOf(old).front()).leafBlock);
    }
}

TEST(Trees, TheGiantsStandAboveAllOthers) {
    for (const Kind kind : allKinds()) {
        if (kind == Kind::Sequoia || kind == Kind::Kapok || kind == Kind::GiantTree) {
            EXPECT_GE(heightOf(kind), 40.0f) << nameOf(kind);
        } else {
            EXPECT_LT(heightOf(kind), 32.0f) << nameOf(kind);
        }
    }
}

TEST(Trees, DeadWoodHasNoLeaves) {
    for (const Kind kind : {Kind::DeadTree, Kind::FallenLog, Kind::Snag, Kind::Stump, Kind::UprootedTree}) {
        for (const VoxelShape& shape : shapesOf(kind)) EXPECT_EQ(lookOf(shape).leaves, 0) << shape.name;
    }
}

// Everywhere from the same side: a slope of them looks combed.
TEST(Trees, TheWindBendsAllKrummholzTheSameWay) {
    for (const VoxelShape& shape : shapesOf(Kind::Krummholz)) {
        int sum = 0, leaves = 0;
        for (const ShapeVoxel& v : shape.voxels) {
            if (shape.blocks[v.block].rank > 0) continue;
            sum += v.x;
            ++leaves;
        }
        EXPECT_GT(leaves, 20) << shape.name;
        EXPECT_GT(sum, leaves) << shape.name << ": leaves are more than a block downwind on average";
    }
}

// Below its lowest leaves a mangrove is roots beside water and air, not a wall.
TEST(Trees, MangrovesStandOnRootsAroundTheirFoot) {
    for (const VoxelShape& shape : shapesOf(Kind::Mangrove)) {
        std::set<std::pair<int, int>> feet;
        for (const ShapeVoxel& v : shape.voxels)
            if (v.z == -1) feet.insert({v.x, v.y});
        EXPECT_GE(feet.size(), 5u) << shape.name;
        EXPECT_LE(feet.size(), 30u) << shape.name;
        EXPECT_LE(lookOf(shape).low, -4) << shape.name << ": it reaches through shallow water";
    }
}

TEST(Trees, AreRecordedWithTheSameNumbersAtEachLevel) {
    TreeKinds kinds[3];
    for (int level = 0; level < 3; ++level) {
        GeneratorBuilder builder("trees", contentBlocks(), level);
        kinds[level] = record(builder);
        builder.pass3D("none", [](Pass&) {});
        EXPECT_TRUE(builder.finish().has_value());
    }
    int next = 0;
    for (std::size_t k = 0; k < kinds[0].size(); ++k) {
        const KindRecord& kind = kinds[0][k];
        EXPECT_EQ(kind.first, next);
        EXPECT_EQ(kind.first, kinds[2][k].first);
        next += kind.count;
        EXPECT_NE(contentBlocks().find(kind.wood), nullptr);
        EXPECT_NE(contentBlocks().find(kind.leaves), nullptr);
        EXPECT_GT(kind.cover, 3.0f) << kind.name;
        EXPECT_GT(kind.height, 0.5f) << kind.name;
    }
    EXPECT_EQ(of(kinds[1], Kind::Palm).name, "palm");
}

// Those that are not recorded give no shape, the others the numbers of their order.
TEST(Trees, OnlyListedKindsAreRecorded) {
    GeneratorBuilder builder("trees", contentBlocks());
    const TreeKinds kinds = record(builder, std::vector{Kind::Fir, Kind::Oak, Kind::Fir});
    EXPECT_EQ(of(kinds, Kind::Oak).first, 0);
    EXPECT_EQ(of(kinds, Kind::Fir).first, of(kinds, Kind::Oak).count);
    EXPECT_EQ(of(kinds, Kind::Birch).count, 0);
    EXPECT_EQ(of(kinds, Kind::Birch).name, "birch");
    EXPECT_EQ(asInt(shapeOf(of(kinds, Kind::Birch), 0xFFFFFF).bits), -1);
}

TEST(Trees, AHashChoosesEachVariant) {
    const KindRecord kind = {"five", 40, 5, 1, 1, "stone", "stone"};
    std::set<std::int32_t> chosen;
    for (int k = 0; k < 1000; ++k) chosen.insert(asInt(shapeOf(kind, k * 16777).bits));
    EXPECT_EQ(chosen, (std::set<std::int32_t>{40, 41, 42, 43, 44}));
    EXPECT_EQ(asInt(shapeOf(kind, 16777215).bits), 44);
}

// From level to level the area that crowns cover stays, on average.
TEST(Trees, CoarsenedKeepTheirCover) {
    for (const Kind kind : {Kind::Oak, Kind::OldOak, Kind::Spruce, Kind::Acacia, Kind::Willow}) {
        for (int level = 1; level <= 2; ++level) {
            int cover = 0, coarse = 0;
            for (const VoxelShape& shape : shapesOf(kind)) {
                cover += statisticsOf(shape).cover;
                coarse += statisticsOf(coarsened(shape, level)).cover << (2 * level);
            }
            EXPECT_NEAR(static_cast<double>(coarse) / cover, 1.0, 0.08)
                << static_cast<int>(kind) << " " << level;
        }
    }
}

TEST(TreeMath, DirectionsAndRounding) {
    for (int k = -100; k <= 100; ++k) {
        const float t = static_cast<float>(k) * 0.037f;
        EXPECT_NEAR(sinTurns(t), std::sin(6.283185307f * t), 0.0012f);
        EXPECT_EQ(roundToInt(t), static_cast<int>(std::floor(t + 0.5f)));
    }
}

}  // namespace
}  // namespace terrane::gen::trees
