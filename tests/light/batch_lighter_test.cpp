#include "terrane/light/batch_lighter.h"

#include <gtest/gtest.h>

#include "tests/light/batch_lighter_cases.h"

namespace terrane::light {
namespace {

TEST(BatchLighter, DoesWhatEveryBackEndDoes) {
    const auto lighter = makeCpuLighter(contentTable());
    EXPECT_EQ(lighter->backend(), "cpu");
    expectLighterCases(*lighter);
}

TEST(BatchLighter, RequestsOfAnAreaSeeItsChunks) {
    const TestArea area(3, 2, caves(90));
    const LightArea view = area.view();
    std::vector<LightRequest> requests;
    for (int k = 0; k < 6; ++k) requests.push_back(requestIn(view, k % 3, k / 3));
    EXPECT_EQ(requests[5].pos, (world::ChunkPos{2, 1}));
    EXPECT_EQ(requests[5].chunks[kCenterChunk].get(), &area.chunks[5]);
    EXPECT_EQ(requests[5].chunks[kCenterChunk + 1], nullptr);
    EXPECT_EQ(lightAll(*makeCpuLighter(contentTable()), requests), area.lights());
}

}  // namespace
}  // namespace terrane::light
