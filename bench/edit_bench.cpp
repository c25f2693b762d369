// Edits in batches through the session: the cost of filling or clearing N³ blocks until their light and
// meshes are done. Items per second are blocks; they stay the same where time is linear in blocks. Also a
// flood.
#include <benchmark/benchmark.h>

#include <chrono>
#include <memory>
#include <string_view>
#include <vector>

#include "bench/bench_content.h"
#include "terrane/base/statistics.h"
#include "terrane/game/session.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/store/overlay_store.h"

namespace {

using namespace terrane;

constexpr int kViewDistance = 4;  // chunks: the largest box and its light lie inside
constexpr int kBottom = 40;       // of the boxes: in the ground of the generator flat and in the air above it

void settle(game::Session& session) {
    stream::ChunkPipeline& pipeline = session.pipeline();
    for (pipeline.update(); !pipeline.progress().isUpToDate(); pipeline.update()) {
        pipeline.waitForWorkers(std::chrono::milliseconds(100));
    }
}

std::unique_ptr<game::Session> loadedSession() {
    auto generators = bench::orExit(gen::makeLevelGenerators("flat", bench::blocks(), 1));
    auto store = std::make_unique<store::MemoryStore>(store::WorldIdentity{1, "flat", 1});
    auto session = std::make_unique<game::Session>(
        game::SessionParts{std::make_unique<const world::BlockRegistry>(bench::blocks()),
                           std::move(generators), std::move(store), 2});
    session->pipeline().setView({0, 0}, kViewDistance);
    settle(*session);
    return session;
}

std::vector<game::EditCommand> box(int side, std::string_view name) {
    const world::BlockId id = bench::blockId(name);
    std::vector<game::EditCommand> commands;
    for (int z = kBottom; z < kBottom + side; ++z)
        for (int y = -side / 2; y < side - side / 2; ++y)
            for (int x = -side / 2; x < side - side / 2; ++x)
                commands.push_back({game::kNoPlayer, {x, y, z}, world::SetBlock{id}, {}});
    return commands;
}

// Each round changes every block of the box, to one kind and back.
void editBox(benchmark::State& state, std::string_view name, std::string_view other) {
    const auto session = loadedSession();
    const int side = static_cast<int>(state.range(0));
    const std::vector<game::EditCommand> there = box(side, name), back = box(side, other);
    session->edit(back);
    settle(*session);
    std::int64_t applied = 0;
    for (auto _ : state) {
        const auto results = session->edit(there);
        settle(*session);
        state.PauseTiming();
        applied += std::count(results.begin(), results.end(), game::EditResult::Applied);
        session->edit(back);
        settle(*session);
        session->pipeline().takeChanges(1 << 20);
        state.ResumeTiming();
    }
    state.SetItemsProcessed(applied);
}

void fillWithStone(benchmark::State& state) {
    editBox(state, "stone", "air");
}
void fillWithLamps(benchmark::State& state) {
    editBox(state, "lamp_red", "air");
}
void clearStone(benchmark::State& state) {
    editBox(state, "air", "stone");
}

// The same through Session::build, as a player's step: until the command has its answer, and then until all
// of it is lit and meshed.
void buildBox(benchmark::State& state) {
    const auto session = loadedSession();
    session->setPlayer(game::kLocalPlayer, {.position = {0, 0, kBottom}});
    const int side = static_cast<int>(state.range(0));
    const world::BlockBox box{{-side / 2, -side / 2, kBottom},
                              {side - side / 2 - 1, side - side / 2 - 1, kBottom + side - 1}};
    const auto fill = [&](std::string_view name) {
        return session->build({game::kLocalPlayer, game::FillBox{box, bench::blockId(name), 0, {}}});
    };
    double answerSeconds = 0, undoSeconds = 0, frameSeconds = 0;
    std::int64_t changed = 0;
    const auto since = [](auto start) {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    fill("stone");
    settle(*session);
    for (auto _ : state) {
        auto start = std::chrono::steady_clock::now();
        changed += static_cast<std::int64_t>(fill("bricks").changed);
        answerSeconds += since(start);
        start = std::chrono::steady_clock::now();
        session->pipeline().update();
        frameSeconds += since(start);
        settle(*session);
        start = std::chrono::steady_clock::now();
        session->undoOrRedo(game::kLocalPlayer, game::HistoryWay::Undo);
        undoSeconds += since(start);
        settle(*session);
        session->pipeline().takeChanges(1 << 20);
    }
    const auto milliseconds = [&](double seconds) {
        return 1000 * seconds / static_cast<double>(state.iterations());
    };
    state.counters["answer_ms"] = milliseconds(answerSeconds);
    state.counters["frame_ms"] = milliseconds(frameSeconds);
    state.counters["undo_ms"] = milliseconds(undoSeconds);
    state.SetItemsProcessed(changed);
}

// N² sources in the air, until their water has settled: the median of its ticks, and of the time that light
// and meshes take after one.
void flood(benchmark::State& state) {
    using Milliseconds = std::chrono::duration<double, std::milli>;
    const auto session = loadedSession();
    const int side = static_cast<int>(state.range(0));
    std::vector<game::EditCommand> sources, none;
    for (int k = 0; k < side * side; ++k) {
        const world::BlockPos pos{4 * (k % side - side / 2), 4 * (k / side - side / 2), 100};
        sources.push_back({game::kNoPlayer, pos, world::SetBlock{bench::blockId("water")}, {}});
        none.push_back({game::kNoPlayer, pos, world::SetBlock{}, {}});
    }
    std::vector<double> ticks, rests;
    constexpr int kTicks = 30;
    for (auto _ : state) {
        for (const auto& commands : {sources, none}) {
            session->edit(commands);
            for (int tick = 0; tick < kTicks; ++tick) {
                const auto begin = std::chrono::steady_clock::now();
                session->advance(0.25, {0, 0});
                const auto between = std::chrono::steady_clock::now();
                settle(*session);
                const auto end = std::chrono::steady_clock::now();
                session->pipeline().takeChanges(1 << 20);
                ticks.push_back(Milliseconds(between - begin).count());
                rests.push_back(Milliseconds(end - between).count());
            }
        }
    }
    state.counters["tick_ms"] = base::medianOf(ticks);
    state.counters["light_mesh_ms"] = base::medianOf(rests);
}

}  // namespace

BENCHMARK(flood)->Arg(8)->Arg(16)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(fillWithStone)->Arg(8)->Arg(16)->Arg(32)->Arg(64)->Unit(benchmark::kMillisecond);
BENCHMARK(fillWithLamps)->Arg(8)->Arg(16)->Arg(32)->Arg(64)->Unit(benchmark::kMillisecond);
BENCHMARK(clearStone)->Arg(8)->Arg(16)->Arg(32)->Arg(64)->Unit(benchmark::kMillisecond);
BENCHMARK(buildBox)->Arg(8)->Arg(46)->Arg(79)->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
