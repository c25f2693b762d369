// A server with a well-behaved player, and wires for hostile clients.
#pragma once

#include "terrane/net/server/server_console.h"
#include "tests/net/server_fixture.h"

namespace terrane::net {

inline std::optional<Refused> refusedIn(const std::vector<ServerMessage>& messages) {
    const auto* refused = findMessage<Refused>(messages);
    return refused ? std::optional(*refused) : std::nullopt;
}

// Why the wire was refused; Refusal::Count if it was not.
inline Refusal refusalOf(TestWire& wire) {
    const auto refused = refusedIn(wire.take());
    return refused ? refused->why : Refusal::Count;
}

// The server's answer to the Hello of a wire that has sent nothing yet.
inline Greeting greetingOf(TestWire& wire, const ClientIdentity& identity) {
    wire.say(helloOf(identity));
    return std::get<Greeting>(wire.take().at(0));
}
// A signed Login for such a wire.
inline Login greetedLogin(TestWire& wire, const ClientIdentity& identity) {
    return loginOf(identity, greetingOf(wire, identity), wire.channel);
}

class HostileTest : public testing::Test {
  protected:
    // Ann is in the world; whatever others do, she stays and can chat.
    TestServer& start(const ServerSettings& settings = {}) {
        server_ = std::make_unique<TestServer>(folder_.path(), settings);
        ann_ = std::make_unique<TestWire>(*server_);
        const ServerMessage answer = logIn(*ann_, annsIdentity_);
        EXPECT_TRUE(std::holds_alternative<Joined>(answer));
        pose_ = std::get<Joined>(answer).pose;
        return *server_;
    }
    void TearDown() override {
        if (!server_) return;
        // Long enough to avoid the answer "you chat too fast".
        for (int k = 0; k < 20; ++k) {
            ann_->say(Pong{0});
            server_->tick();
        }
        (void)ann_->take();
        ann_->say(Say{"still here"});
        const auto messages = ann_->take();
        const auto* said = findMessage<Said>(messages);
        ASSERT_TRUE(said) << "Ann was harmed";
        EXPECT_EQ(said->text, "still here");
        ann_.reset();
        server_.reset();
    }
    // A player with this identity in the world.
    std::unique_ptr<TestWire> joined(const ClientIdentity& identity) {
        auto wire = std::make_unique<TestWire>(*server_);
        EXPECT_TRUE(std::holds_alternative<Joined>(logIn(*wire, identity)));
        return wire;
    }
    std::unique_ptr<TestWire> joined(const std::string& name) { return joined(testIdentity(name)); }
    ServerClient& clientOf(const TestWire& wire) { return server_->state().clients.all.at(wire.id); }
    bool plays(const TestWire& wire) {
        const auto found = server_->state().clients.all.find(wire.id);
        return found != server_->state().clients.all.end() &&
               found->second.stage == ServerClient::Stage::Playing;
    }
    // A block above the spawn, near which all players appear.
    world::BlockPos nearSpawn(int dx = 2) const {
        const world::BlockPos eyes = world::blockOf(poseOf(pose_).position);
        return {eyes.x + dx, eyes.y, eyes.z + 2};
    }
    // Loads chunks so that no command waits for them during the next five seconds of server time.
    void loadAround(world::BlockPos pos) {
        for (const world::ChunkPos chunk : world::chunksWithin(world::chunkOf(pos), 1))
            if (world::isInWorld(chunk)) (void)server_->state().session.pipeline().chunkAt(chunk);
    }
    // The decision on a command; ticks until it arrives.
    std::optional<Done> decision(TestWire& wire, CommandNumber number) {
        for (int k = 0; k < kMostTicks; ++k) {
            server_->tick();
            ann_->say(Pong{0});
            for (const ServerMessage& message : wire.take()) {
                if (const auto* done = std::get_if<Done>(&message); done && done->number == number)
                    return *done;
                if (std::holds_alternative<Refused>(message)) return std::nullopt;
            }
        }
        return std::nullopt;
    }
    static Edit put(CommandNumber number, world::BlockPos pos, std::string_view name = "glass") {
        return {number, pos, world::SetBlock{contentBlock(name)}, {}};
    }
    template <class Result>
    void expectDecision(TestWire& wire, const ClientMessage& command, CommandNumber number, Result result) {
        wire.say(command);
        const auto done = decision(wire, number);
        ASSERT_TRUE(done) << "command " << number;
        EXPECT_EQ(static_cast<int>(done->result), static_cast<int>(result)) << "command " << number;
    }

    base::TempFolder folder_;
    ClientIdentity annsIdentity_ = testIdentity("Ann");
    std::unique_ptr<TestServer> server_;
    std::unique_ptr<TestWire> ann_;
    WirePose pose_;
};

}  // namespace terrane::net
