#include "terrane/gen/generator.h"

#include <algorithm>
#include <cassert>

#include "terrane/base/profile.h"
#include "terrane/gen/executor.h"
#include "terrane/gen/pass_cache.h"
#include "terrane/gen/program.h"

namespace terrane::gen {
namespace {

world::ChunkPos neighbour(world::ChunkPos pos, int number) {
    // Chunk coordinates of blocks that wrap at 2^31.
    const auto wrap = [](std::int32_t v) {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(v) << 4) >> 4;
    };
    return {wrap(pos.x + number % 3 - 1), wrap(pos.y + number / 3 - 1)};
}

}  // namespace

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

    int newest3DBefore(int pass) const {
        while (--pass >= 0 && !programs[static_cast<std::size_t>(pass)].is3D) {
        }
        return pass;
    }

    using Works = std::array<std::shared_ptr<ChunkWork>, 9>;

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
    int needed = 0;
    for (const std::uint32_t f : programs[static_cast<std::size_t>(pass)].readsAt) {
        needed = std::max(needed, graph.fields[f].writtenBy + 1);
    }
    if (needed == 0) return;
    for (int n = 0; n < 9; ++n) {
        if (n == 4) continue;
        auto& work = works[static_cast<std::size_t>(n)];
        work = cache.get(neighbour(pos, n));
        advance(neighbour(pos, n), *work, needed, executor);
    }
}

PassInputs Generator::Impl::inputsOf(world::ChunkPos pos, ChunkWork& work, int pass, Works& works) {
    PassInputs inputs;
    inputs.chunk = pos;
    inputs.fields.resize(graph.fields.size());
    for (std::size_t f = 0; f < graph.fields.size(); ++f) {
        if (graph.fields[f].writtenBy >= 0 && graph.fields[f].writtenBy < pass)
            inputs.fields[f][4] = &work.fields[f];
    }
    for (const std::uint32_t f : programs[static_cast<std::size_t>(pass)].readsAt) {
        for (std::size_t n = 0; n < 9; ++n) {
            if (n != 4) inputs.fields[f][n] = &works[n]->fields[f];
        }
    }
    const int source = newest3DBefore(pass);
    if (source >= 0) inputs.blocks = work.blocks[static_cast<std::size_t>(source)].get();
    return inputs;
}

void Generator::Impl::runPass(world::ChunkPos pos, ChunkWork& work, int pass, Executor& executor) {
    TERRANE_ZONE("generator pass");
    Works works;
    advanceNeighbours(pos, pass, works, executor);
    const PassInputs inputs = inputsOf(pos, work, pass, works);
    const Program& program = programs[static_cast<std::size_t>(pass)];
    if (program.is3D) {
        auto& result = work.blocks[static_cast<std::size_t>(pass)];
        result = std::make_unique_for_overwrite<BlockArray>();
        return executor.run3D(program, inputs, *result);
    }
    std::vector<ColumnValues*> results;
    for (const Program::FieldResult& f : program.fields) results.push_back(&work.fields[f.field]);
    executor.run2D(program, inputs, results);
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
