// Notes between servers: round trips, and arbitrary text.
#include <gtest/gtest.h>

#include <random>

#include "terrane/net_postgres/shared_notes.h"

namespace terrane::net_postgres {
namespace {

template <class Kind>
Kind roundTrip(const Kind& note) {
    const std::string text = noteText(12, note);
    EXPECT_LT(text.size(), 8000u) << "what PostgreSQL takes";
    const auto read = readNote(text);
    EXPECT_TRUE(read);
    EXPECT_EQ(read->server, 12);
    return std::get<Kind>(read->note);
}

TEST(Notes, ReadBack) {
    roundTrip(EditsNote{});
    roundTrip(ClaimsNote{});
    EXPECT_EQ(roundTrip(PlayerNote{7}).player, 7u);
    EXPECT_EQ(roundTrip(JoinedNote{0xFFFFFFFF}).player, 0xFFFFFFFF);
    EXPECT_EQ(roundTrip(LeftNote{3}).player, 3u);
    const PlaceNote place = roundTrip(PlaceNote{{"Dům", {1, 2, 3, 4, 5}, true}});
    EXPECT_EQ(place.change.name, "Dům");
    EXPECT_EQ(place.change.pose, (net::WirePose{1, 2, 3, 4, 5}));
    EXPECT_TRUE(place.change.isGone);
    roundTrip(PasswordNote{});
    EXPECT_EQ(roundTrip(TimeNote{0x80000000}).timeDay, 0x80000000);
    const LineNote line = roundTrip(LineNote{{"Žofie", std::string(400, '\'')}});
    EXPECT_EQ(line.line.name, "Žofie");
    EXPECT_EQ(line.line.text, std::string(400, '\''));
    const net::WirePose far{(std::int64_t{1} << 37) - 1, -(std::int64_t{1} << 37), 5, 65535, -32767};
    const PosesNote poses =
        roundTrip(PosesNote{std::vector(kMaxPosesInNote, net::OtherPlayer{9, far, true})});
    EXPECT_EQ(poses.players.size(), kMaxPosesInNote);
    EXPECT_EQ(poses.players.back().pose, far);
    EXPECT_TRUE(poses.players.back().swings);
    const TilesNote tiles =
        roundTrip(TilesNote{std::vector(kMaxTilesInNote, world::ChunkPos{world::kMinChunk >> 1, -5, 1})});
    EXPECT_EQ(tiles.tiles.back(), (world::ChunkPos{world::kMinChunk >> 1, -5, 1}));
}

TEST(Notes, AnyTextIsANoteOrNone) {
    std::mt19937 random(3);
    const std::string good = noteText(5, PosesNote{{{9, {1, 2, 3, 4, 5}, true}, {10, {}, false}}});
    EXPECT_FALSE(readNote(""));
    EXPECT_FALSE(readNote("5"));
    EXPECT_FALSE(readNote("x"));
    EXPECT_FALSE(readNote(good + "0"));
    int refused = 0;
    for (int round = 0; round < 20000; ++round) {
        std::string text = good;
        for (int k = 0; k < 3; ++k) text[random() % text.size()] = static_cast<char>(random());
        text.resize(random() % (text.size() + 1));
        refused += !readNote(text);
    }
    EXPECT_GT(refused, 10000);
}

}  // namespace
}  // namespace terrane::net_postgres
