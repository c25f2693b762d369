// Runs a generator's passes as compute shaders: the same blocks as gen::Generator, to the bit.
//
// Chunks are asked for in batches; results come some frames later through a copy that nothing waits for.
// Intermediate results stay on the GPU in slots, one a chunk, so that neighbouring batches share them. Used
// on the context's thread.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/gen/generator_graph.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/world/chunk.h"

namespace terrane::gen_gpu {

// A batch of 8×8 neighbouring overworld chunks needs four rings around it: (8 + 2 × 4)² = 256 slots. The
// slots hold 640 / 256 = 2.5 such batches, so that neighbouring ones share their rings.
constexpr std::size_t kMaxBatch = 64;
constexpr std::size_t kSlots = 640;

class GpuGenerator {
  public:
    using Batch = std::vector<std::pair<world::ChunkPos, world::Chunk>>;

    // Memory on the GPU: a slot takes 1 KiB a field and 128 KiB for each 3D pass but the last (overworld, 15
    // fields and two 3D passes: 640 × (15 + 128) KiB = 89 MiB); the results of a batch 64 × 128 KiB = 8 MiB,
    // once on the GPU and once for each of three batches on their way back. A generator whose single chunk
    // needs more than kSlots is refused.
    [[nodiscard]] static base::Result<GpuGenerator> create(const gpu::ShaderLoader& shaders,
                                                           const gen::GeneratorGraph& generator,
                                                           std::uint64_t seed);
    GpuGenerator(GpuGenerator&&) noexcept;
    GpuGenerator& operator=(GpuGenerator&&) noexcept;
    ~GpuGenerator();

    // Queues a batch from the front of `chunks`, which are different, and returns how many it took: as many
    // as kMaxBatch and the slots hold, which is most where they lie close together. 0 when as many batches
    // are in flight as there is room for: take one first.
    [[nodiscard]] std::size_t submit(std::span<const world::ChunkPos> chunks);
    // The oldest batch, if the GPU has finished it (or, with `wait`, once it has).
    std::optional<Batch> take(bool wait);

  private:
    struct Impl;
    explicit GpuGenerator(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace terrane::gen_gpu
