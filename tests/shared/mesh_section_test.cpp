#include "terrane/shared/mesh_section.h"

#include <gtest/gtest.h>

#include "terrane/shared/quad.h"

namespace terrane::shared {
namespace {

TEST(MeshSectionRecord, PlacesAndHeightsMayBeNegative) {
    for (const int z : {-2048, -257, -256, -1, 0, 255, 256, 2047}) {
        for (const uint level : {0u, 3u, 15u}) {
            const uint place = packPlace(level, quadSlab(z));
            EXPECT_EQ(placeLevel(place), level);
            EXPECT_EQ(placeBase(place) + static_cast<int>(quadZOf(z)), z);
        }
        const uint heights = packHeights(z, z + 1);
        EXPECT_EQ(lowHeight(heights), z);
        EXPECT_EQ(highHeight(heights), z + 1);
        EXPECT_NE(heights, 0u) << "that of a free slot";
    }
    EXPECT_EQ(packPlace(7, 0), 7u);
}

}  // namespace
}  // namespace terrane::shared
