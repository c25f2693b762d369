// A server without sockets, and clients on in-memory wires; the test delivers the messages. Nothing runs
// beside the test: sessions have no threads, other threads are waited for in each tick, and the clock
// advances by ticks.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "terrane/content/built_in.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/net/client/client_link.h"
#include "terrane/net/client/client_world.h"
#include "terrane/net/client/remote_session.h"
#include "terrane/net/server/server_loop.h"
#include "terrane/net/server/sqlite_records.h"
#include "terrane/net/wire/wire.h"
#include "terrane/store/saves/open_world.h"
#include "tests/base/temp_folder.h"
#include "tests/world/content_blocks.h"

namespace terrane::net {

inline constexpr std::string_view kTestGenerator = "overworld";

inline std::unique_ptr<const world::BlockRegistry> ownBlocks() {
    return std::make_unique<const world::BlockRegistry>(content::loadBlocks().value());
}

inline game::SessionParts serverParts(const std::filesystem::path& world, world::Heights heights = {}) {
    auto blocks = ownBlocks();
    const std::string generator(kTestGenerator);
    store::WorldRequest request;
    request.create =
        store::WorldIdentity{1, generator, gen::versionOf(gen::builtInGenerators(), generator), heights};
    request.versionOf = [](std::string_view name) { return gen::versionOf(gen::builtInGenerators(), name); };
    request.sharing = store::WorldSharing::Servers;
    auto store = store::openWorld(store::worldLocation(world.string()), *blocks, request).value();
    auto generators =
        gen::makeLevelGenerators(generator, *blocks, 1, gen::builtInGenerators(), heights).value();
    return {std::move(blocks), std::move(generators), std::move(store), 0};
}

// For tests in which the server's clock runs ahead of its players.
inline ServerSettings patientSettings() {
    ServerSettings settings;
    settings.silentAfter = settings.loginWithin = std::chrono::hours(1);
    return settings;
}

// A server on a world in a folder.
struct TestServer {
    explicit TestServer(const std::filesystem::path& folder, const ServerSettings& settings = {},
                        const ServerContent& content = {})
        : host(openServerHost(serverParts(folder / "w.sqlite"),
                              SqliteRecords::open(folder / "w.server.sqlite", contentBlocks()).value(),
                              settings, "test", content)
                   .value()) {}
    TestServer(game::SessionParts parts, std::unique_ptr<ServerRecords> records,
               const ServerSettings& settings = {})
        : host(openServerHost(std::move(parts), std::move(records), settings, "test").value()) {}
    ServerState& state() { return *host.state; }
    // Chunks are loaded and edits are durable before the next tick.
    void tick() {
        net::tick(state(), now += kServerTick);
        finishWork();
    }
    void finishWork() {
        state().session.jobs().waitIdle();
        finishWrites();
    }
    void finishWrites() {
        state().jobs.waitIdle();
        (void)state().history.records.flush();
    }

    ServerHost host;
    Time now{std::chrono::hours(1)};
    ConnectionId lastConnection = 0;
};

// A connection to the server that sends and receives raw messages.
struct TestWire {
    explicit TestWire(TestServer& testServer) : server(testServer), id(++testServer.lastConnection) {
        fillRandom(channel);
        onOpened(server.state(), id, channel, {"test", "test", false}, server.now);
    }
    void say(const ClientMessage& message) { onMessage(server.state(), id, encode(message), server.now); }
    // Messages of the server since the last call.
    std::vector<ServerMessage> take() {
        std::vector<ServerMessage> messages;
        const auto client = server.state().clients.all.find(id);
        if (client == server.state().clients.all.end()) return messages;
        received += client->second.outgoing.size();
        reader.add(std::exchange(client->second.outgoing, {}));
        while (const auto frame = reader.next().value())
            messages.push_back(decodeServerMessage(*frame).value());
        return messages;
    }
    void close() { onClosed(server.state(), id, server.now); }

    TestServer& server;
    ConnectionId id;
    Bytes channel = Bytes(32);
    FrameReader reader{kMaxServerMessage};
    std::size_t received = 0;
};

// Null if there is none; points into the vector.
template <class Message>
const Message* findMessage(const std::vector<ServerMessage>& messages) {
    for (const ServerMessage& message : messages)
        if (const auto* found = std::get_if<Message>(&message)) return found;
    return nullptr;
}

inline ClientIdentity testIdentity(const std::string& name) {
    return {name, newPlayerKey(), {}, "test"};
}

// Performs the client's side of the login until the answer to Proof; returns the last answer.
inline ServerMessage logIn(TestWire& wire, const ClientIdentity& identity) {
    wire.say(helloOf(identity));
    auto messages = wire.take();
    const auto* greeting = findMessage<Greeting>(messages);
    if (!greeting) return messages.at(0);
    wire.say(loginOf(identity, *greeting, wire.channel));
    messages = wire.take();
    if (!findMessage<WorldOffer>(messages)) return messages.at(0);
    wire.say(Proof{wire.server.state().offer.digests});
    messages = wire.take();
    return messages.at(0);
}

// A player with its own world, on the surface at its spawn.
struct TestPlayer {
    TestPlayer(TestServer& server, const ClientIdentity& who, int viewDistance = 2, int horizon = 0)
        : identity(who), wire(std::make_unique<TestWire>(server)), view(viewDistance), far(horizon) {
        auto parts = remoteSessionParts(server.state().offer.fingerprint.identity, ownBlocks(), 0).value();
        store = parts.store;
        session = std::make_unique<game::Session>(std::move(parts.parts));
        world = std::make_unique<ClientWorld>(*session, *store,
                                              [this](const ClientMessage& message) { wire->say(message); });
        join();
    }
    void join() {
        const ServerMessage answer = logIn(*wire, identity);
        ASSERT_TRUE(std::holds_alternative<Joined>(answer));
        pose = poseOf(std::get<Joined>(answer).pose);
        world->onMessage(answer);
    }
    void update() {
        for (const ServerMessage& message : wire->take()) {
            if (const auto* ping = std::get_if<Ping>(&message)) wire->say(Pong{ping->time});
            world->onMessage(message);
        }
        session->pipeline().setCameraHeight(world::blockOf(pose.position).z);
        session->pipeline().setView(world::chunkOf(pose.position), view);
        session->pipeline().update(wire->server.now);
        session->jobs().waitIdle();
        world->update(pose, view, far, wire->server.now);
    }
    bool isLoaded() const {
        const auto progress = session->pipeline().progress();
        return progress.isUpToDate() && progress.inView > 0 && world->isViewComplete();
    }
    world::BlockId block(world::BlockPos pos) const { return session->world().block(pos); }
    game::EditResult put(world::BlockPos pos, std::string_view name) {
        return session->edit({game::kLocalPlayer, pos, world::SetBlock{contentBlock(name)}, block(pos)});
    }

    ClientIdentity identity;
    std::unique_ptr<TestWire> wire;
    int view, far;
    RemoteStore* store = nullptr;
    std::unique_ptr<game::Session> session;
    std::unique_ptr<ClientWorld> world;
    world::Pose pose;
};

// A tick of the server, with updates of all clients before and after it.
inline void step(TestServer& server, std::initializer_list<TestPlayer*> players) {
    for (TestPlayer* player : players) player->update();
    server.tick();
    for (TestPlayer* player : players) player->update();
}

// The most ticks that a test waits for anything: more than a minute of the server.
constexpr int kMostTicks = 1500;

// Steps until the condition holds; false if it never does.
template <class Condition>
bool stepUntil(TestServer& server, std::initializer_list<TestPlayer*> players, Condition isSo) {
    for (int k = 0; k < kMostTicks; ++k) {
        step(server, players);
        if (isSo()) return true;
    }
    return false;
}

}  // namespace terrane::net
