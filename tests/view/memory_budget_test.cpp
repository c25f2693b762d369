#include "terrane/view/gpu_back_ends.h"

#include <gtest/gtest.h>

namespace terrane::view {
namespace {

constexpr std::size_t kMebibyte = std::size_t{1} << 20;

TEST(GpuMemoryBudget, IsWhatIsAskedForOrAShareOfWhatIsFree) {
    gpu::DeviceInfo device;
    EXPECT_EQ(gpuMemoryBudget(device, {}), 2048 * kMebibyte);
    EXPECT_EQ(gpuMemoryBudget(device, 24), 24 * kMebibyte);
    device.videoMemoryBytes = 8192 * static_cast<std::int64_t>(kMebibyte);
    EXPECT_EQ(gpuMemoryBudget(device, {}), 4096 * kMebibyte);
    EXPECT_EQ(gpuMemoryBudget(device, 100), 100 * kMebibyte);
    device.videoMemoryBytes = 10 * static_cast<std::int64_t>(kMebibyte);
    EXPECT_EQ(gpuMemoryBudget(device, {}), 256 * kMebibyte);
}

// With one ring around them.
std::size_t chunksWithin(int distance) {
    const auto side = static_cast<std::size_t>(2 * distance + 3);
    return side * side;
}

TEST(FittingViewDistance, IsTheLargestThatFits) {
    for (int distance = 3; distance <= 64; ++distance) {
        for (const std::size_t each : {1000u, 40'000u}) {
            const std::size_t chunks = chunksWithin(distance), bytes = chunks * each;
            for (const std::size_t limit : {bytes / 20, bytes / 3, bytes, 2 * bytes}) {
                const int fitting = fittingViewDistance({chunks, bytes, limit}, distance);
                ASSERT_LT(fitting, distance);
                ASSERT_GE(fitting, kMinViewDistance);
                const auto fits = [&](int d) {
                    return 16 * chunksWithin(d) * each <= 15 * std::min(limit, bytes);
                };
                ASSERT_TRUE(fits(fitting) || fitting == kMinViewDistance);
                ASSERT_TRUE(fitting == distance - 1 || !fits(fitting + 1));
            }
        }
    }
}

TEST(FittingViewDistance, EachStepIsShorterUntilTheLeast) {
    int distance = 64, steps = 0;
    for (; distance > kMinViewDistance; ++steps) {
        const int next = fittingViewDistance({1, 1, 1'000'000}, distance);
        ASSERT_LT(next, distance);
        distance = next;
    }
    EXPECT_EQ(fittingViewDistance({1000, 1000, 0}, kMinViewDistance), kMinViewDistance);
    EXPECT_EQ(fittingViewDistance({0, 0, 0}, 5), 4) << "nothing is known of chunks yet";
}

TEST(ShortViewNotice, TellsBothDistancesAndTheOption) {
    EXPECT_EQ(shortViewNotice(16, 6, 24 * kMebibyte),
              "view distance 6 instead of 16: 24 MiB of GPU memory hold no more (--gpu-memory)");
}

}  // namespace
}  // namespace terrane::view
