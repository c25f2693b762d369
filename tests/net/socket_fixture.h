// A server on a local port and clients that connect to it, all on one thread. The system's network takes its
// own time, so the server ticks as often as it can, and its clock runs ahead.
#pragma once

#include <boost/asio/io_context.hpp>
#include <future>

#include "terrane/net/client/client_link.h"
#include "terrane/net/server/server_sockets.h"
#include "tests/base/wait_until.h"
#include "tests/net/server_fixture.h"

namespace terrane::net {

struct SocketServer {
    SocketServer(boost::asio::io_context& context, const std::filesystem::path& folder,
                 std::uint16_t port = 0, const ServerSettings& settings = patientSettings(),
                 const ServerContent& content = {})
        : server(folder, settings, content),
          sockets(
              ServerSockets::open(context, server.state(), {"127.0.0.1", port}, folder / "key.pem").value()) {
    }
    void update() {
        server.now = std::max(server.now, std::chrono::steady_clock::now());
        server.tick();
        sockets->flush();
    }

    TestServer server;
    std::unique_ptr<ServerSockets> sockets;
};

// A player with its own world, behind a link that reconnects.
struct LinkPlayer {
    LinkPlayer(boost::asio::io_context& context, std::uint16_t port, const std::string& name)
        : link(context, {"127.0.0.1", port}, testIdentity(name), events()) {}
    LinkEvents events() {
        return {[this](const std::string& key) {
                    serverKey = key;
                    return trusts;
                },
                [this](const WorldOffer& offer) { return prove(offer); },
                [this](const ServerMessage& message) { take(message); }};
    }
    base::Result<SampleDigests> prove(const WorldOffer& offer) {
        const auto generator = offeredGenerator(offer, contentBlocks());
        if (!generator) return tl::unexpected(generator.error());
        if (!session) {
            auto parts = remoteSessionParts(offer.world.identity, ownBlocks(), 0).value();
            store = parts.store;
            session = std::make_unique<game::Session>(std::move(parts.parts));
            world = std::make_unique<ClientWorld>(
                *session, *store, [this](const ClientMessage& message) { link.send(message); });
        }
        return sampleDigests(*generator, offer.samples);
    }
    void take(const ServerMessage& message) {
        if (const auto* joined = std::get_if<Joined>(&message)) {
            pose = poseOf(joined->pose);
            ++joins;
        }
        world->onMessage(message);
    }
    void update() {
        link.update(std::chrono::steady_clock::now() + ahead);
        if (!world) return;
        if (wasJoined && !isJoined()) world->onCut();
        wasJoined = isJoined();
        session->pipeline().setView(world::chunkOf(pose.position), 1);
        session->pipeline().update();
        session->jobs().waitIdle();
        if (isJoined()) world->update(pose, 1, 0, std::chrono::steady_clock::now());
    }
    bool isJoined() const { return link.stage() == ClientLink::Stage::Joined; }
    bool isLoaded() const {
        return isJoined() && session->pipeline().progress().isUpToDate() && world->isViewComplete();
    }
    world::BlockPos above(int dx) const {
        const world::BlockPos eyes = world::blockOf(pose.position);
        return {eyes.x + dx, eyes.y, eyes.z + 2};
    }
    game::EditResult put(world::BlockPos pos, std::string_view name) {
        return session->edit({game::kLocalPlayer, pos, world::SetBlock{contentBlock(name)}, {}});
    }

    bool trusts = true, wasJoined = false;
    Time::duration ahead{};  // the link's clock, so that tests need not wait for its next attempt
    std::string serverKey;
    int joins = 0;
    world::Pose pose;
    RemoteStore* store = nullptr;
    std::unique_ptr<game::Session> session;
    std::unique_ptr<ClientWorld> world;
    ClientLink link;
};

class SocketTest : public testing::Test {
  protected:
    SocketServer& start(const ServerSettings& settings = patientSettings()) {
        server_ = std::make_unique<SocketServer>(context_, folder_.path(), port_, settings);
        port_ = server_->sockets->port();
        return *server_;
    }
    LinkPlayer& addPlayer(const std::string& name, std::uint16_t port = 0) {
        players_.push_back(std::make_unique<LinkPlayer>(context_, port ? port : port_, name));
        return *players_.back();
    }
    void runOnce() {
        if (server_) server_->update();
        for (const auto& player : players_) player->update();
        context_.restart();
        context_.run_for(std::chrono::milliseconds(1));
    }
    // Runs everything until the condition holds; false if it hangs.
    template <class Condition>
    bool runUntil(Condition isSo) {
        runOnce();
        return base::waitUntil(isSo, [this] { runOnce(); });
    }
    // Runs `use` on a separate thread while the server runs: it may block.
    template <class Use>
    auto beside(Use use) {
        auto result = std::async(std::launch::async, use);
        EXPECT_TRUE(
            runUntil([&] { return result.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }));
        return result.get();
    }

    base::TempFolder folder_;
    boost::asio::io_context context_;
    std::uint16_t port_ = 0;
    std::unique_ptr<SocketServer> server_;
    std::vector<std::unique_ptr<LinkPlayer>> players_;
};

}  // namespace terrane::net
