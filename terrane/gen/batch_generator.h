// Generates chunks many at a time, by whichever back end: threads here, compute shaders in terrane/gen_gpu.
// They give the same blocks. Used on one thread; that of terrane/gen_gpu is the context's.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/gen/generator.h"

namespace terrane::gen {

struct GeneratedChunk {
    world::ChunkPos pos;
    std::shared_ptr<world::Chunk> chunk;  // nobody else holds it
};

class BatchGenerator {
  public:
    virtual ~BatchGenerator() = default;

    // Starts a batch from the front of `positions`, which are different, and returns how many it took. 0 when
    // as many batches are in flight as there is room for: take one first. Does not wait. Throws
    // std::invalid_argument, and takes none, where not all of the batch `isGenerated` at its level
    // (generator.h).
    [[nodiscard]] virtual std::size_t submit(std::span<const world::ChunkPos> positions) = 0;

    // The oldest batch in the order of its positions, if it is finished (with `wait`: once it is); otherwise,
    // and where none is in flight, nothing. Throws what generating a chunk of it threw.
    [[nodiscard]] virtual std::vector<GeneratedChunk> take(bool wait) = 0;

    virtual std::string_view backend() const = 0;  // "cpu" or "gpu"
    virtual int level() const { return 0; }        // of the chunks it makes
};

// Generates on `threads` − 1 threads of its own and, while it waits in take(), on the calling one. With one
// thread take() generates even where it is not asked to wait.
std::unique_ptr<BatchGenerator> makeCpuGenerator(Generator generator, unsigned threads);

// The chunks at `positions`, in their order. Waits; nothing else may be in flight.
base::Result<std::vector<std::shared_ptr<world::Chunk>>> generateAll(
    BatchGenerator& generator, std::span<const world::ChunkPos> positions);

}  // namespace terrane::gen
