// Messages of both sides, encoded by the same templates (message_codec.h).
#include <gtest/gtest.h>

#include <climits>
#include <limits>
#include <random>

#include "terrane/net/wire/client_message.h"
#include "terrane/net/wire/server_message.h"
#include "tests/net/bytes_of.h"

namespace terrane::net {
namespace {

const WirePose kPose{-1234567, 64, 4096, 40000, -200};

// One of each type, with non-default fields.
std::vector<ClientMessage> clientMessages() {
    PublicKey key{};
    key[31] = std::byte{9};
    Signature signature{};
    signature[0] = std::byte{8};
    return {
        Hello{kMagic, kProtocolVersion, "terrane 0.2"},
        Login{"Ada", key, signature, "secret"},
        Proof{{1, 2, 3, 4, 5, 6, 7, ~std::uint64_t{0}}},
        View{{-5, 70000}, 16, 512, -1600},
        Move{kPose},
        Edit{7, {-1, 2, 3}, world::SetBlock{5, 2}, world::BlockId{4}},
        Fill{8,
             {{{0, -2, -2048}, {4, 5, 2047}}, 6, 1, world::BlockId{2}, {game::ShapeKind::Line, true, false}}},
        Place{9, {1, 2, 3}, {std::byte{1}, std::byte{2}}},
        TakeBack{10, true},
        Say{"hello there"},
        Pong{123456},
        AskPlayers{},
        Leave{},
        AskPack{1, 65536},
        ItemCommand{11, game::MoveStack{{world::BlockPos{-1, 2, 3}, 26}, {{}, 44}, 99}}};
}

std::vector<ServerMessage> serverMessages() {
    Nonce nonce{};
    nonce[5] = std::byte{3};
    WorldOffer offer{{{42, "continents", 3, {-64, 320}}, 77, 88}, {}, {{"isles", "1.2", {}, 4096}}};
    offer.samples[7] = {-9, 11};
    world::Inventory worn(game::kPlayerSlots);
    worn[3] = {"iron_pick", 1, 249};
    const ChunkDifference blocks{{-5, {3, 1, {}}}, {6, {3, 1, {}}}, {900, {2, 0, {}}}};
    return {Greeting{"terrane 0.2", nonce, true},
            offer,
            Joined{12, game::Role::Operator, 24, kPose},
            Refused{Refusal::OtherWorld, "another generator"},
            ChunkEdits{{1, -1, 3}, false, blocks},
            BlocksChanged{{1, 2}, blocks},
            ViewComplete{{3, -4}},
            Done{5, 2, 1000, 3},
            Appears{3, 44, "Ben", kPose},
            Disappears{3},
            Poses{{{1, 2, -3, 4, 5, -6, true}, {2, 0, 0, 0, 7, 8, false}}},
            Said{"Ben", "hello"},
            Clock{0.25, 0.001},
            Corrected{kPose},
            Ping{99},
            PlayerList{{{"Ada", game::Role::Player, 20}, {"Ben", game::Role::Guest, 65535}}},
            RoleChanged{game::Role::Guest},
            Servers{{{"b.example:4000", std::string(64, 'a')}, {"[::1]:1", ""}}},
            PackPart{1, 65536, {std::byte{1}, std::byte{2}}},
            Items{game::Mode::Survival, worn}};
}

TEST(Messages, EachReadsBack) {
    std::size_t k = 0;
    for (const ClientMessage& message : clientMessages()) {
        EXPECT_EQ(message.index(), k++) << "one of each";
        const Bytes bytes = encode(message);
        const auto read = decodeClientMessage(bytes);
        ASSERT_TRUE(read) << nameOf(message) << ": " << read.error().message;
        EXPECT_EQ(encode(*read), bytes) << nameOf(message);
        EXPECT_LE(bytes.size(), kMaxClientMessage);
    }
    k = 0;
    for (const ServerMessage& message : serverMessages()) {
        EXPECT_EQ(message.index(), k++);
        const Bytes bytes = encode(message);
        const auto read = decodeServerMessage(bytes);
        ASSERT_TRUE(read) << k << ": " << read.error().message;
        EXPECT_EQ(encode(*read), bytes) << k;
    }
    EXPECT_EQ(clientMessages().size(), std::variant_size_v<ClientMessage>);
    EXPECT_EQ(serverMessages().size(), std::variant_size_v<ServerMessage>);
}

TEST(Messages, FieldsKeepTheirValues) {
    const auto edit = decodeClientMessage(encode(ClientMessage(clientMessages()[5])));
    const auto& read = std::get<Edit>(*edit);
    EXPECT_EQ(read.number, 7u);
    EXPECT_EQ(read.pos, (world::BlockPos{-1, 2, 3}));
    EXPECT_EQ(std::get<world::SetBlock>(read.change).id, 5);
    EXPECT_EQ(std::get<world::SetBlock>(read.change).state, 2);
    EXPECT_EQ(read.expected, world::BlockId{4});
    const auto move = decodeClientMessage(encode(ClientMessage(Move{kPose})));
    EXPECT_EQ(std::get<Move>(*move).pose, kPose);
    const auto offer = decodeServerMessage(encode(ServerMessage(serverMessages()[1])));
    EXPECT_EQ(std::get<WorldOffer>(*offer).world.identity.generator, "continents");
    EXPECT_EQ(std::get<WorldOffer>(*offer).world.identity.heights, (world::Heights{-64, 320}));
}

TEST(Messages, HeightsOfWorlds) {
    WorldOffer offer;
    for (const world::Heights good : {world::Heights{0, 256}, {-2048, 2048}, {512, 528}}) {
        offer.world.identity.heights = good;
        const auto read = decodeServerMessage(encode(ServerMessage(offer)));
        ASSERT_TRUE(read);
        EXPECT_EQ(std::get<WorldOffer>(*read).world.identity.heights, good);
    }
    for (const world::Heights bad :
         {world::Heights{0, 0}, {256, 0}, {-8, 256}, {0, 255}, {-2064, 0}, {0, 2064}, {INT_MIN, INT_MAX}}) {
        offer.world.identity.heights = bad;
        EXPECT_FALSE(decodeServerMessage(encode(ServerMessage(offer)))) << bad.bottom << " " << bad.top;
    }
}

// Positions above and below all worlds are no messages.
TEST(Messages, PositionsAreInSomeWorld) {
    const Bytes structure(1);
    for (const std::int32_t z : {-2048, -1, 0, 2047}) {
        const auto edit =
            decodeClientMessage(encode(ClientMessage(Edit{1, {1, 2, z}, world::UseBlock{}, {}})));
        ASSERT_TRUE(edit) << z;
        EXPECT_EQ(std::get<Edit>(*edit).pos.z, z);
    }
    for (const std::int32_t z : {-2049, 2048, INT_MIN, INT_MAX}) {
        const game::FillBox fill{{{0, 0, 0}, {0, 0, z}}, 1, 0, {}};
        EXPECT_FALSE(decodeClientMessage(encode(ClientMessage(Edit{1, {1, 2, z}, world::UseBlock{}, {}}))));
        EXPECT_FALSE(decodeClientMessage(encode(ClientMessage(Fill{1, fill})))) << z;
        EXPECT_FALSE(decodeClientMessage(encode(ClientMessage(Place{1, {0, 0, z}, structure})))) << z;
    }
}

// Sums of steps must not overflow, and an edit has blocks.
TEST(Messages, StepsHaveBounds) {
    for (const std::int64_t step : {kMaxPosePosition, 2 * kMaxPosePosition}) {
        for (const std::int64_t way : {step, -step}) {
            const ServerMessage message = Poses{{PoseChange{.slot = 1, .dx = 0, .dy = way}}};
            EXPECT_TRUE(decodeServerMessage(encode(message))) << way;
        }
    }
    for (const std::int64_t step :
         {2 * kMaxPosePosition + 1, -2 * kMaxPosePosition - 1, std::numeric_limits<std::int64_t>::max(),
          std::numeric_limits<std::int64_t>::min()}) {
        const ServerMessage message = Poses{{PoseChange{.slot = 1, .dx = step}}};
        EXPECT_FALSE(decodeServerMessage(encode(message))) << step;
    }
}

// Encoded by hand according to docs/protocol.md.
TEST(Messages, HaveTheBytesOfTheProtocol) {
    EXPECT_EQ(encode(ClientMessage(Edit{7, {-1, 2, 3}, world::SetBlock{5, 2}, world::BlockId{4}})),
              bytesOf({5, 7, 1, 4, 6, 0, 5, 2, 1, 4}));
    EXPECT_EQ(encode(ClientMessage(Edit{7, {-1, 2, -300}, world::SetBlock{5, 2}, world::BlockId{4}})),
              bytesOf({5, 7, 1, 4, 0xD7, 0x04, 0, 5, 2, 1, 4}));
    EXPECT_EQ(
        encode(ServerMessage(BlocksChanged{{1, 2}, {{5, {3, 1, {}}}, {6, {3, 1, {}}}, {900, {2, 0, {}}}}})),
        bytesOf({5, 0, 2, 4, 2, 3, 1, 2, 0, 2, 0x8B, 0x80, 0x40, 0, 0, 0xFA, 0x0D, 1, 0}));
    EXPECT_EQ(encode(ServerMessage(Poses{{{1, 2, -3, 4, 5, -6, true}}})),
              bytesOf({10, 1, 1, 3, 4, 5, 8, 5, 0xFA}));
    EXPECT_EQ(encode(ServerMessage(Clock{0.5, 0})),
              bytesOf({12, 0, 0, 0, 0, 0, 0, 0xE0, 0x3F, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(Messages, TheUsualOnesAreSmall) {
    EXPECT_LE(encode(ClientMessage(Move{wirePose({{100.5, -200.25, 80}, 90, 0})})).size(), 14u);
    EXPECT_LE(encode(ClientMessage(Edit{1000, {100, -200, 80}, world::SetBlock{5, 0}, world::kAir})).size(),
              14u);
    EXPECT_LE(encode(ServerMessage(BlocksChanged{{6, -13}, {{20000, {5, 0, {}}}}})).size(), 14u);
    Poses poses;
    for (std::uint16_t slot = 0; slot < 100; ++slot) poses.changes.push_back({slot, 14, -14, 0, 3, 4, false});
    EXPECT_LE(encode(ServerMessage(poses)).size(), 100u * 7 + 3);
}

// Found by fuzzing: a pose change without flags had two encodings.
TEST(Messages, APoseHasItsDirection) {
    Bytes bytes = encode(ServerMessage(Poses{{{11, 0, 0, 0, 3, 4, false}}}));
    EXPECT_TRUE(decodeServerMessage(bytes));
    bytes.resize(bytes.size() - 2);
    EXPECT_FALSE(decodeServerMessage(bytes));
}

// Every truncation of every message, under the sanitizers: an error, never a message.
TEST(Messages, CutOnesAreRefused) {
    for (const ClientMessage& message : clientMessages()) {
        const Bytes bytes = encode(message);
        for (std::size_t size = 0; size < bytes.size(); ++size)
            EXPECT_FALSE(decodeClientMessage(ByteView(bytes).first(size))) << nameOf(message) << " " << size;
    }
    for (const ServerMessage& message : serverMessages()) {
        const Bytes bytes = encode(message);
        for (std::size_t size = 0; size < bytes.size(); ++size)
            EXPECT_FALSE(decodeServerMessage(ByteView(bytes).first(size))) << message.index() << " " << size;
    }
}

TEST(Messages, WhatFollowsAMessageIsRefused) {
    for (const ClientMessage& message : clientMessages()) {
        Bytes bytes = encode(message);
        bytes.push_back(std::byte{0});
        EXPECT_FALSE(decodeClientMessage(bytes)) << nameOf(message);
    }
}

// A newer client is told so: the rest of its Hello may be anything.
TEST(Messages, AHelloOfAnotherVersionIsRead) {
    Bytes bytes = encode(ClientMessage(Hello{kMagic, kProtocolVersion + 1, "x"}));
    bytes.insert(bytes.end(), 100, std::byte{0xFF});
    const auto read = decodeClientMessage(bytes);
    ASSERT_TRUE(read);
    EXPECT_EQ(std::get<Hello>(*read).version, kProtocolVersion + 1);
    EXPECT_FALSE(decodeClientMessage(encode(ClientMessage(Hello{kMagic + 1, kProtocolVersion, "x"}))));
}

TEST(Messages, AnyBytesAreReadOrRefused) {
    std::mt19937 random(13);
    const auto client = clientMessages();
    const auto server = serverMessages();
    for (int k = 0; k < 40000; ++k) {
        const bool isClient = random() % 2 == 0;
        Bytes bytes =
            isClient ? encode(client[random() % client.size()]) : encode(server[random() % server.size()]);
        for (std::size_t n = 1 + random() % 3; n > 0 && !bytes.empty(); --n)
            bytes[random() % bytes.size()] = static_cast<std::byte>(random());
        // Decoding and encoding is lossless: each message has one form, except for runs of blocks.
        if (isClient) {
            const auto read = decodeClientMessage(bytes);
            const auto* hello = read ? std::get_if<Hello>(&*read) : nullptr;
            if (!read || (hello && hello->version != kProtocolVersion)) continue;
            EXPECT_EQ(encode(*read), bytes);
        } else if (const auto read = decodeServerMessage(bytes)) {
            EXPECT_LE(encode(*read).size(), bytes.size());
        }
    }
}

TEST(WirePose, IsNearThePose) {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> place(-2147483648.0, 2147483647.0), height(-2100, 2100);
    std::uniform_real_distribution<float> turn(-720, 720), up(-90, 90);
    for (int k = 0; k < 1000; ++k) {
        const world::Pose pose{{place(random), place(random), height(random)}, turn(random), up(random)};
        const world::Pose read = poseOf(wirePose(pose));
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(read.position[axis], pose.position[axis], 0.5 / kPoseSteps + 1e-9);
        EXPECT_NEAR(std::remainder(read.yaw - pose.yaw, 360), 0, 0.004);
        EXPECT_NEAR(read.pitch, pose.pitch, 0.003);
        EXPECT_EQ(wirePose(read), wirePose(pose));
    }
}

}  // namespace
}  // namespace terrane::net
