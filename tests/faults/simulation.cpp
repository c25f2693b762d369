#include "tests/faults/simulation.h"

#include "terrane/gen/language/builder.h"
#include "terrane/store/saves/save_check.h"
#include "terrane/store/sqlite/sqlite_store.h"
#include "tests/faults/expect_tiles.h"

namespace terrane::store {
namespace {

using namespace std::chrono_literals;

constexpr const char* kTileRules = "simulated";
constexpr auto kPromise = 2s;

const world::BlockRegistry& simulatedBlocks() {
    static const world::BlockRegistry blocks = testRegistry();
    return blocks;
}

const light::LightTable& simulatedLights() {
    static const light::LightTable lights(simulatedBlocks());
    return lights;
}

const gen::Generator& simulatedGenerator() {
    static const gen::Generator generator = [] {
        gen::GeneratorBuilder builder("flat", simulatedBlocks());
        builder.pass3D(
            "ground", [](gen::Pass& p) { p.setBlock(select(p.z() < 60, p.block("stone"), p.block("air"))); });
        auto graph = builder.finish();
        if (!graph) throw std::runtime_error(graph.error().message);
        return gen::Generator(*std::move(graph), 1);
    }();
    return generator;
}

// All generated chunks are equal.
world::ChunkPtr simulatedChunk(world::ChunkPos) {
    static const auto chunk = std::make_shared<const world::Chunk>(simulatedGenerator().generate({0, 0}));
    return chunk;
}

}  // namespace

Simulation::Simulation(unsigned seed) : random_(seed) {
    disk_.seedRandomness(seed);
    account_.generated = simulatedChunk;
    clock_.now += 1h;
    storesGenerated_ = chance(0.3);
}

Simulation::~Simulation() {
    pipeline_ = nullptr;
    store_ = nullptr;
}

bool Simulation::chance(double share) {
    return static_cast<double>(random_()) < share * 4294967296.0;
}

std::uint64_t Simulation::history() const {
    return account_.history ^ disk_.history();
}

void Simulation::open() {
    SaveLimits limits;
    limits.clock = &clock_;
    auto opened = SqliteStore::open(path_, simulatedBlocks(), {.create = kIdentity, .decide = {}}, limits);
    account_.note(opened.has_value());
    if (!opened) return;
    store_ = std::make_unique<RecordingStore>(std::move(*opened), account_);
    store_->setDerivedRows({deriveSums, {}});
    (void)ensureDerivedRows(*store_, kTileRules);
    world_ = {};
    pipeline_ = std::make_unique<stream::ChunkPipeline>(
        stream::PipelineParts{jobs_,
                              simulatedBlocks(),
                              simulatedLights(),
                              world_,
                              {&simulatedGenerator(), store_.get(), storesGenerated_},
                              nullptr,
                              nullptr,
                              stream::MeshPolicy::Workers});
    pipeline_->setView(place_, 0);
}

// Nothing is visible any more: queued saves may be lost, and the log says so.
void Simulation::close() {
    pipeline_ = nullptr;
    if (store_) {
        const bool isSaved = store_->flush().has_value();
        (void)store_->status();
        EXPECT_TRUE(!isSaved || (account_.unsaved.edited.empty() && account_.unsaved.queued.empty()));
        EXPECT_TRUE(isSaved || disk_.failures() > 0 || disk_.hasStopped());
    }
    store_ = nullptr;
    account_.ledger.closed();
    account_.unsaved = {};
    toldAt_.reset();
}

void Simulation::restartAfterStop() {
    close();
    disk_.restart();
    ++(isPowerLoss_ ? counts_.powerLosses : counts_.kills);
    expectGoodSave(false);
    expectAllThere();
}

// Opens the save directly with a working disk: durable saves exist.
void Simulation::expectAllThere() {
    auto store = SqliteStore::open(path_, simulatedBlocks(), {.create = kIdentity, .decide = {}}, kNever);
    ASSERT_TRUE(store) << store.error().message;
    for (const world::ChunkPos pos : account_.ledger.positions()) {
        LoadedChunk loaded = (*store)->load(pos);
        ASSERT_NE(loaded.state, LoadedChunk::State::Damaged) << loaded.problem;
        if (loaded.provenance == Provenance::Generated) loaded.chunk = nullptr;
        const int content = account_.contentAmong(account_.ledger.possible(pos), loaded.chunk);
        EXPECT_NE(content, -1) << nameOf(pos) << " lost a durable save";
        account_.ledger.found(pos, content);
    }
    expectTiles(**store, kTileRules);
}

void Simulation::expectGoodSave(bool isClosed) {
    const auto report = checkSave(path_, simulatedBlocks());
    if (!report) {
        const std::string& problem = report.error().message;
        const bool isUnfinished = report.error().code == base::ErrorCode::NotFound ||
                                  problem.find("empty, not a save") != std::string::npos ||
                                  problem.find("was interrupted") != std::string::npos;
        EXPECT_TRUE(!isClosed && isUnfinished) << problem;
        return;
    }
    for (const std::string& problem : report->fileProblems)
        EXPECT_TRUE(!isClosed && problem.find("unless it was never finished") != std::string::npos)
            << problem;
    for (const DamagedChunk& chunk : report->damaged) ADD_FAILURE() << nameOf(chunk.pos) << chunk.problem;
}

void Simulation::changeFaults() {
    constexpr unsigned kKinds[] = {kDiskAny,  kDiskRead, kDiskWrite, kDiskSync,
                                   kDiskOpen, kDiskLock, kDiskMap,   kDiskWrite | kDiskSync};
    if (chance(0.02)) {
        counts_.failedOperations += disk_.failures();
        disk_.fail(kKinds[random_() % std::size(kKinds)], below(20), chance(0.5) ? 1 + below(40) : LONG_MAX,
                   chance(0.3) ? DiskError::Full : DiskError::Io);
        ++counts_.faults;
    } else if (chance(0.03)) {
        counts_.failedOperations += disk_.failures();
        disk_.work();
    }
    if (chance(0.004)) {
        isPowerLoss_ = chance(0.5);
        disk_.stopAfter(isPowerLoss_ ? DiskStop::PowerLoss : DiskStop::Kill, below(40),
                        static_cast<unsigned>(random_()));
    }
}

void Simulation::walk() {
    if (chance(0.05)) place_ = {place_.x + below(3) - 1, place_.y + below(3) - 1};
    if (chance(0.003)) place_ = {below(7) - 3, below(7) - 3};
    pipeline_->setView(place_, 0);
}

void Simulation::edit() {
    const world::ChunkPos at{place_.x + below(3) - 1, place_.y + below(3) - 1};
    if (!world_.maybeChunkAt(at)) return;
    const world::BlockPos pos{at.x * 16 + below(16), at.y * 16 + below(16), 50 + below(20)};
    const auto id = static_cast<world::BlockId>(below(6));
    std::vector<world::BlockEdit> edits;
    world::applyChange(world_, simulatedBlocks(), pos, world::SetBlock{id}, edits);
    pipeline_->onEdits(edits);
    for (const world::BlockEdit& changed : edits)
        account_.unsaved.edited.try_emplace(world::chunkOf(changed.pos), clock_.now);
    counts_.edits += edits.empty() ? 0 : 1;
}

// Frames of 10 to 60 ms; nothing is visible during a pause of the whole computer.
void Simulation::passTime() {
    const auto frame = std::chrono::milliseconds(10 + below(50));
    clock_.now += frame;
    counts_.seconds += std::chrono::duration<double>(frame).count();
    if (!chance(0.002)) return;
    const auto pause = std::chrono::seconds(1 + below(20));
    clock_.now += pause;
    counts_.seconds += static_cast<double>(pause.count());
    for (auto& [pos, seen] : account_.unsaved.edited) seen += pause;
    for (auto& [number, seen] : account_.unsaved.queued) seen += pause;
    if (toldAt_) *toldAt_ += pause;
}

void Simulation::expectSavedOrTold() {
    if (!store_->status().problem.empty()) toldAt_ = clock_.now;
    if (toldAt_ && clock_.now - *toldAt_ <= kPromise) return;
    for (const auto& [pos, seen] : account_.unsaved.edited)
        EXPECT_LE(clock_.now - seen, kPromise) << nameOf(pos) << " is not queued";
    for (const auto& [number, seen] : account_.unsaved.queued)
        EXPECT_LE(clock_.now - seen, kPromise) << "save " << number << " is not durable";
}

void Simulation::step() {
    ++counts_.steps;
    passTime();
    changeFaults();
    if (!store_) {
        open();
    } else if (chance(0.003)) {
        close();
        ++counts_.restarts;
    } else {
        walk();
        if (chance(0.3)) edit();
        for (int n = below(5); n > 0; --n) jobs_.runNext();
        pipeline_->update(clock_.now);
        (void)pipeline_->takeChanges(1000);
        if (clock_.writeIfDue) clock_.writeIfDue();
        if (!disk_.hasStopped()) expectSavedOrTold();
    }
    if (disk_.hasStopped()) restartAfterStop();
}

// Without further faults.
void Simulation::settle() {
    counts_.failedOperations += disk_.failures();
    disk_.restart();
    if (!store_) open();
    ASSERT_TRUE(store_) << "the save cannot be opened";
    for (int n = 0; n < 100; ++n) {
        clock_.now += 50ms;
        while (jobs_.runNext()) continue;
        pipeline_->update(clock_.now);
        clock_.writeIfDue();
    }
    const SaveStatus status = store_->status();
    EXPECT_EQ(status.problem, "");
    EXPECT_EQ(status.waiting, 0u);
    EXPECT_TRUE(account_.unsaved.edited.empty() && account_.unsaved.queued.empty()) << "not saved in the end";
    close();
    expectGoodSave(true);
    expectAllThere();
    EXPECT_EQ(folder_.fileCount(), 1) << "no log and no lock";
}

void Simulation::run() {
    for (int steps = 300 + below(900); steps > 0 && !testing::Test::HasFailure(); --steps) step();
    if (!testing::Test::HasFailure()) settle();
    counts_.loads = account_.loads;
    counts_.saves = account_.saves;
    counts_.unread = account_.unread;
}

}  // namespace terrane::store
