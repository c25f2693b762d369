// Generates chunks in batches on one of two back ends: threads here, compute shaders in terrane/gen_gpu. Both
// give the same blocks. It is used on one thread: with compute shaders, the context's.
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
    std::shared_ptr<world::Chunk> chunk;  // the only reference
};

class BatchGenerator {
  public:
    virtual ~BatchGenerator() = default;

    // Starts a batch from the front of `positions`, which are different, and returns its size: 0 if as many
    // batches are in flight as possible, so that take() must come first. Does not wait. Throws
    // std::invalid_argument and starts nothing if a chunk of the batch is not generated at this level
    // (isGenerated() in generator.h).
    [[nodiscard]] virtual std::size_t submit(std::span<const world::ChunkPos> positions) = 0;

    // Returns the oldest batch in the order of its positions if it is finished; with `wait`, waits for it.
    // The result is empty if it is not finished or none is in flight. Rethrows exceptions of generating a
    // chunk of it.
    [[nodiscard]] virtual std::vector<GeneratedChunk> take(bool wait) = 0;

    virtual std::string_view backend() const = 0;  // "cpu" or "gpu"
    virtual int level() const { return 0; }        // of the chunks it makes
};

// Generates on `threads` − 1 threads of its own and, while it waits in take(), on the calling one. With one
// thread take() generates even without `wait`.
std::unique_ptr<BatchGenerator> makeCpuGenerator(Generator generator, unsigned threads);

// Returns the chunks at `positions`, in their order. Waits; nothing else may be in flight.
base::Result<std::vector<std::shared_ptr<world::Chunk>>> generateAll(
    BatchGenerator& generator, std::span<const world::ChunkPos> positions);

}  // namespace terrane::gen
