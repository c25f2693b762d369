#include "terrane/gen/generator.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <stdexcept>

#include "terrane/base/profile.h"
#include "terrane/base/result.h"
#include "terrane/gen/compile/program.h"
#include "terrane/gen/cpu/executor.h"

namespace terrane::gen {

std::shared_ptr<ChunkWork> PassCache::get(world::ChunkPos pos) {
    const std::lock_guard lock(mutex_);
    if (const auto it = entries_.find(pos); it != entries_.end()) {
        order_.splice(order_.begin(), order_, it->second.order);
        return it->second.work;
    }
    auto work = std::make_shared<ChunkWork>(fieldCount_, passCount_);
    const std::size_t bytes = ChunkWork::memoryBytes(fieldCount_, passCount_);
    Order newest = {pos};
    entries_.emplace(pos, Entry{work, newest.begin(), bytes});
    order_.splice(order_.begin(), newest);  // last, as it cannot throw: both containers have the same chunks
    bytes_ += bytes;
    evict();
    return work;
}

void PassCache::addBytes(world::ChunkPos pos, const ChunkWork& work, std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    const auto it = entries_.find(pos);
    if (it == entries_.end() || it->second.work.get() != &work) return;  // evicted meanwhile
    it->second.bytes += bytes;
    bytes_ += bytes;
    evict();
}

void PassCache::evict() {
    const auto isTooLarge = [&] {
        if (bytes_ <= size_.bytes || entries_.empty()) return false;
        // Without a limit on bytes the number of chunks alone counts.
        const bool isFarTooLarge = size_.bytes > 0 && bytes_ / CacheSize::kMostTimes > size_.bytes;
        return entries_.size() > size_.minChunks || isFarTooLarge;
    };
    while (isTooLarge()) {
        const auto oldest = entries_.find(order_.back());
        bytes_ -= oldest->second.bytes;
        entries_.erase(oldest);
        order_.pop_back();
    }
}

struct Generator::Impl {
    // A thread's own: the scratch memory of passes, and the results that no neighbor needs.
    struct Worker {
        Worker(const GeneratorGraph& graph, const Seeds& seeds, DrainageMaps& drainages)
            : executor(graph.noises, seeds, {graph.shapes.get(), &drainages}),
              downPasses(graph.noises, seeds, {graph.shapes.get(), &drainages}, graph.heights),
              fields(graph.fields.size()),
              blocks{BlockLayers(graph.heights), BlockLayers(graph.heights)} {}

        Executor executor;
        TopDownPasses downPasses;
        std::vector<ColumnValues> fields;           // by field
        std::array<BlockLayers, 2> blocks;          // of the last two 3D passes, alternating
        std::vector<PassReport>* report = nullptr;  // of reportedChunk, or null
        world::ChunkPos reportedChunk;
    };

    Impl(GeneratorGraph g, std::uint64_t seed, CacheSize size)
        : graph(std::move(g)),
          seeds(makeSeeds(graph, seed)),
          drainages(graph.drainages, seed),
          shared(sharedPasses(graph)),
          firstDown(canRunTopDown(graph) ? firstTopDownPass(graph) : static_cast<int>(graph.passes.size())),
          cache(size, graph.fields.size(), static_cast<std::size_t>(shared)) {
        for (const PassGraph& pass : graph.passes) {
            Program program;
            std::unique_ptr<const VoxelPass> voxelPass;
            if (pass.is3D) {
                voxelPass = std::make_unique<VoxelPass>(pass, graph.noises);
            } else {
                program = compile(pass, graph.noises);
            }
            programs.push_back(std::move(program));
            voxelPasses.push_back(std::move(voxelPass));
            assert(programOf(programs.size() - 1).arenaRows <= kMaxArenaRows &&
                   "GeneratorBuilder::finish() refuses others");
        }
    }

    const Program& programOf(std::size_t pass) const {
        return voxelPasses[pass] ? voxelPasses[pass]->program() : programs[pass];
    }

    // Workers are expensive to make: each running call borrows one.
    std::unique_ptr<Worker> borrowWorker() {
        const std::lock_guard lock(workerMutex);
        if (idleWorkers.empty()) return std::make_unique<Worker>(graph, seeds, drainages);
        auto worker = std::move(idleWorkers.back());
        idleWorkers.pop_back();
        return worker;
    }
    void giveBack(std::unique_ptr<Worker> worker) {
        const std::lock_guard lock(workerMutex);
        idleWorkers.push_back(std::move(worker));
    }

    using Works = std::array<std::shared_ptr<ChunkWork>, 9>;
    static constexpr std::size_t kOwn = 4;  // the chunk itself among the nine

    // Runs the first `passes` passes of a chunk, all of them shared, and the passes of neighbors that these
    // need. A thread that runs a pass waits only for lower passes of other chunks, so there is no deadlock.
    void advance(world::ChunkPos pos, ChunkWork& work, int passes, Worker& worker);
    void runPass(world::ChunkPos pos, ChunkWork& work, int pass, Works& works, Worker& worker);
    // Prepares the passes from firstDown on.
    void beginTopDown(world::ChunkPos pos, ChunkWork& work, Works& works, Worker& worker);
    // The pass's inputs; `works` keeps the neighbors alive.
    PassInputs inputsOf(world::ChunkPos pos, ChunkWork& work, int pass, const Works& works, Worker& worker);
    void advanceNeighbors(world::ChunkPos pos, int pass, Works& works, Worker& worker);
    // Storage for results of the chunk that `worker` computes.
    ColumnValues& fieldOf(std::size_t field, ChunkWork& work, Worker& worker) const;
    BlockLayers& blocksOf(int pass, ChunkWork& work, Worker& worker) const;

    GeneratorGraph graph;
    Seeds seeds;
    DrainageMaps drainages;
    std::vector<Program> programs;                              // by pass: of 2D ones
    std::vector<std::unique_ptr<const VoxelPass>> voxelPasses;  // by pass: of 3D ones
    int shared;                                                 // passes
    int firstDown;  // of those that generateTopDown() runs together
    PassCache cache;
    std::mutex workerMutex;
    std::vector<std::unique_ptr<Worker>> idleWorkers;
};

ColumnValues& Generator::Impl::fieldOf(std::size_t field, ChunkWork& work, Worker& worker) const {
    return graph.fields[field].writtenBy < shared ? work.fields[field] : worker.fields[field];
}

BlockLayers& Generator::Impl::blocksOf(int pass, ChunkWork& work, Worker& worker) const {
    const auto number = static_cast<std::size_t>(pass);
    if (pass >= shared) {
        const auto before = std::count_if(graph.passes.begin(), graph.passes.begin() + pass,
                                          [](const PassGraph& p) { return p.is3D; });
        return worker.blocks[static_cast<std::size_t>(before % 2)];
    }
    if (!work.blocks[number]) work.blocks[number] = std::make_unique<BlockLayers>(graph.heights);
    return *work.blocks[number];
}

void Generator::Impl::advanceNeighbors(world::ChunkPos pos, int pass, Works& works, Worker& worker) {
    const int needed = passesNeededAround(graph, pass);
    if (needed == 0) return;
    const auto around = chunksAround(pos);
    for (std::size_t n = 0; n < around.size(); ++n) {
        if (n == kOwn) continue;
        if (!works[n]) works[n] = cache.get(around[n]);
        advance(around[n], *works[n], needed, worker);
    }
}

PassInputs Generator::Impl::inputsOf(world::ChunkPos pos, ChunkWork& work, int pass, const Works& works,
                                     Worker& worker) {
    const Program& program = programOf(static_cast<std::size_t>(pass));
    PassInputs inputs;
    inputs.chunk = pos;
    inputs.fields.resize(graph.fields.size());
    for (std::size_t f = 0; f < graph.fields.size(); ++f) {
        const int writer = graph.fields[f].writtenBy;
        if (writer >= 0 && writer < pass) inputs.fields[f][kOwn] = &fieldOf(f, work, worker);
    }
    const int source = last3DPassBefore(graph, pass);
    if (source >= 0) inputs.blocks[kOwn] = &blocksOf(source, work, worker);
    for (std::size_t n = 0; n < works.size(); ++n) {
        if (n == kOwn) continue;
        for (const std::uint32_t f : program.readsAt) inputs.fields[f][n] = &works[n]->fields[f];
        if (program.readsBlocksAt)
            inputs.blocks[n] = works[n]->blocks[static_cast<std::size_t>(source)].get();
    }
    return inputs;
}

void Generator::Impl::runPass(world::ChunkPos pos, ChunkWork& work, int pass, Works& works, Worker& worker) {
    advanceNeighbors(pos, pass, works, worker);
    TERRANE_ZONE("generator pass");
    const PassInputs inputs = inputsOf(pos, work, pass, works, worker);
    const Program& program = programOf(static_cast<std::size_t>(pass));
    std::vector<ColumnValues*> results;
    for (const Program::FieldResult& f : program.fields) results.push_back(&fieldOf(f.field, work, worker));
    if (program.is3D) {
        const VoxelPass& voxelPass = *voxelPasses[static_cast<std::size_t>(pass)];
        BlockLayers& blocks = blocksOf(pass, work, worker);
        worker.executor.run3D(voxelPass, inputs, blocks, results);
        if (pass < shared) {
            blocks.compact();
            cache.addBytes(pos, work, blocks.memoryBytes());
        }
        if (worker.report && worker.reportedChunk == pos) {
            const std::span<const SlabRun> slabs = worker.executor.slabs();
            worker.report->push_back({pass, {slabs.begin(), slabs.end()}, voxelPass.layerInstructions()});
        }
    } else {
        worker.executor.run2D(program, inputs, results);
    }
}

void Generator::Impl::beginTopDown(world::ChunkPos pos, ChunkWork& work, Works& works, Worker& worker) {
    worker.downPasses.clear();
    for (int pass = firstDown; pass < static_cast<int>(programs.size()); ++pass) {
        const auto number = static_cast<std::size_t>(pass);
        advanceNeighbors(pos, pass, works, worker);
        worker.downPasses.add(*voxelPasses[number], inputsOf(pos, work, pass, works, worker));
    }
}

void Generator::Impl::advance(world::ChunkPos pos, ChunkWork& work, int passes, Worker& worker) {
    Works works;
    work.advance(passes, [&](int pass) { runPass(pos, work, pass, works, worker); });
}

namespace {

world::Section packSection(const BlockLayers& blocks, int number) {
    const std::optional<std::uint16_t> one = blocks.uniformBlock(number);
    return one ? world::Section(*one) : world::Section::fromValues(blocks.section(number));
}

world::Chunk packChunk(const BlockLayers& blocks) {
    world::Chunk chunk(blocks.heights());
    for (int number = blocks.heights().firstSection(); number < blocks.heights().endSection(); ++number)
        chunk.setSection(number, packSection(blocks, number));
    return chunk;
}

}  // namespace

base::Result<void> checkGenerated(world::ChunkPos pos, int level) {
    if (isGenerated(pos, level)) return {};
    if (pos.level != level) {
        return base::fail("chunk {},{} of level {}: this generator makes level {} only", pos.x, pos.y,
                          pos.level, level);
    }
    const std::string ofLevel = level == 0 ? "" : fmt::format(" of level {}", level);
    return base::fail("chunk {},{}{}: outside of the world, {} to {}", pos.x, pos.y, ofLevel,
                      world::kMinChunk >> level, world::kMaxChunk >> level);
}

void requireGenerated(world::ChunkPos pos, int level) {
    if (isGenerated(pos, level)) return;
    throw std::invalid_argument(checkGenerated(pos, level).error().message);
}

Generator::Generator(GeneratorGraph graph, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(std::move(graph), seed, cacheSizeOf(graph.level))) {}
Generator::Generator(GeneratorGraph graph, std::uint64_t seed, CacheSize cacheSize)
    : impl_(std::make_unique<Impl>(std::move(graph), seed, cacheSize)) {}
Generator::~Generator() = default;
Generator::Generator(Generator&&) noexcept = default;
Generator& Generator::operator=(Generator&&) noexcept = default;

const std::string& Generator::name() const {
    return impl_->graph.name;
}

int Generator::level() const {
    return impl_->graph.level;
}

world::Heights Generator::heights() const {
    return impl_->graph.heights;
}

std::size_t Generator::cacheBytes() const {
    return impl_->cache.bytes();
}

ColumnValues Generator::columns(world::ChunkPos pos, std::uint32_t field) const {
    Impl& impl = *impl_;
    requireGenerated(pos, impl.graph.level);
    auto worker = impl.borrowWorker();
    const auto work = impl.cache.get(pos);
    impl.advance(pos, *work, impl.shared, *worker);
    const int writer = impl.graph.fields[field].writtenBy;
    Impl::Works works;
    for (int pass = impl.shared; pass <= writer; ++pass) impl.runPass(pos, *work, pass, works, *worker);
    const ColumnValues values = impl.fieldOf(field, *work, *worker);
    impl.giveBack(std::move(worker));
    return values;
}

world::Chunk Generator::generate(world::ChunkPos pos) const {
    return generate(pos, nullptr);
}

world::Chunk Generator::generate(world::ChunkPos pos, std::vector<PassReport>& report) const {
    return generate(pos, &report);
}

world::Chunk Generator::generate(world::ChunkPos pos, std::vector<PassReport>* report) const {
    TERRANE_ZONE("generate chunk");
    Impl& impl = *impl_;
    requireGenerated(pos, impl.graph.level);
    auto worker = impl.borrowWorker();
    worker->report = report;
    worker->reportedChunk = pos;
    const auto work = impl.cache.get(pos);
    impl.advance(pos, *work, impl.shared, *worker);
    const int passCount = static_cast<int>(impl.programs.size());
    Impl::Works works;
    for (int pass = impl.shared; pass < passCount; ++pass) impl.runPass(pos, *work, pass, works, *worker);

    world::Chunk chunk = packChunk(impl.blocksOf(passCount - 1, *work, *worker));
    worker->report = nullptr;
    impl.giveBack(std::move(worker));
    return chunk;
}

// Prepares the passes that run from the top down, and calls run() with them.
template <class Run>
void Generator::runDown(world::ChunkPos pos, const Run& run) const {
    Impl& impl = *impl_;
    base::require(canRunTopDown(impl.graph), "Generator: the last pass of the generator is not 3D");
    requireGenerated(pos, impl.graph.level);
    auto worker = impl.borrowWorker();
    const auto work = impl.cache.get(pos);
    impl.advance(pos, *work, impl.shared, *worker);
    Impl::Works works;
    for (int pass = impl.shared; pass < impl.firstDown; ++pass)
        impl.runPass(pos, *work, pass, works, *worker);
    impl.beginTopDown(pos, *work, works, *worker);
    run(worker->downPasses);
    impl.giveBack(std::move(worker));
}

void Generator::generateTopDown(world::ChunkPos pos, const LayerCallback& take) const {
    TERRANE_ZONE("generate chunk from the top");
    runDown(pos, [&](TopDownPasses& passes) { passes.run(take); });
}

world::Chunk Generator::generateDown(world::ChunkPos pos, const SectionCallback& goesOn) const {
    TERRANE_ZONE("generate chunk down to a depth");
    world::Chunk chunk(heights());
    runDown(pos, [&](TopDownPasses& passes) {
        int number = chunk.heights().endSection() - 1;
        for (;; --number) {
            passes.makeDownTo(number * world::kSectionSize);
            chunk.setSection(number, packSection(passes.blocks(), number));
            if (!goesOn(chunk, number) || number == chunk.heights().firstSection()) break;
        }
        chunk.unmakeBelow(number);
    });
    return chunk;
}

}  // namespace terrane::gen
