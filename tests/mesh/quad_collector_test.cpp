#include "terrane/mesh/quad_collector.h"

#include <gtest/gtest.h>

namespace terrane::mesh {
namespace {

void push(QuadArray& bucket, shared::Quad quad) {
    bucket.reserve(5)[0] = quad;
    bucket.add(1);
}

TEST(QuadArray, KeepsWhatWasAddedWhileItGrows) {
    QuadArray bucket;
    for (unsigned k = 0; k < 1000; ++k) push(bucket, {k, 2 * k});
    ASSERT_EQ(bucket.quads().size(), 1000u);
    for (unsigned k = 0; k < 1000; ++k) EXPECT_EQ(bucket.quads()[k], (shared::Quad{k, 2 * k}));
    bucket.clear();
    EXPECT_TRUE(bucket.quads().empty());
    push(bucket, {7, 7});
    EXPECT_EQ(bucket.quads()[0], (shared::Quad{7, 7}));
}

TEST(QuadCollector, AppendsByBucketThenDirectionAndStartsAgain) {
    QuadCollector buckets;
    std::vector<shared::Quad> quads{{99, 0}};
    push(buckets.quadsOf(2, 1), {3, 0});
    push(buckets.quadsOf(0, kAnyDirection), {2, 0});
    push(buckets.quadsOf(0, 0), {1, 0});
    buckets.coverHeight(40, 41);
    buckets.coverHeight(32, 36);
    const MeshSection meshSection = buckets.finishMeshSection(quads);
    EXPECT_EQ(quads, (std::vector<shared::Quad>{{99, 0}, {1, 0}, {2, 0}, {3, 0}}));
    EXPECT_EQ(meshSection.ranges[0][0], (QuadRange{1, 1}));
    EXPECT_EQ(meshSection.ranges[0][kAnyDirection], (QuadRange{2, 1}));
    EXPECT_EQ(meshSection.ranges[2][1], (QuadRange{3, 1}));
    EXPECT_EQ(meshSection.minZ, 32);
    EXPECT_EQ(meshSection.maxZ, 41);

    const MeshSection empty = buckets.finishMeshSection(quads);
    EXPECT_EQ(quads.size(), 4u);
    EXPECT_EQ(empty.ranges[2][1].count, 0u);
    EXPECT_EQ(empty.maxZ, 0);
}

}  // namespace
}  // namespace terrane::mesh
