#include "terrane/web/tile_service.h"

#include <deque>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <thread>

#include "terrane/content/built_in.h"
#include "terrane/store/overlay_store.h"
#include "tests/base/wait_until.h"
#include "tests/map/map_fixture.h"

namespace terrane::web {
namespace {

using map::Layer;
using map::MapTile;
using world::ChunkPos;

constexpr MapTile kTile{Layer::Day, 2, 0, 0};  // 4×4 chunks and their neighbors

struct Waiter {
    TileService::Ready ready() {
        return [this](base::Result<TileFilePtr> file) {
            ++calls;
            result = std::move(file);
        };
    }
    TileFilePtr file() const { return calls == 1 && *result ? **result : nullptr; }

    int calls = 0;
    std::optional<base::Result<TileFilePtr>> result;
};

// Reports a visible edit.
void change(TileService& tiles, ChunkPos chunk) {
    tiles.addEdited(std::span(&chunk, 1));
    tiles.invalidate(std::span(&chunk, 1));
}

// Tests decide when workers and the functions that they post run.
class TileServiceTest : public testing::Test {
  protected:
    static map::MapPainter makePainter(const gen::LevelGenerators& generators) {
        const auto textures = content::builtInTextures();
        return map::MapPainter::create({generators, contentBlocks(), textures}).value();
    }
    TileService::Parts parts() {
        return {.painter = painter_,
                .jobs = jobs_,
                .post = [this](std::function<void()> work) { posted_.push_back(std::move(work)); },
                .liveChunk = [this](ChunkPos pos) -> world::ChunkPtr {
                    const auto found = live_.find(pos);
                    return found == live_.end() ? nullptr : found->second;
                }};
    }
    void runPosted() {
        while (!posted_.empty()) {
            const auto work = std::move(posted_.front());
            posted_.pop_front();
            work();
        }
    }
    void runAll() {
        do runPosted();
        while (jobs_.runNext());
        runPosted();
    }
    TileFilePtr paint(TileService& tiles, const MapTile& tile) {
        Waiter waiter;
        tiles.request(tile, waiter.ready());
        runAll();
        return waiter.file();
    }
    void build(TileService& tiles, ChunkPos chunk, std::string_view block) {
        live_[chunk] = map::chunkWithPillar(map::generatorsOf("flat"), chunk, 5, 5, block);
        change(tiles, chunk);
    }

    map::MapPainter painter_ = makePainter(map::generatorsOf("flat"));
    base::JobSystem jobs_{0};
    std::deque<std::function<void()>> posted_;
    std::map<ChunkPos, world::ChunkPtr> live_;
};

TEST_F(TileServiceTest, ATileIsPaintedOnceForAllWhoAsk) {
    TileService tiles(parts());
    Waiter waiters[3];
    for (Waiter& waiter : waiters) EXPECT_NE(tiles.request(kTile, waiter.ready()), 0u);
    EXPECT_EQ(jobs_.queuedCount(), 1u);
    EXPECT_EQ(tiles.statistics().waiting, 1u);
    EXPECT_TRUE(jobs_.runNext());
    EXPECT_EQ(waiters[0].calls, 0) << "answers come on the web's thread";
    runAll();
    for (const Waiter& waiter : waiters) {
        ASSERT_TRUE(waiter.file());
        EXPECT_EQ(waiter.file(), waiters[0].file());
    }
    const auto image = base::decodePng(waiters[0].file()->png, "tile");
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width, 256);
    EXPECT_FALSE(waiters[0].file()->tag.empty());
    EXPECT_EQ(tiles.statistics().painted, 1u);
    EXPECT_EQ(tiles.statistics().waiting, 0u);
    EXPECT_GT(tiles.statistics().paintSeconds, 0);
}

TEST_F(TileServiceTest, MemoryAnswersAtOnce) {
    TileService tiles(parts());
    const TileFilePtr first = paint(tiles, kTile);
    Waiter waiter;
    EXPECT_EQ(tiles.request(kTile, waiter.ready()), 0u);
    EXPECT_EQ(waiter.file(), first);
    EXPECT_EQ(jobs_.queuedCount(), 0u);
    EXPECT_EQ(tiles.statistics().fromMemory, 1u);
    EXPECT_EQ(tiles.statistics().count, 1u);
    EXPECT_GE(tiles.statistics().bytes, first->png.size());
}

TEST_F(TileServiceTest, NobodyWaitsNobodyPaints) {
    TileService tiles(parts());
    Waiter one, two;
    const auto first = tiles.request(kTile, one.ready()), second = tiles.request(kTile, two.ready());
    tiles.cancel(first);
    EXPECT_EQ(jobs_.queuedCount(), 1u) << "the other one waits";
    tiles.cancel(second);
    tiles.cancel(second);
    tiles.cancel(12345);
    EXPECT_EQ(jobs_.queuedCount(), 0u);
    EXPECT_EQ(tiles.statistics().waiting, 0u);
    EXPECT_EQ(tiles.statistics().cancelled, 1u);
    runAll();
    EXPECT_EQ(one.calls + two.calls, 0);
    EXPECT_TRUE(paint(tiles, kTile)) << "whoever asks later gets it";
}

TEST_F(TileServiceTest, OthersWaitOn) {
    TileService tiles(parts());
    Waiter one, two;
    tiles.cancel(tiles.request(kTile, one.ready()));
    const auto ticket = tiles.request(kTile, one.ready());
    tiles.request(kTile, two.ready());
    tiles.cancel(ticket);
    runAll();
    EXPECT_EQ(one.calls, 0);
    EXPECT_TRUE(two.file());
}

TEST_F(TileServiceTest, WhatIsPaintedAlreadyIsKept) {
    TileService tiles(parts());
    Waiter waiter;
    const auto ticket = tiles.request(kTile, waiter.ready());
    EXPECT_TRUE(jobs_.runNext());
    tiles.cancel(ticket);
    runPosted();
    EXPECT_EQ(waiter.calls, 0);
    EXPECT_EQ(tiles.request(kTile, waiter.ready()), 0u) << "from memory";
    EXPECT_TRUE(waiter.file());
    EXPECT_EQ(tiles.statistics().cancelled, 0u);
}

TEST_F(TileServiceTest, TooManyAreBusy) {
    auto few = parts();
    few.maxWaiting = 2;
    TileService tiles(std::move(few));
    Waiter waiters[3], again;
    for (int k = 0; k < 3; ++k) {
        const auto ticket = tiles.request({Layer::Day, 2, k, 0}, waiters[k].ready());
        EXPECT_EQ(ticket == 0, k == 2);
    }
    ASSERT_EQ(waiters[2].calls, 1);
    ASSERT_FALSE(*waiters[2].result);
    EXPECT_EQ(waiters[2].result->error().code, base::ErrorCode::Busy);
    EXPECT_NE(tiles.request({Layer::Day, 2, 1, 0}, again.ready()), 0u) << "that one is painted anyway";
    EXPECT_EQ(tiles.statistics().refused, 1u);
    EXPECT_EQ(tiles.statistics().waiting, 2u);
    runAll();
    EXPECT_TRUE(waiters[0].file());
    EXPECT_TRUE(waiters[1].file());
    EXPECT_TRUE(again.file());
    EXPECT_TRUE(paint(tiles, {Layer::Day, 2, 2, 0})) << "there is room again";
}

TEST_F(TileServiceTest, AnEditIsPaintedAnew) {
    TileService tiles(parts());
    const MapTile far{Layer::Day, 2, 5, 5};
    const TileFilePtr before = paint(tiles, kTile), beforeFar = paint(tiles, far);
    build(tiles, {1, 1}, "lamp_red");
    const TileFilePtr after = paint(tiles, kTile);
    ASSERT_TRUE(before && after);
    EXPECT_NE(after->tag, before->tag);
    EXPECT_NE(after->png, before->png);
    EXPECT_EQ(paint(tiles, far), beforeFar) << "what does not show it stays in memory";
    // The same image has the same tag.
    const ChunkPos chunk{1, 1};
    change(tiles, chunk);
    const TileFilePtr same = paint(tiles, kTile);
    EXPECT_NE(same, after);
    EXPECT_EQ(same->tag, after->tag);
}

TEST_F(TileServiceTest, WhatChangesWhileItIsPaintedIsNotKept) {
    TileService tiles(parts());
    const TileFilePtr before = paint(tiles, kTile);
    build(tiles, {1, 1}, "lamp_red");
    Waiter early, late;
    tiles.request(kTile, early.ready());
    EXPECT_TRUE(jobs_.runNext());
    build(tiles, {2, 2}, "lamp_green");
    tiles.request(kTile, late.ready());
    runAll();
    ASSERT_TRUE(early.file() && late.file());
    EXPECT_NE(early.file()->tag, before->tag);
    EXPECT_NE(late.file()->tag, early.file()->tag) << "who asked after the second edit sees it";
    EXPECT_EQ(paint(tiles, kTile), late.file());
    EXPECT_EQ(tiles.statistics().waiting, 0u);
}

TEST_F(TileServiceTest, ACancelAfterAChangeIsOfItsOwnImage) {
    TileService tiles(parts());
    Waiter early, late;
    const auto ticket = tiles.request(kTile, early.ready());
    build(tiles, {1, 1}, "lamp_red");
    tiles.request(kTile, late.ready());
    EXPECT_EQ(jobs_.queuedCount(), 2u);
    tiles.cancel(ticket);
    EXPECT_EQ(jobs_.queuedCount(), 1u);
    EXPECT_EQ(tiles.statistics().waiting, 1u);
    runAll();
    EXPECT_EQ(early.calls, 0);
    EXPECT_TRUE(late.file());
}

TEST_F(TileServiceTest, MemoryIsBounded) {
    auto small = parts();
    small.maxBytes = 5000;
    TileService tiles(std::move(small));
    for (int k = 0; k < 12; ++k) {
        ASSERT_TRUE(paint(tiles, {Layer::Day, 2, k, 0}));
        EXPECT_LE(tiles.statistics().bytes, 5000u);
    }
    EXPECT_GT(tiles.statistics().count, 0u);
    EXPECT_LT(tiles.statistics().count, 12u);
    Waiter first, last;
    EXPECT_NE(tiles.request({Layer::Day, 2, 0, 0}, first.ready()), 0u) << "forgotten";
    EXPECT_EQ(tiles.request({Layer::Day, 2, 11, 0}, last.ready()), 0u);
}

TEST_F(TileServiceTest, WhatCannotBePaintedIsAnErrorForAll) {
    map::MapPainter none = makePainter(map::noGenerators());
    TileService tiles({.painter = none, .jobs = jobs_, .post = parts().post});
    Waiter one, two;
    tiles.request({Layer::Height, 0, 0, 0}, one.ready());
    tiles.request({Layer::Height, 0, 0, 0}, two.ready());
    runAll();
    ASSERT_EQ(one.calls, 1);
    ASSERT_EQ(two.calls, 1);
    EXPECT_FALSE(*one.result);
    EXPECT_NE(one.result->error().code, base::ErrorCode::Busy);
    EXPECT_EQ(tiles.statistics().waiting, 0u);
    EXPECT_EQ(tiles.statistics().count, 0u);
}

// Contains every chunk, but loading throws std::bad_alloc.
class ThrowingStore : public store::MemoryStore {
  public:
    using MemoryStore::MemoryStore;
    store::LoadedChunk load(ChunkPos) override { throw std::bad_alloc(); }
    std::vector<store::LoadedChunk> loadMany(std::span<const ChunkPos>) override { throw std::bad_alloc(); }
};

TEST_F(TileServiceTest, AWorkerThatThrowsIsAnError) {
    ThrowingStore store(store::WorldIdentity{map::kMapSeed, "flat", 1});
    const auto textures = content::builtInTextures();
    auto painter =
        map::MapPainter::create({map::generatorsOf("flat"), contentBlocks(), textures, &store}).value();
    TileService tiles({.painter = painter, .jobs = jobs_, .post = parts().post});
    const ChunkPos chunk{0, 0};
    change(tiles, chunk);
    Waiter waiter;
    tiles.request(kTile, waiter.ready());
    runAll();
    ASSERT_EQ(waiter.calls, 1);
    ASSERT_FALSE(*waiter.result);
    EXPECT_EQ(waiter.result->error().message, "no memory");
    EXPECT_EQ(tiles.statistics().waiting, 0u);
}

TEST_F(TileServiceTest, WhoIsCalledMayAskForMore) {
    TileService tiles(parts());
    Waiter second;
    tiles.request(kTile, [&](const base::Result<TileFilePtr>&) {
        tiles.request({Layer::Day, 2, 1, 0}, second.ready());
        tiles.request(kTile, [](const base::Result<TileFilePtr>&) {});
    });
    runAll();
    EXPECT_TRUE(second.file());
}

TEST_F(TileServiceTest, EditedChunksAreThoseThatWereToldOf) {
    TileService tiles(parts());
    build(tiles, {1, 1}, "lamp_red");
    const ChunkPos gone{-3, 4};
    change(tiles, gone);
    const ChunkPos asked[] = {{0, 0}, {1, 1}, {-3, 4}, {0, 0, 1}, {-1, 0, 3}, {5, 5, 1}};
    const auto edited = tiles.editedAmong(asked);
    ASSERT_EQ(edited.size(), 4u);
    EXPECT_EQ(edited[0].pos, (ChunkPos{1, 1}));
    EXPECT_EQ(edited[0].chunk, live_.at({1, 1}));
    EXPECT_EQ(edited[1].pos, gone);
    EXPECT_FALSE(edited[1].chunk) << "the store has it";
    EXPECT_EQ(edited[2].pos, (ChunkPos{0, 0, 1}));
    EXPECT_FALSE(edited[2].chunk);
    EXPECT_EQ(edited[3].pos, (ChunkPos{-1, 0, 3}));
}

TEST_F(TileServiceTest, TilesOfHigherLevelsChangeWithTheirRows) {
    TileService tiles(parts());
    const MapTile far{Layer::Day, -1, 0, 0};
    const TileFilePtr before = paint(tiles, far);
    const ChunkPos chunk{3, 3}, row{1, 1, 1}, beyond{0, 0, 15};
    change(tiles, chunk);
    EXPECT_EQ(paint(tiles, far), before) << "its row has not changed";
    change(tiles, beyond);
    EXPECT_EQ(paint(tiles, far), before);
    change(tiles, row);
    const TileFilePtr after = paint(tiles, far);
    ASSERT_TRUE(after);
    EXPECT_NE(after, before);
}

TEST_F(TileServiceTest, ItsEndCallsNobody) {
    Waiter queued, painted;
    {
        TileService tiles(parts());
        tiles.request(kTile, painted.ready());
        EXPECT_TRUE(jobs_.runNext());
        tiles.request({Layer::Day, 2, 1, 0}, queued.ready());
    }
    EXPECT_EQ(jobs_.queuedCount(), 0u);
    runPosted();
    EXPECT_EQ(queued.calls + painted.calls, 0);
}

// With threads: edits, requests and cancellations interleaved.
TEST(TileService, WorkersPaintWhileItIsUsed) {
    const auto textures = content::builtInTextures();
    auto painter = map::MapPainter::create({map::generatorsOf("flat"), contentBlocks(), textures}).value();
    base::JobSystem jobs(2);
    std::mutex mutex;
    std::deque<std::function<void()>> posted;
    std::mt19937 random(1);
    int asked = 0, answered = 0, cancelled = 0;
    {
        TileService tiles({.painter = painter, .jobs = jobs, .post = [&](std::function<void()> work) {
                               const std::lock_guard lock(mutex);
                               posted.push_back(std::move(work));
                           }});
        const auto run = [&] {
            std::deque<std::function<void()>> now;
            {
                const std::lock_guard lock(mutex);
                std::swap(now, posted);
            }
            for (const auto& work : now) work();
        };
        for (int step = 0; step < 400; ++step) {
            const MapTile tile{Layer::Day, 2, static_cast<std::int32_t>(random() % 4), 0};
            const int before = answered;
            const auto ticket = tiles.request(tile, [&](const base::Result<TileFilePtr>& file) {
                EXPECT_TRUE(file);
                ++answered;
            });
            ++asked;
            EXPECT_EQ(ticket == 0, answered > before);
            if (ticket != 0 && random() % 3 == 0) {
                tiles.cancel(ticket);
                ++cancelled;
            }
            const ChunkPos chunk{static_cast<std::int32_t>(random() % 16), 1};
            if (random() % 4 == 0) change(tiles, chunk);
            if (random() % 2 == 0) run();
        }
        const auto end = std::chrono::steady_clock::now() + base::kHangs;
        while (tiles.statistics().waiting > 0 && std::chrono::steady_clock::now() < end) run();
        jobs.waitIdle();
        run();
        EXPECT_EQ(answered + cancelled, asked);
        EXPECT_GT(answered, 0);
    }
}

}  // namespace
}  // namespace terrane::web
