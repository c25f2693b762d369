// Conflict detection compared with a slow reference.
#include "terrane/net_postgres/history_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace terrane::net_postgres {
namespace {

using world::BlockPos;

TEST(HistoryOrder, EqualsAReference) {
    std::mt19937 random(5);
    struct Heard {
        std::uint64_t number;
        std::vector<BlockPos> blocks;
    };
    const auto randomBlocks = [&] {
        std::vector<BlockPos> blocks;
        for (std::size_t k = 1 + random() % 3; k > 0; --k)
            blocks.push_back({static_cast<int>(random() % 4), static_cast<int>(random() % 4), 0});
        return blocks;
    };
    HistoryOrder order;
    std::vector<Heard> all;
    std::uint64_t forgotten = 0;
    int accepted = 0, refused = 0;
    for (int round = 0; round < 5000; ++round) {
        if (random() % 3 == 0) {
            auto blocks = randomBlocks();
            all.push_back({order.hear(blocks), blocks});
        }
        if (random() % 50 == 0) {
            forgotten += random() % (order.heard() - forgotten + 1);
            order.forget(forgotten);
        }
        const std::uint64_t basis = forgotten + random() % (order.heard() - forgotten + 1);
        const auto blocks = randomBlocks();
        const bool expected = std::ranges::none_of(all, [&](const Heard& heard) {
            return heard.number > basis &&
                   std::ranges::find_first_of(heard.blocks, blocks) != heard.blocks.end();
        });
        EXPECT_EQ(order.isAccepted(blocks, basis), expected);
        ++(expected ? accepted : refused);
    }
    EXPECT_GT(accepted, 500);
    EXPECT_GT(refused, 500);
    order.forget(order.heard());
    EXPECT_EQ(order.size(), 0u);
}

}  // namespace
}  // namespace terrane::net_postgres
