#include "terrane/gen/generator.h"

#include <algorithm>
#include <cassert>

#include "terrane/base/profile.h"
#include "terrane/gen/chunks_around.h"
#include "terrane/gen/executor.h"
#include "terrane/gen/pass_cache.h"
#include "terrane/gen/program.h"

namespace terrane::gen {
struct Generator::Impl {
    Impl(GeneratorGraph g, std::uint64_t seed, std::size_t cachedChunks)
        : graph(std::move(g)),
          seeds(makeSeeds(graph, seed)),
          cache(cachedChunks, graph.fields.size(), graph.passes.size()) {
        for (const PassGraph& pass : graph.passes) programs.push_back(compile(pass, graph.noises));
    }

    // Executors are expensive to make (scratch memory): each running call borrows one.
    std::unique_ptr<Executor> borrowExecutor() {
        const std::lock_guard lock(executorMutex);
        if (idleExecutors.empty()) return std::make_unique<Executor>(graph.noises, seeds);
        auto executor = std::move(idleExecutors.back());
        idleExecutors.pop_back();
        return executor;
    }
    void giveBack(std::unique_ptr<Executor> executor) {
        const std::lock_guard lock(executorMutex);
        idleExecutors.push_back(std::move(executor));
    }

    using Works = std::array<std::shared_ptr<ChunkWork>, 9>;
    static constexpr std::size_t kOwn = 4;  // the chunk itself among the nine

    // Runs the first `passes` passes of a chunk, and of its neighbours what they need. Who runs a pass waits
    // only for lower passes of other chunks, so that threads never wait in a circle.
    void advance(world::ChunkPos pos, ChunkWork& work, int passes, Executor& executor);
    void runPass(world::ChunkPos pos, ChunkWork& work, int pass, Executor& executor);
    // The pass's inputs; `works` keeps the neighbours alive.
    PassInputs inputsOf(world::ChunkPos pos, ChunkWork& work, int pass, Works& works);
    void advanceNeighbours(world::ChunkPos pos, int pass, Works& works, Executor& executor);

    GeneratorGraph graph;
    Seeds seeds;
    std::vector<Program> programs;
    PassCache cache;
    std::mutex executorMutex;
    std::vector<std::unique_ptr<Executor>> idleExecutors;
};

void Generator::Impl::advanceNeighbours(world::ChunkPos pos, int pass, Works& works, Executor& executor) {
    const int needed = passesNeededAround(graph, pass);
    if (needed == 0) return;
    const auto around = chunksAround(pos);
    for (std::size_t n = 0; n < around.size(); ++n) {
        if (n == kOwn) continue;
        works[n] = cache.get(around[n]);
        advance(around[n], *works[n], needed, executor);
    }
}

PassInputs Generator::Impl::inputsOf(world::ChunkPos pos, ChunkWork& work, int pass, Works& works) {
    const Program& program = programs[static_cast<std::size_t>(pass)];
    PassInputs inputs;
    inputs.chunk = pos;
    inputs.fields.resize(graph.fields.size());
    for (std::size_t f = 0; f < graph.fields.size(); ++f) {
        const int writer = graph.fields[f].writtenBy;
        if (writer >= 0 && writer < pass) inputs.fields[f][kOwn] = &work.fields[f];
    }
    const int source = newest3DBefore(graph, pass);
    const auto blocksOf = [&](const ChunkWork& w) {
        return w.blocks[static_cast<std::size_t>(source)].get();
    };
    if (source >= 0) inputs.blocks[kOwn] = blocksOf(work);
    for (std::size_t n = 0; n < works.size(); ++n) {
        if (n == kOwn) continue;
        for (const std::uint32_t f : program.readsAt) inputs.fields[f][n] = &works[n]->fields[f];
        if (program.readsBlocksAt) inputs.blocks[n] = blocksOf(*works[n]);
    }
    return inputs;
}

void Generator::Impl::runPass(world::ChunkPos pos, ChunkWork& work, int pass, Executor& executor) {
    TERRANE_ZONE("generator pass");
    Works works;
    advanceNeighbours(pos, pass, works, executor);
    const PassInputs inputs = inputsOf(pos, work, pass, works);
    const Program& program = programs[static_cast<std::size_t>(pass)];
    std::vector<ColumnValues*> results;
    for (const Program::FieldResult& f : program.fields) results.push_back(&work.fields[f.field]);
    if (!program.is3D) return executor.run2D(program, inputs, results);
    auto& blocks = work.blocks[static_cast<std::size_t>(pass)];
    blocks = std::make_unique_for_overwrite<BlockArray>();
    executor.run3D(program, inputs, *blocks, results);
}

void Generator::Impl::advance(world::ChunkPos pos, ChunkWork& work, int passes, Executor& executor) {
    for (;;) {
        const int done = work.passesDone.load(std::memory_order_acquire);
        if (done >= passes) return;
        int expected = done;
        if (!work.claimed.compare_exchange_strong(expected, done + 1)) {
            work.passesDone.wait(done, std::memory_order_acquire);
            continue;
        }
        runPass(pos, work, done, executor);
        work.passesDone.store(done + 1, std::memory_order_release);
        work.passesDone.notify_all();
    }
}

Generator::Generator(GeneratorGraph graph, std::uint64_t seed, std::size_t cachedChunks)
    : impl_(std::make_unique<Impl>(std::move(graph), seed, cachedChunks)) {}
Generator::~Generator() = default;
Generator::Generator(Generator&&) noexcept = default;
Generator& Generator::operator=(Generator&&) noexcept = default;

const std::string& Generator::name() const {
    return impl_->graph.name;
}

// The last pass runs into a buffer of the call: nobody else needs its result.
world::Chunk Generator::generate(world::ChunkPos pos) const {
    TERRANE_ZONE("generate chunk");
    assert(world::isInWorld(pos) && "chunks beyond 32-bit block coordinates do not exist");
    thread_local std::unique_ptr<BlockArray> blocks = std::make_unique_for_overwrite<BlockArray>();
    Impl& impl = *impl_;
    auto executor = impl.borrowExecutor();
    const auto work = impl.cache.get(pos);
    const int last = static_cast<int>(impl.programs.size()) - 1;
    impl.advance(pos, *work, last, *executor);
    Impl::Works works;
    impl.advanceNeighbours(pos, last, works, *executor);
    executor->run3D(impl.programs.back(), impl.inputsOf(pos, *work, last, works), *blocks);
    impl.giveBack(std::move(executor));

    world::Chunk chunk;
    for (int s = 0; s < world::kSectionsPerChunk; ++s) {
        const std::span values(*blocks);
        const auto section = values.subspan(static_cast<std::size_t>(s) * world::kBlocksPerSection)
                                 .first<world::kBlocksPerSection>();
        chunk.setSection(s, world::Section::fromValues(section));
    }
    return chunk;
}

}  // namespace terrane::gen
