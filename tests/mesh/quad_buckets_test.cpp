#include "terrane/mesh/quad_buckets.h"

#include <gtest/gtest.h>

namespace terrane::mesh {
namespace {

TEST(QuadBuckets, AppendsByContextThenGroupAndStartsAnew) {
    QuadBuckets buckets;
    std::vector<shared::Quad> quads{{99, 0}};
    buckets.bucket(2, 1).push_back({3, 0});
    buckets.bucket(0, kGroupAlways).push_back({2, 0});
    buckets.bucket(0, 0).push_back({1, 0});
    buckets.coverHeight(40, 41);
    buckets.coverHeight(32, 36);
    const RegionMesh region = buckets.finishRegion(quads);
    EXPECT_EQ(quads, (std::vector<shared::Quad>{{99, 0}, {1, 0}, {2, 0}, {3, 0}}));
    EXPECT_EQ(region.groups[0][0], (QuadRange{1, 1}));
    EXPECT_EQ(region.groups[0][kGroupAlways], (QuadRange{2, 1}));
    EXPECT_EQ(region.groups[2][1], (QuadRange{3, 1}));
    EXPECT_EQ(region.minZ, 32);
    EXPECT_EQ(region.maxZ, 41);

    const RegionMesh empty = buckets.finishRegion(quads);
    EXPECT_EQ(quads.size(), 4u);
    EXPECT_EQ(empty.groups[2][1].count, 0u);
    EXPECT_EQ(empty.maxZ, 0);
}

}  // namespace
}  // namespace terrane::mesh
