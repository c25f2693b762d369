#include "terrane/gen/language/compounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/gen/gen_fixture.h"

namespace terrane::gen {
namespace {

// The point in a column, read back from its blocks.
struct ColumnPoint {
    bool isHere;
    std::int32_t x, y;  // of the point, modulo 4096
    std::int32_t hash;  // its lower 12 bits
};

class Points {
  public:
    Points(int level, int spacing, int distance)
        : level_(level), generator_(make(level, spacing, distance)) {}

    std::vector<ColumnPoint> in(ChunkPos pos) const {
        const std::vector<BlockId> ids = blocksOf(generator_.generate(pos));
        std::vector<ColumnPoint> points;
        for (std::size_t c = 0; c < 256; ++c) {
            points.push_back({ids[c] != 0, ids[256 + c], ids[512 + c], ids[768 + c]});
        }
        return points;
    }

    // Points of a square of chunks from the origin, as blocks modulo 4096.
    std::set<std::pair<int, int>> around(int chunks) const {
        std::set<std::pair<int, int>> found;
        for (int n = 0; n < chunks * chunks; ++n) {
            const ChunkPos pos = {n % chunks, n / chunks, static_cast<std::uint8_t>(level_)};
            for (const ColumnPoint& p : in(pos)) {
                if (p.isHere) found.insert({p.x, p.y});
            }
        }
        return found;
    }

  private:
    static Generator make(int level, int spacing, int distance) {
        GeneratorBuilder builder("scatter", testBlocks(), level);
        const auto isHere = builder.field<Bool>("here");
        const auto x = builder.field<Int>("x"), y = builder.field<Int>("y"),
                   hash = builder.field<Int>("hash");
        builder.pass2D("points", [&](Pass& p) {
            const ScatterPoint point = scatter(p, "points", spacing, distance);
            p.set(isHere, point.isHere);
            p.set(x, point.at.x & 4095);
            p.set(y, point.at.y & 4095);
            p.set(hash, point.hash & 4095);
        });
        builder.pass3D("shown", [&](Pass& p) {
            const Int here = select(p.read(isHere), Int(1), Int(0));
            p.setBlock(Block(multiSelect<Int>({{p.z() == 0, here},
                                               {p.z() == 1, p.read(x)},
                                               {p.z() == 2, p.read(y)},
                                               {p.z() == 3, p.read(hash)}},
                                              0)));
        });
        auto graph = builder.finish();
        EXPECT_TRUE(graph.has_value()) << (graph ? "" : graph.error().message);
        return Generator(std::move(*graph), kTestSeed);
    }

    int level_;
    Generator generator_;
};

TEST(Scatter, OnePointInEachSquareAndNoneTooNear) {
    for (const auto& [spacing, distance] :
         {std::pair(7, 4), std::pair(11, 11), std::pair(5, 1), std::pair(13, 6)}) {
        const auto points = Points(0, spacing, distance).around(8);
        const double wanted = 128.0 * 128.0 / (spacing * spacing);
        EXPECT_NEAR(static_cast<double>(points.size()), wanted, 0.12 * wanted);
        for (const auto& [x, y] : points) {
            for (int n = 0; n < (2 * distance - 1) * (2 * distance - 1); ++n) {
                const int dx = n % (2 * distance - 1) - distance + 1,
                          dy = n / (2 * distance - 1) - distance + 1;
                EXPECT_TRUE((dx == 0 && dy == 0) || !points.contains({x + dx, y + dy}));
            }
        }
    }
}

TEST(Scatter, APointIsTheColumnItIsIn) {
    const Points points(0, 7, 4);
    for (const ChunkPos pos : kPlaces) {
        const std::vector<ColumnPoint> columns = points.in(pos);
        for (std::size_t c = 0; c < columns.size(); ++c) {
            if (!columns[c].isHere) continue;
            EXPECT_EQ(columns[c].x, (wrapped(std::int64_t{pos.x} * 16) + static_cast<int>(c % 16)) & 4095);
            EXPECT_EQ(columns[c].y, (wrapped(std::int64_t{pos.y} * 16) + static_cast<int>(c / 16)) & 4095);
        }
    }
}

TEST(Scatter, LevelsAgree) {
    const auto nearby = Points(0, 7, 4).around(8);
    EXPECT_EQ(Points(1, 7, 4).around(4), nearby);
    EXPECT_EQ(Points(2, 7, 4).around(2), nearby);
    // One of the points in a column is left.
    const auto far = Points(3, 7, 4).around(1);
    EXPECT_GT(far.size(), 120u);
    EXPECT_LT(far.size(), nearby.size());
    for (const auto& point : far) EXPECT_TRUE(nearby.contains(point));
}

// A column of 8×8 blocks meets up to 3×3 squares of 5×5, and need not hold one whole.
TEST(Scatter, WideColumnsFindWhatIsInThem) {
    const auto nearby = Points(0, 5, 1).around(8);
    const std::vector<ColumnPoint> columns = Points(3, 5, 1).in({0, 0, 3});
    int empty = 0;
    for (int c = 0; c < 256; ++c) {
        const int left = c % 16 * 8, bottom = c / 16 * 8;
        const bool hasPoint = std::ranges::any_of(nearby, [&](const auto& point) {
            return point.first >= left && point.first < left + 8 && point.second >= bottom &&
                   point.second < bottom + 8;
        });
        EXPECT_EQ(columns[static_cast<std::size_t>(c)].isHere, hasPoint) << c;
        empty += hasPoint ? 0 : 1;
    }
    EXPECT_GT(empty, 0);
}

TEST(Scatter, HashesDiffer) {
    std::set<int> hashes;
    int count = 0;
    for (const ColumnPoint& p : Points(0, 2, 1).in({0, 0})) {
        if (!p.isHere) continue;
        hashes.insert(p.hash);
        ++count;
    }
    EXPECT_NEAR(count, 64, 12);
    EXPECT_GT(static_cast<int>(hashes.size()), count - 5);
}

}  // namespace
}  // namespace terrane::gen
