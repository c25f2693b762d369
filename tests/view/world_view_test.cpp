#include "terrane/view/world_view.h"

#include <gtest/gtest.h>

namespace terrane::view {
namespace {

constexpr double kNothingYet = 1, kNextToAll = 0.05;  // what is missing

// Time of a frame that draws for this long, and loads for as long as the frame before allows, repeated until
// stable.
double frameThatLoads(double drawing, double missing) {
    double frame = drawing;
    for (int k = 0; k < 100; ++k) frame = drawing + uploadBudget(frame, missing);
    return frame;
}

TEST(UploadBudget, LoadingAddsAThirdToFramesAtMost) {
    for (const double drawing : {0.004, 0.016, 0.1, 0.4})
        EXPECT_LE(frameThatLoads(drawing, kNothingYet), drawing * 4 / 3 + 1e-9);
}

TEST(UploadBudget, LoadingAddsAFifteenthWhereNextToAllIsThere) {
    for (const double drawing : {0.015, 0.1, 0.4})
        EXPECT_LE(frameThatLoads(drawing, kNextToAll), drawing * 16 / 15 + 1e-9);
}

TEST(UploadBudget, FramesOfNoTimeLoadToo) {
    EXPECT_EQ(uploadBudget(0, 0), 0.001);
    EXPECT_EQ(uploadBudget(0, kNothingYet), 0.001);
    EXPECT_EQ(uploadBudget(60, kNothingYet), 0.025);
}

TEST(MissingShare, CountsWhatIsNotVisibleAndWhatWaits) {
    EXPECT_EQ(missingShare({.inView = 0, .visible = 0}, 0), 0);
    EXPECT_EQ(missingShare({.inView = 100, .visible = 0}, 0), 1);
    EXPECT_EQ(missingShare({.inView = 100, .visible = 90}, 0), 0.1);
    EXPECT_EQ(missingShare({.inView = 100, .visible = 90}, 15), 0.25);
    EXPECT_EQ(missingShare({.inView = 100, .visible = 100}, 300), 1);
    EXPECT_EQ(missingShare({.inView = 0, .visible = 0}, 3), 1);
}

}  // namespace
}  // namespace terrane::view
