#include "apps/terrane/world_view.h"

#include <gtest/gtest.h>

namespace terrane::app {
namespace {

// A frame that draws for so long, and loads for as long as the frame before it allows, again and again.
TEST(WorldView, LoadingAddsAThirdToFramesAtMost) {
    for (const double drawing : {0.004, 0.016, 0.1, 0.4}) {
        double frame = drawing;
        for (int k = 0; k < 100; ++k) {
            frame = drawing + uploadBudget(frame);
            EXPECT_LE(frame, drawing * 4 / 3 + 1e-9);
        }
    }
}

TEST(WorldView, FramesOfNoTimeLoadToo) {
    EXPECT_EQ(uploadBudget(0), 0.001);
    EXPECT_EQ(uploadBudget(60), 0.025);
}

}  // namespace
}  // namespace terrane::app
