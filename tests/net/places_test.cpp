// Named places on a server, and changes reported to maps.
#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <set>

#include "terrane/game/places.h"
#include "terrane/net/server/server_console.h"
#include "tests/net/server_fixture.h"

namespace terrane::net {
namespace {

class MarkedPlaces : public ::testing::Test {
  protected:
    MarkedPlaces() {
        (void)logIn(ann_, testIdentity("Ann"));
        server_.tick();
        (void)ann_.take();
    }
    // The server's answers to a line of chat.
    std::string answer(TestWire& wire, const std::string& line) {
        wire.say(Say{line});
        std::string text;
        for (const ServerMessage& message : wire.take())
            if (const auto* said = std::get_if<Said>(&message)) text += said->text;
        return text;
    }
    std::string run(std::string_view line) { return runConsoleLine(server_.state(), line); }
    std::vector<game::Place> places() { return game::savedPlaces(server_.state().session.store()); }

    base::TempFolder folder_;
    TestServer server_{folder_.path()};
    TestWire ann_{server_};
};

TEST_F(MarkedPlaces, APlayerNamesWhereItStands) {
    EXPECT_EQ(answer(ann_, "/mark  The old mill "), "The old mill is marked");
    ASSERT_EQ(places().size(), 1u);
    EXPECT_EQ(places()[0].name, "The old mill");
    const auto at = poseOf(server_.state().clients.all.begin()->second.pose).position;
    EXPECT_EQ(places()[0].pose.position, at);
    EXPECT_EQ(answer(ann_, "/mark   "), "a place needs a name: mark NAME");
    EXPECT_EQ(answer(ann_, "/mark"), "only operators can give commands");
}

TEST_F(MarkedPlaces, OperatorsAloneMoveThem) {
    EXPECT_EQ(run("mark 10 -20.5 80 The mill"), "The mill is marked");
    EXPECT_EQ(answer(ann_, "/mark The mill"),
              "there is a place The mill of another: only operators can move it");
    EXPECT_EQ(places()[0].pose.position, glm::dvec3(10, -20.5, 80));
    (void)run("op Ann");
    (void)ann_.take();
    EXPECT_EQ(answer(ann_, "/mark The mill"), "The mill is marked");
    EXPECT_NE(places()[0].pose.position, glm::dvec3(10, -20.5, 80));
    EXPECT_EQ(places().size(), 1u);
}

TEST_F(MarkedPlaces, NamesFollowTheRule) {
    ASSERT_EQ(run("mark 1 2 70 Mill"), "Mill is marked");
    EXPECT_EQ(answer(ann_, "/mark \u3164"), "a name cannot have the character U+3164");
    EXPECT_EQ(answer(ann_, "/mark Mi1l"), "the name Mi1l looks like that of the place Mill");
    EXPECT_EQ(run("mark 1 2 70 Mi\u200bll"), "a name cannot have the character U+200B");
    EXPECT_EQ(places().size(), 1u);
    EXPECT_EQ(answer(ann_, "/mark Cafe\u0301"), "Caf\u00e9 is marked");
    EXPECT_EQ(run("unmark Cafe\u0301"), "Caf\u00e9 is no longer marked");
}

TEST_F(MarkedPlaces, APlayerHasAShare) {
    const std::size_t share = server_.state().settings.maxPlacesOfPlayer;
    for (std::size_t k = 0; k < share; ++k) {
        EXPECT_EQ(answer(ann_, fmt::format("/mark spam {}", k)), fmt::format("spam {} is marked", k));
        server_.now += std::chrono::seconds(2);
        server_.tick();
    }
    EXPECT_EQ(answer(ann_, "/mark one more"),
              "you have named 5 places, the maximum of a player: remove one with /unmark NAME");
    EXPECT_EQ(answer(ann_, "/mark spam 1"), "spam 1 is marked") << "its own place moves";
    TestWire bob(server_);
    (void)logIn(bob, testIdentity("Bob"));
    server_.tick();
    (void)bob.take();
    (void)ann_.take();
    EXPECT_EQ(answer(bob, "/unmark spam 1"), "you have named no place spam 1");
    EXPECT_EQ(answer(bob, "/mark home"), "home is marked") << "others still have their share";
    EXPECT_EQ(answer(ann_, "/unmark spam 1"), "spam 1 is no longer marked");
    EXPECT_EQ(answer(ann_, "/mark one more"), "one more is marked");
    (void)run("unmark spam 2");
    EXPECT_EQ(answer(ann_, "/mark spam 2"), "spam 2 is marked") << "what an operator removes is free";
}

TEST_F(MarkedPlaces, TheLastOnesAreForOperators) {
    for (std::size_t k = 0; k + kPlacesOfOperators < game::kMaxPlaces; ++k)
        (void)run(fmt::format("mark 0 0 70 {}", k));
    EXPECT_EQ(answer(ann_, "/mark home"), "there are 160 named places: only operators can name more");
    (void)run("op Ann");
    (void)ann_.take();
    EXPECT_EQ(answer(ann_, "/mark home"), "home is marked");
}

TEST_F(MarkedPlaces, GuestsMarkNothing) {
    (void)run("guest Ann");
    (void)ann_.take();
    EXPECT_EQ(answer(ann_, "/mark here"), "guests cannot mark places");
    EXPECT_TRUE(places().empty());
}

TEST_F(MarkedPlaces, AreListedAndRemoved) {
    (void)run("mark 1 2 70 A");
    (void)run("mark 3 4 70 B");
    EXPECT_EQ(run("marks"), "2 places\nA at 1 2 70\nB at 3 4 70");
    EXPECT_EQ(run("unmark A"), "A is no longer marked");
    EXPECT_EQ(run("unmark A"), "there is no place A: marks lists them");
    EXPECT_EQ(places().size(), 1u);
}

TEST_F(MarkedPlaces, OddPlacesAreRefused) {
    for (const char* line : {"mark 1 2 x A", "mark nan 2 3 A", "mark 1e300 2 3 A", "mark 1 1e12 3 A",
                             "mark inf 0 0 A", "mark 1e150 0 0 A", "mark 0 0 1e12 A"})
        EXPECT_FALSE(run(line).ends_with("is marked")) << line;
    EXPECT_TRUE(places().empty());
    for (std::size_t k = 0; k < game::kMaxPlaces; ++k) (void)run(fmt::format("mark 0 0 70 {}", k));
    EXPECT_EQ(run("mark 0 0 70 one more"), "there are 200 named places, the maximum: remove one with unmark");
    EXPECT_EQ(run("mark 5 0 70 7"), "7 is marked") << "it moves";
}

TEST(SavedPlaces, StayWithTheWorld) {
    base::TempFolder folder;
    for (const char* places : {"0 places", "1 place\nhome at 1 2 70"}) {
        TestServer server(folder.path());
        EXPECT_EQ(runConsoleLine(server.state(), "marks"), places);
        (void)runConsoleLine(server.state(), "mark 1 2 70 home");
        ASSERT_TRUE(stop(server.state(), "the test ends"));
    }
}

TEST(SavedPlaces, KeepTheirOwner) {
    base::TempFolder folder;
    const ClientIdentity identity = testIdentity("Ann");
    const auto answers = [&](TestServer& server, const std::string& line) {
        TestWire ann(server);
        (void)logIn(ann, identity);
        server.tick();
        (void)ann.take();
        ann.say(Say{line});
        std::string text;
        for (const ServerMessage& message : ann.take())
            if (const auto* said = std::get_if<Said>(&message)) text += said->text;
        return text;
    };
    {
        TestServer server(folder.path());
        EXPECT_EQ(answers(server, "/mark home"), "home is marked");
        ASSERT_TRUE(stop(server.state(), "the test ends"));
    }
    TestServer server(folder.path());
    EXPECT_EQ(answers(server, "/unmark home"), "home is no longer marked");
}

// Edits are reported at once, the tiles above them once the world is saved.
TEST(ChangedChunks, AreTold) {
    base::TempFolder folder;
    TestServer server(folder.path());
    std::set<world::ChunkPos> told;
    server.state().edits.onChanged = [&](std::span<const world::ChunkPos> chunks) {
        told.insert(chunks.begin(), chunks.end());
    };
    TestPlayer ann(server, testIdentity("Ann"));
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.isLoaded(); }));
    const glm::ivec3 eyes(glm::floor(ann.pose.position));
    EXPECT_TRUE(told.empty());
    // A tower: a single block may change no tile.
    for (int k = 0; k < 48; ++k)
        ASSERT_EQ(ann.put({eyes.x / 4 * 4 + k % 4, eyes.y / 4 * 4 + k / 4 % 4, eyes.z + 2 + k / 16}, "stone"),
                  game::EditResult::Applied);
    const world::ChunkPos chunk = world::chunkOf(world::BlockPos{eyes.x / 4 * 4, eyes.y / 4 * 4, 0});
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return told.contains(chunk); }));
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.world->undecidedCount() == 0; }));
    const world::ChunkPos tile{chunk.x >> 1, chunk.y >> 1, 1};
    (void)runConsoleLine(server.state(), "save");
    EXPECT_TRUE(stepUntil(server, {&ann}, [&] { return told.contains(tile); }));
    server.state().edits.onChanged = nullptr;
}

}  // namespace
}  // namespace terrane::net
