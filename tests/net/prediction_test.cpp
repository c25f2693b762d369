#include "terrane/net/client/client_world.h"

#include <gtest/gtest.h>

#include <deque>
#include <map>
#include <random>

namespace terrane::net {
namespace {

using world::BlockPos;
using world::PlacedBlock;

PlacedBlock block(BlockPos pos, int id) {
    return {pos, {static_cast<world::BlockId>(id), 0, {}}};
}

std::map<BlockPos, int> idsOf(const std::vector<PlacedBlock>& blocks) {
    std::map<BlockPos, int> ids;
    for (const auto& [pos, value] : blocks) ids[pos] = value.id;
    return ids;
}

TEST(Prediction, BlocksThatNoCommandChangedAreShownAtOnce) {
    Prediction prediction;
    const std::vector<PlacedBlock> blocks{block({1, 2, 3}, 5)};
    EXPECT_EQ(idsOf(prediction.takeIn(blocks)), idsOf(blocks));
    EXPECT_EQ(prediction.blockCount(), 0u);
}

TEST(Prediction, ARefusedEditIsTakenBack) {
    Prediction prediction;
    prediction.predict(1, std::vector{block({0, 0, 1}, 7), block({0, 0, 2}, 8)});
    EXPECT_EQ(idsOf(prediction.settle(1)), (std::map<BlockPos, int>{{{0, 0, 1}, 7}, {{0, 0, 2}, 8}}));
    EXPECT_EQ(prediction.blockCount(), 0u);
}

TEST(Prediction, AnotherPlayersEditIsShownOnceTheOwnIsDecided) {
    Prediction prediction;
    prediction.predict(1, std::vector{block({0, 0, 1}, 0)});
    EXPECT_TRUE(prediction.takeIn(std::vector{block({0, 0, 1}, 9)}).empty()) << "the own one is shown";
    EXPECT_EQ(idsOf(prediction.settle(1)), (std::map<BlockPos, int>{{{0, 0, 1}, 9}}));
}

TEST(Prediction, ABlockWaitsForTheNewestCommandThatChangedIt) {
    Prediction prediction;
    prediction.predict(1, std::vector{block({0, 0, 1}, 0)});
    prediction.predict(2, std::vector{block({0, 0, 1}, 5)});
    EXPECT_TRUE(prediction.settle(1).empty()) << "command 2 is ahead";
    EXPECT_TRUE(prediction.takeIn(std::vector{block({0, 0, 1}, 5)}).empty());
    EXPECT_EQ(idsOf(prediction.settle(2)), (std::map<BlockPos, int>{{{0, 0, 1}, 5}}));
}

TEST(Prediction, WithoutAServerAllIsTakenBack) {
    Prediction prediction;
    prediction.predict(1, std::vector{block({0, 0, 1}, 4)});
    prediction.predict(2, std::vector{block({0, 0, 2}, 3)});
    EXPECT_EQ(prediction.settleAll().size(), 2u);
    EXPECT_EQ(prediction.blockCount(), 0u);
}

// A server and two clients that edit the same few blocks, with delays: the server refuses some edits. In the
// end all show the server's blocks, and a client's own edit is never reverted before it is decided.
TEST(Prediction, ClientsComeToShowWhatTheServerHas) {
    std::mt19937 random(1);
    struct ToServer {
        std::uint32_t number;
        BlockPos pos;
        int id;
    };
    struct ToClient {
        std::vector<PlacedBlock> blocks;
        std::uint32_t done = 0;  // 0: only blocks
    };
    struct Client {
        Prediction prediction;
        std::map<BlockPos, int> shown, own;  // own: newest undecided edit
        std::map<BlockPos, std::uint32_t> ownNumber;
        std::deque<ToServer> up;
        std::deque<ToClient> down;
        std::uint32_t number = 0;
    };
    std::map<BlockPos, int> server;
    Client clients[2];
    const auto show = [](Client& client, const std::vector<PlacedBlock>& blocks) {
        for (const auto& [pos, value] : blocks) client.shown[pos] = value.id;
    };
    const auto act = [&](Client& client) {
        const BlockPos pos{static_cast<int>(random() % 3), 0, 0};
        const int id = 1 + static_cast<int>(random() % 9);
        client.prediction.predict(++client.number, std::vector{block(pos, client.shown[pos])});
        client.shown[pos] = client.own[pos] = id;
        client.ownNumber[pos] = client.number;
        client.up.push_back({client.number, pos, id});
    };
    const auto serve = [&](Client& client) {
        if (client.up.empty()) return;
        const ToServer edit = client.up.front();
        client.up.pop_front();
        if (random() % 3 != 0) {
            server[edit.pos] = edit.id;
            for (Client& other : clients) other.down.push_back({{block(edit.pos, edit.id)}});
        }
        client.down.push_back({{}, edit.number});
    };
    const auto receive = [&](Client& client) {
        if (client.down.empty()) return;
        const ToClient message = client.down.front();
        client.down.pop_front();
        show(client, client.prediction.takeIn(message.blocks));
        if (message.done == 0) return;
        show(client, client.prediction.settle(message.done));
        std::erase_if(client.own,
                      [&](const auto& own) { return client.ownNumber[own.first] <= message.done; });
    };
    for (int step = 0; step < 20000; ++step) {
        Client& client = clients[random() % 2];
        const auto what = random() % 4;
        if (what == 0 && step < 19000) act(client);
        if (what == 1) serve(client);
        if (what >= 2) receive(client);
        for (const auto& [pos, id] : client.own) ASSERT_EQ(client.shown[pos], id) << step;
    }
    for (Client& client : clients)
        while (!client.up.empty()) serve(client);
    for (Client& client : clients) {
        while (!client.down.empty()) receive(client);
        EXPECT_EQ(client.prediction.blockCount(), 0u);
        for (const auto& [pos, id] : server) EXPECT_EQ(client.shown[pos], id);
    }
}

}  // namespace
}  // namespace terrane::net
