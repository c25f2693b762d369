// Misbehaving players: each is answered or refused, and other players do not notice.
#include "tests/net/hostile_fixture.h"

#include <random>

namespace terrane::net {
namespace {

class HostileTestOfPlay : public HostileTest {};

// ——— invalid messages

TEST_F(HostileTestOfPlay, WhatIsNoMessageEndsTheConnection) {
    ServerSettings settings;
    settings.newPlayersPerHour = 1000;
    start(settings);
    int number = 0;
    const auto sayBytes = [&](const Bytes& bytes) {
        const auto wire = joined(fmt::format("Bob{}", ++number));
        onMessage(server_->state(), wire->id, bytes, server_->now);
        const Refusal why = refusalOf(*wire);
        wire->close();
        return why;
    };
    EXPECT_EQ(sayBytes({}), Refusal::ProtocolError);
    EXPECT_EQ(sayBytes(Bytes(1, std::byte{13})), Refusal::ProtocolError);
    EXPECT_EQ(sayBytes(Bytes(100, std::byte{255})), Refusal::ProtocolError);
    Bytes edit = encode(put(1, {1, 2, 3}));
    edit.push_back(std::byte{0});
    EXPECT_EQ(sayBytes(edit), Refusal::ProtocolError) << "a byte too many";
    edit.resize(edit.size() - 2);
    EXPECT_EQ(sayBytes(edit), Refusal::ProtocolError) << "a byte too few";
    std::mt19937 random(1);
    for (int k = 0; k < 100; ++k) {
        Bytes noise(random() % 60);
        for (std::byte& byte : noise) byte = static_cast<std::byte>(random());
        if (decodeClientMessage(noise)) continue;
        EXPECT_EQ(sayBytes(noise), Refusal::ProtocolError);
    }
}

// ——— floods

TEST_F(HostileTestOfPlay, AFloodOfMessagesEnds) {
    start();
    const auto bob = joined("Bob");
    for (int k = 0; k < 100000; ++k) bob->say(AskPlayers{});
    EXPECT_EQ(refusalOf(*bob), Refusal::TooMuch);
    EXPECT_LT(bob->received, 10000u) << "answers are few";
    EXPECT_EQ(server_->state().clients.playing.size(), 1u);
}

TEST_F(HostileTestOfPlay, AFloodFromManyConnectionsLeavesNothing) {
    start();
    for (int k = 0; k < 250; ++k) {
        TestWire wire(*server_);
        for (int n = 0; n < 400; ++n) wire.say(n == 0 ? ClientMessage(Hello{}) : ClientMessage(Say{"x"}));
        wire.close();
    }
    server_->tick();
    const ServerState& state = server_->state();
    EXPECT_EQ(state.clients.all.size(), 1u);
    EXPECT_EQ(state.clients.playing.size() + state.clients.former.size(), 1u);
    EXPECT_TRUE(state.password.queue.empty() && state.history.rollbacks.empty() && state.changed.empty());
}

TEST_F(HostileTestOfPlay, TooManyWaitingEditsEnd) {
    start();
    const auto bob = joined("Bob");
    bool isRefused = false;
    // At most 120 messages per second, which are allowed.
    for (CommandNumber k = 1; k < 4000 && !isRefused; ++k) {
        bob->say(put(k, nearSpawn()));
        EXPECT_LE(clientOf(*bob).commands.size(), 512u);
        // No job runs: the chunk does not come.
        if (k % 6 == 0) tick(server_->state(), server_->now += kServerTick);
        isRefused = !plays(*bob);
    }
    EXPECT_TRUE(isRefused);
    EXPECT_EQ(refusalOf(*bob), Refusal::TooMuch);
}

TEST_F(HostileTestOfPlay, LargeDataDoesNotWaitInMasses) {
    start();
    const auto bob = joined("Bob");
    const world::SetEntityData large{Bytes(kMaxBlockData)};
    for (CommandNumber k = 1; k <= 300; ++k) bob->say(Edit{k, nearSpawn(), large, {}});
    EXPECT_EQ(refusalOf(*bob), Refusal::TooMuch) << "9 MB wait";
}

TEST_F(HostileTestOfPlay, WhoTalksTooFastIsToldAndStays) {
    start();
    const auto bob = joined("Bob");
    (void)ann_->take();
    for (int k = 0; k < 100; ++k) bob->say(Say{"hey"});
    std::size_t heard = 0;
    for (const ServerMessage& message : ann_->take()) heard += std::holds_alternative<Said>(message);
    EXPECT_LE(heard, 8u);
    EXPECT_TRUE(plays(*bob));
    const auto answers = bob->take();
    EXPECT_EQ(std::get<Said>(answers.back()).text, "you chat too fast");
    clientOf(*bob).role = game::Role::Operator;
    bob->say(Say{"/marks"});
    EXPECT_NE(std::get<Said>(bob->take().back()).text, "you chat too fast") << "commands are not chat";
}

TEST_F(HostileTestOfPlay, ManyPlayersOfAnAddressShareTheChat) {
    start();
    std::vector<std::unique_ptr<TestWire>> crowd;
    for (int k = 0; k < 12; ++k) {
        crowd.push_back(joined(fmt::format("Crowd {}", k)));
        clientOf(*crowd.back()).address.network = "crowd";
    }
    (void)ann_->take();
    for (int k = 0; k < 8; ++k)
        for (const auto& wire : crowd) wire->say(Say{"spam"});
    std::size_t heard = 0;
    for (const ServerMessage& message : ann_->take()) heard += std::holds_alternative<Said>(message);
    EXPECT_LE(heard, 40u) << "not 96";
    EXPECT_GT(heard, 8u);
    EXPECT_EQ(std::get<Said>(crowd.back()->take().back()).text, "too many lines come from your address");
}

// ——— moves and views

TEST_F(HostileTestOfPlay, MovesThatAreNotBelieved) {
    start();
    const auto bob = joined("Bob");
    const WirePose first = clientOf(*bob).pose;
    const auto expectCorrected = [&](const WirePose& pose) {
        (void)bob->take();
        bob->say(Move{pose});
        const auto messages = bob->take();
        const auto* corrected = findMessage<Corrected>(messages);
        ASSERT_TRUE(corrected);
        EXPECT_EQ(corrected->pose, clientOf(*bob).pose);
        EXPECT_EQ(clientOf(*bob).pose, first) << "it stays";
    };
    WirePose far = first;
    far.x += 1000 * 64;
    expectCorrected(far);
    far = first;
    far.z += std::int64_t{1} << 36;
    expectCorrected(far);
    (void)runConsoleLine(server_->state(), "op Bob");
    far = first;
    far.x = std::int64_t{1} << 37;  // 2^31 blocks: one above the limit
    expectCorrected(far);
    far.x = -(std::int64_t{1} << 37) - 1;
    bob->say(Move{far});
    EXPECT_EQ(refusalOf(*bob), Refusal::ProtocolError);
}

TEST_F(HostileTestOfPlay, SpeedIsThatOfAFlight) {
    start();
    const auto bob = joined("Bob");
    // Ten seconds at the maximum speed.
    double furthest = 0;
    WirePose pose = pose_;
    for (int k = 0; k < 200; ++k) {
        for (int n = 0; n < 5; ++n) {
            pose.x += 10 * 64;
            bob->say(Move{pose});
            if (findMessage<Corrected>(bob->take())) pose = clientOf(*bob).pose;
        }
        furthest = std::max(furthest, static_cast<double>(clientOf(*bob).pose.x - pose_.x) / 64);
        server_->tick();
    }
    EXPECT_GT(furthest, 1000);
    EXPECT_LE(furthest, 12 * 120 + 10);
}

TEST_F(HostileTestOfPlay, ViewsAreAroundThePlayer) {
    start();
    const auto bob = joined("Bob");
    const world::ChunkPos own = world::chunkOf(poseOf(pose_).position);
    bob->say(View{{own.x + 5, own.y}, 2, 0});
    server_->tick();
    EXPECT_FALSE(clientOf(*bob).view) << "it does not stand there";
    for (const std::int32_t c : {world::kMinChunk, world::kMaxChunk}) bob->say(View{{c, c}, 255, 65535});
    server_->tick();
    EXPECT_FALSE(clientOf(*bob).view);
    for (int distance = 155; distance <= 255; ++distance)
        bob->say(View{own, static_cast<std::uint8_t>(distance), 65535});
    EXPECT_FALSE(clientOf(*bob).view) << "the last of many is looked at, with the next tick";
    server_->tick();
    ASSERT_TRUE(clientOf(*bob).view);
    EXPECT_EQ(clientOf(*bob).view->viewDistance, server_->state().settings.maxViewDistance);
    for (int k = 0; k < 20; ++k) server_->tick();
    EXPECT_TRUE(findMessage<ViewComplete>(bob->take()));
}

// ——— clients that do not read

TEST_F(HostileTestOfPlay, WhoDoesNotReadIsSentAway) {
    ServerSettings settings;
    settings.maxUnsentBytes = 20000;
    start(settings);
    const auto bob = joined("Bob");
    const std::string line = "say " + std::string(390, 'x');
    for (int k = 0; k < 100 && plays(*bob); ++k) {
        (void)runConsoleLine(server_->state(), line);
        (void)ann_->take();
        server_->tick();
    }
    EXPECT_LT(clientOf(*bob).outgoing.size(), 30000u);
    EXPECT_EQ(refusalOf(*bob), Refusal::TooSlow);
    EXPECT_TRUE(plays(*ann_));
}

}  // namespace
}  // namespace terrane::net
