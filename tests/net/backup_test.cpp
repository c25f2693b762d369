// Backups of a running server: while players build, copies are taken, opened and compared with the moment at
// which they were begun.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#ifndef _WIN32
#include <sys/mount.h>
#endif

#include <fstream>
#include <map>
#include <set>
#include <thread>

#include "terrane/game/places.h"
#include "terrane/net/server/server_backup.h"
#include "terrane/net/server/server_console.h"
#include "terrane/store/saves/backup_files.h"
#include "terrane/store/saves/save_check.h"
#include "tests/net/backup_checks.h"
#include "tests/support/depth.h"

namespace terrane::net {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

constexpr int kBuilders = 30;
constexpr int kHeights = 4;  // blocks above each other that a builder changes in turn
constexpr const char* kWritten[] = {"stone", "glass", "dirt", "oak_planks", "bricks"};

// A player who writes increasing numbers: the n-th block is the next in the builder's column, of the next
// type.
class Builder {
  public:
    Builder(TestServer& server, int number)
        : number_(number), wire_(server), identity_(testIdentity(fmt::format("Builder {}", number))) {
        const ServerMessage answer = logIn(wire_, identity_);
        EXPECT_TRUE(std::holds_alternative<Joined>(answer));
        if (const auto* joined = std::get_if<Joined>(&answer)) pose_ = joined->pose;
        spawn_ = world::blockOf(poseOf(pose_).position);
        wire_.say(View{world::chunkOf(poseOf(pose_).position), 2, 0});
    }
    void act() {
        for (const ServerMessage& message : wire_.take())
            if (const auto* ping = std::get_if<Ping>(&message)) wire_.say(Pong{ping->time});
        pose_.yaw = static_cast<decltype(pose_.yaw)>(written_);
        wire_.say(Move{pose_});
        const world::BlockPos pos{spawn_.x + number_ % 6 - 3, spawn_.y + number_ / 6 - 2,
                                  spawn_.z + 2 + static_cast<int>(written_ % kHeights)};
        const world::BlockId id = contentBlock(kWritten[written_ % std::size(kWritten)]);
        ++written_;
        wire_.say(Edit{static_cast<CommandNumber>(written_), pos, world::SetBlock{id, 0}, std::nullopt});
    }
    world::Pose pose() const { return poseOf(pose_); }
    const std::string& name() const { return identity_.name; }

  private:
    int number_;
    std::uint32_t written_ = 0;
    TestWire wire_;
    ClientIdentity identity_;
    WirePose pose_;
    world::BlockPos spawn_{};
};

// What a backup must have.
struct Moment {
    std::int64_t newest = 0;
    std::map<std::string, world::Pose> poses;
    std::vector<std::string> places, claims;
    double timeDay = 0;
};

Moment momentOf(ServerState& server, const std::vector<std::unique_ptr<Builder>>& builders) {
    Moment moment{server.history.newest, {}, {}, {}, server.session.clock.timeDay};
    for (const auto& builder : builders) moment.poses[builder->name()] = builder->pose();
    for (const game::Place& place : game::savedPlaces(server.session.store()))
        moment.places.push_back(place.name);
    for (const game::Claim& claim : server.clients.known.claims().all()) moment.claims.push_back(claim.name);
    return moment;
}

void expectRecords(const fs::path& save, const Moment& moment) {
    auto records = SqliteRecords::open(store::serverFilePath(save), contentBlocks()).value();
    std::map<std::string, world::Pose> poses;
    const auto players = records->players().value();
    for (const KnownPlayer& player : players) {
        poses[player.name] = player.pose.value_or(world::Pose{});
        EXPECT_EQ(player.role, game::Role::Player) << player.name;
    }
    EXPECT_EQ(poses, moment.poses);
    std::vector<std::string> claims;
    const auto all = records->claims().value();
    for (const game::Claim& claim : all) claims.push_back(claim.name);
    EXPECT_EQ(claims, moment.claims);
}

void expectOpens(const fs::path& save, const Moment& moment) {
    const auto checked = store::checkSave(save, contentBlocks());
    ASSERT_TRUE(checked) << checked.error().message;
    EXPECT_FALSE(checked->isDamaged());
    TestServer server(serverParts(save),
                      SqliteRecords::open(store::serverFilePath(save), contentBlocks()).value());
    EXPECT_EQ(server.state().history.newest, moment.newest);
    EXPECT_NEAR(server.state().session.clock.timeDay, moment.timeDay, 1e-4) << "saves store a few digits";
    std::vector<std::string> places;
    for (const game::Place& place : game::savedPlaces(server.state().session.store()))
        places.push_back(place.name);
    EXPECT_EQ(places, moment.places);
    Builder late(server, kBuilders + 1);
    for (int k = 0; k < kMostTicks && server.state().history.newest <= moment.newest; ++k) {
        late.act();
        server.tick();
    }
    EXPECT_GT(server.state().history.newest, moment.newest) << "players build in it";
}

class BackupTest : public testing::Test {
  protected:
    BackupTest() {
        fs::create_directories(to_);
        ServerSettings settings = patientSettings();
        settings.maxPlayersOfAddress = 2 * kBuilders;
        fs::create_directories(folder_ / "s");
        server_ = std::make_unique<TestServer>(folder_ / "s", settings);
    }
    ServerState& state() { return server_->state(); }
    std::string run(const std::string& line) { return runConsoleLine(state(), line); }
    void addBuilders(int count) {
        for (int k = 0; k < count; ++k) builders_.push_back(std::make_unique<Builder>(*server_, k));
        server_->tick();
    }
    // A tick in which everyone builds. The threads that write to disk run beside it.
    void buildTick() {
        for (const auto& builder : builders_) builder->act();
        net::tick(state(), server_->now += kServerTick);
        state().session.jobs().waitIdle();
    }
    // Ticks until the backup has ended.
    void goOn() {
        do buildTick();
        while (state().backup.running);
    }
    void expectNoFiles() { EXPECT_TRUE(fs::is_empty(to_)) << "no partial file stays"; }

    base::TempFolder folder_;
    fs::path to_ = folder_ / "b";
    std::unique_ptr<TestServer> server_;
    std::vector<std::unique_ptr<Builder>> builders_;
};

TEST_F(BackupTest, IsOneMomentWhileThirtyPlayersBuild) {
    addBuilders(kBuilders);
    const int count = atDepth(6, 100);
    for (int k = 0; k < count && !HasFailure(); ++k) {
        for (int ticks = 0; ticks <= k % 7; ++ticks) buildTick();
        if (k % 3 == 1) server_->finishWrites();
        if (k % 4 == 2) {
            ASSERT_TRUE(state().session.store().flush());
        }
        (void)run("mark 1 2 70 before");
        (void)run("claim before 900 900 910 910 \"Builder 1\"");
        const Moment moment = momentOf(state(), builders_);
        const fs::path save = to_ / fmt::format("{}.sqlite", k);
        ASSERT_THAT(run("backup " + save.string()), StartsWith("backing up to "));
        (void)run("unmark before");
        (void)run("unclaim before");
        (void)run("mark 1 2 70 after");
        (void)run("op \"Builder 2\"");
        goOn();
        EXPECT_GT(state().history.newest, moment.newest) << "edits went on";
        ASSERT_TRUE(fs::exists(save)) << k;
        EXPECT_FALSE(fs::exists(save.string() + ".part"));
        expectChunksAreHistory(save, moment.newest);
        expectRecords(save, moment);
        expectOpens(save, moment);
        for (const auto& entry : fs::directory_iterator(to_)) fs::remove(entry.path());
        (void)run("unmark after");
        (void)run("deop \"Builder 2\"");
    }
    EXPECT_GT(state().history.newest, kBuilders * count) << "all built all the time";
}

// Another program copies the files of the running server, whatever its threads have written so far.
TEST_F(BackupTest, OfAnotherProgramHasWhatIsOnDisk) {
    addBuilders(kBuilders);
    for (int k = 0; k < atDepth(4, 30) && !HasFailure(); ++k) {
        for (int ticks = 0; ticks <= k % 7; ++ticks) buildTick();
        if (k % 3 == 1) {
            ASSERT_TRUE(state().session.store().flush());
        }
        if (k % 3 == 2) {
            ASSERT_TRUE(saveEverything(state()));
        }
        server_->finishWrites();
        const std::int64_t durable = state().history.newest;
        buildTick();
        const fs::path save = to_ / fmt::format("{}.sqlite", k);
        auto copy = copySaved(folder_ / "s" / "w.sqlite", contentBlocks());
        ASSERT_TRUE(copy) << copy.error().message;
        for (int ticks = 0; ticks < 3; ++ticks) buildTick();
        ASSERT_TRUE(copy->records(store::serverFilePath(save), {}));
        ASSERT_TRUE(copy->world(save, {}));
        const std::int64_t newest = store::readHistoryEnds(store::serverFilePath(save))->newest;
        EXPECT_GE(newest, durable);
        // A server adds the end of the history to the chunks.
        TestServer(serverParts(save),
                   SqliteRecords::open(store::serverFilePath(save), contentBlocks()).value());
        expectChunksAreHistory(save, newest);
    }
}

TEST_F(BackupTest, HasTheServersKeyAndSettings) {
    const auto write = [](const fs::path& path, const std::string& text) {
        std::ofstream(path) << text;
        fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
    };
    write(folder_ / "s" / "w.server.pem", "a key");
    write(folder_ / "s" / "w.server.toml", "port = 1");
    ASSERT_THAT(run("backup " + (to_ / "x.sqlite").string()), StartsWith("backing up"));
    goOn();
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(to_)) names.insert(entry.path().filename());
    EXPECT_EQ(names, (std::set<std::string>{"x.sqlite", "x.server.sqlite", "x.server.pem", "x.server.toml"}));
    EXPECT_EQ(fs::status(to_ / "x.server.pem").permissions(), fs::perms::owner_read | fs::perms::owner_write)
        << "a key stays secret";
}

TEST_F(BackupTest, RefusesFilesThatExistOrBelongToTheWorld) {
    const auto refused = [&](const fs::path& path) {
        const std::string answer = run("backup \"" + path.string() + "\"");
        EXPECT_FALSE(state().backup.running) << answer;
        EXPECT_EQ(answer.find('\n'), std::string::npos);
        return answer;
    };
    const fs::path own = folder_ / "s";
    EXPECT_THAT(refused(own / "w.sqlite"), HasSubstr("w.sqlite: is a file of the world itself"));
    EXPECT_THAT(refused(own / ".." / "s" / "w.sqlite"), HasSubstr("is a file of the world itself"));
    EXPECT_THAT(refused(own / "w.server.sqlite"), HasSubstr("the file of a backup is NAME.sqlite"));
    EXPECT_THAT(refused(own / "w.map.sqlite"), HasSubstr("the file of a backup is NAME.sqlite"));
    EXPECT_THAT(refused(to_ / "x.txt"), HasSubstr("the file of a backup is NAME.sqlite"));
    EXPECT_THAT(refused(to_ / "no" / "x.sqlite"), HasSubstr("there is no folder"));
    EXPECT_THAT(refused("postgresql:///x"), HasSubstr("a backup is a file"));
    fs::create_directory_symlink(own, to_ / "link");
    EXPECT_THAT(refused(to_ / "link" / "w.sqlite"), HasSubstr("is a file of the world itself"));
    fs::remove(to_ / "link");
    expectNoFiles();
    for (const char* name : {"x.sqlite", "x.server.sqlite", "x.sqlite-wal", "x.server.pem"}) {
        std::ofstream(to_ / name) << "mine";
        EXPECT_THAT(refused(to_ / "x.sqlite"), HasSubstr(std::string(name) + ": exists;"));
        EXPECT_EQ(fs::file_size(to_ / name), 4u);
        fs::remove(to_ / name);
    }
    expectNoFiles();
    EXPECT_THAT(refused("\u051d"), HasSubstr("looks like the name of the world \"w\"")) << "Cyrillic";
    EXPECT_THAT(refused("/proc/x.sqlite"), HasSubstr("/proc/x.sqlite"));
    EXPECT_EQ(run("backup"), "expected: backup NAME|FILE");
}

TEST_F(BackupTest, OperatorsNameFilesBesideTheWorld) {
    TestWire wire(*server_);
    (void)logIn(wire, testIdentity("Ann"));
    (void)run("op Ann");
    const auto answer = [&](const std::string& line) {
        (void)wire.take();
        wire.say(Say{line});
        std::string text;
        for (const ServerMessage& message : wire.take())
            if (const auto* said = std::get_if<Said>(&message)) text += said->text;
        return text;
    };
    for (const std::string& path : {std::string("x.sqlite"), std::string("../x")})
        for (const char* start : {"/backup ", "/ backup "})
            EXPECT_EQ(answer(start + path), "in the chat a backup is a name; the console takes a path");
    EXPECT_THAT(answer("/backup monday"), HasSubstr("/s/monday.sqlite"));
    EXPECT_THAT(answer("/backup tuesday"), StartsWith("a backup is being written: "));
    while (!state().backup.running->isDone()) std::this_thread::yield();
    server_->tick();
    std::string text;
    for (const ServerMessage& message : wire.take())
        if (const auto* said = std::get_if<Said>(&message)) text += said->text;
    EXPECT_THAT(text, HasSubstr("monday.sqlite is complete"));
    EXPECT_TRUE(fs::exists(folder_ / "s" / "monday.server.sqlite"));
}

#ifndef _WIN32  // no small file systems

TEST_F(BackupTest, LeavesNothingIfTheDiskIsFull) {
    if (::mount("tmpfs", to_.c_str(), "tmpfs", 0, "size=48k") != 0)
        GTEST_SKIP() << "a small file system cannot be mounted here";
    addBuilders(3);
    for (int k = 0; k < 5; ++k) buildTick();
    testing::internal::CaptureStderr();
    EXPECT_THAT(run("backup " + (to_ / "x.sqlite").string()), StartsWith("backing up"));
    goOn();
    const std::string log = testing::internal::GetCapturedStderr();
    EXPECT_THAT(log, HasSubstr("the backup failed: "));
    EXPECT_THAT(log, HasSubstr("the disk is full"));
    expectNoFiles();
    ::umount2(to_.c_str(), MNT_DETACH);
}

#endif

TEST_F(BackupTest, OfAServerThatStopsIsNoFile) {
    addBuilders(2);
    buildTick();
    EXPECT_THAT(run("backup " + (to_ / "x.sqlite").string()), StartsWith("backing up"));
    ASSERT_TRUE(stop(state(), "the end"));
    EXPECT_FALSE(state().backup.running);
    EXPECT_FALSE(fs::exists(to_ / "x.sqlite.part"));
    EXPECT_EQ(fs::exists(to_ / "x.sqlite"), fs::exists(to_ / "x.server.sqlite")) << "all files or none";
}

// A folder or file of the name may be of a killed program or somebody's own: it may hold the world itself.
TEST_F(BackupTest, DeletesNothingThatHasTheNameOfItsFolder) {
    const fs::path part = to_ / "x.sqlite.part";
    const auto refuses = [&] {
        EXPECT_THAT(run("backup " + (to_ / "x.sqlite").string()),
                    HasSubstr("x.sqlite.part: exists; if it is"));
        EXPECT_FALSE(state().backup.running);
    };
    fs::create_directories(part);
    std::ofstream(part / "x.sqlite") << "partial";
    refuses();
    EXPECT_EQ(fs::file_size(part / "x.sqlite"), 7u);
    fs::remove_all(part);
    std::ofstream(part) << "mine";
    refuses();
    EXPECT_EQ(fs::file_size(part), 4u);
    fs::remove(part);
    fs::create_symlink("elsewhere", part);
    refuses();
    EXPECT_TRUE(fs::is_symlink(part));
}

}  // namespace
}  // namespace terrane::net
