// Servers of one world in a real PostgreSQL database, in one process, driven tick by tick.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "terrane/net_postgres/postgres_records.h"
#include "terrane/store_postgres/postgres_store.h"
#include "tests/base/wait_until.h"
#include "tests/net/server_fixture.h"
#include "tests/store_postgres/postgres_server.h"

namespace terrane::net_postgres {

using net::TestPlayer;
using net::TestServer;

inline game::SessionParts sharedParts(const store_postgres::Address& address) {
    auto blocks = net::ownBlocks();
    const std::string generator(net::kTestGenerator);
    store::SaveAccess access;
    access.create = store::WorldIdentity{1, generator, gen::versionOf(gen::builtInGenerators(), generator)};
    auto store =
        store_postgres::PostgresStore::open(address, *blocks, access, store::WorldSharing::Servers).value();
    auto generators = gen::makeLevelGenerators(generator, *blocks, 1).value();
    return {std::move(blocks), std::move(generators), std::move(store), 1};
}

class SharedServers {
  public:
    explicit SharedServers(const std::string& url) : address_(store_postgres::addressOf(url).value()) {}

    TestServer& add() {
        auto parts = sharedParts(address_);
        auto records = PostgresRecords::open(address_, *parts.blocks, {"test", "", ""}).value();
        // Another thread reserves player numbers: wait, so that guests can join at once.
        const auto end = std::chrono::steady_clock::now() + base::kHangs;
        while (records->allocatePlayerId() == game::kNoPlayer && std::chrono::steady_clock::now() < end)
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        servers_.push_back(
            std::make_unique<TestServer>(std::move(parts), std::move(records), net::patientSettings()));
        return *servers_.back();
    }
    // Ends the server as if killed: nothing is saved.
    void kill(TestServer& server) {
        std::erase_if(servers_, [&](const auto& entry) { return entry.get() == &server; });
    }
    void stopAll() {
        for (const auto& server : servers_) {
            const auto stopped = net::stop(server->state(), "the end");
            EXPECT_TRUE(stopped) << stopped.error().message;
        }
        servers_.clear();
    }

    void tick() {
        for (const auto& server : servers_) server->tick();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    // Ticks until the condition holds, at most half a minute.
    template <class Condition>
    bool tickUntil(Condition condition) {
        const auto end = std::chrono::steady_clock::now() + base::kHangs;
        while (std::chrono::steady_clock::now() < end) {
            tick();
            if (condition()) return true;
        }
        return false;
    }

    const std::vector<std::unique_ptr<TestServer>>& all() const { return servers_; }
    const store_postgres::Address& address() const { return address_; }

  private:
    store_postgres::Address address_;
    std::vector<std::unique_ptr<TestServer>> servers_;
};

// A player without a world that sends and receives messages.
struct Guest {
    Guest(TestServer& testServer, const std::string& name, net::ClientIdentity who)
        : server(testServer), identity(std::move(who)), wire(testServer) {
        identity.name = name;
        answer = net::logIn(wire, identity);
        if (const auto* joined = std::get_if<net::Joined>(&answer)) {
            id = joined->player;
            pose = joined->pose;
            wire.say(net::View{world::chunkOf(net::poseOf(pose).position), 4, 0});
        }
    }
    Guest(TestServer& testServer, const std::string& name)
        : Guest(testServer, name, net::testIdentity(name)) {}

    // Sets a block near the player. Returns the command's number.
    net::CommandNumber set(world::BlockPos pos, std::string_view block,
                           std::optional<world::BlockId> expected = std::nullopt) {
        const world::BlockId to = contentBlock(block);
        wire.say(net::Edit{++last, pos, world::SetBlock{to, 0}, expected});
        return last;
    }
    // Stores received messages.
    void hear() {
        for (net::ServerMessage& message : wire.take()) heard.push_back(std::move(message));
    }
    template <class Message>
    const Message* find() {
        hear();
        return net::findMessage<Message>(heard);
    }
    std::optional<game::EditResult> resultOf(net::CommandNumber number) {
        hear();
        for (const net::ServerMessage& message : heard)
            if (const auto* done = std::get_if<net::Done>(&message); done && done->number == number)
                return static_cast<game::EditResult>(done->result);
        return std::nullopt;
    }
    // A position within reach, `up` blocks above its head.
    world::BlockPos near(int dx, int dy, int up = 1) const {
        const world::BlockPos eyes = world::blockOf(net::poseOf(pose).position);
        return {eyes.x + dx, eyes.y + dy, eyes.z + up};
    }

    TestServer& server;
    net::ClientIdentity identity;
    net::TestWire wire;
    net::ServerMessage answer;
    game::PlayerId id = game::kNoPlayer;
    net::WirePose pose;
    net::CommandNumber last = 0;
    std::vector<net::ServerMessage> heard;
};

class SharedServersTest : public testing::Test {
  protected:
    store_postgres::PostgresServer& postgres_ = store_postgres::sharedServer();
    std::string schema_ = store_postgres::freshSchema();
    SharedServers servers_{postgres_.url("schema=" + schema_)};
};

}  // namespace terrane::net_postgres
