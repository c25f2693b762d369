// Runs a generator's passes as compute shaders: the same blocks as gen::Generator, to the bit.
//
// Results come some frames later through a copy that nothing waits for. Intermediate results stay on the GPU
// in slots, one a chunk, so that neighboring batches share them. It is used on the context's thread.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "terrane/gen/batch_generator.h"
#include "terrane/gen/drainage/drainage_maps.h"
#include "terrane/gpu/buffer.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/world/coords.h"

namespace terrane::gen_gpu {

// Rivers and lakes near the tiles of a dispatch are storage buffers (shared/drainage.h). Whether a pass reads
// drainage maps.
bool readsDrainage(const gen::GeneratorGraph& generator, const gen::PassGraph& pass);

struct DrainageBuffers {
    gpu::Buffer lists, data;
};

// Uploads the rivers and lakes near the tiles of a dispatch, from the drainage maps that the CPU uses, on the
// context's thread. `chunks` are the tile jobs in order. A segment near a tile takes 48 bytes, a lake 16.
DrainageBuffers uploadDrainage(gen::DrainageMaps& maps, std::size_t mapCount,
                               std::span<const world::ChunkPos> chunks);

// A batch of 8×8 neighboring overworld chunks needs four rings around it: (8 + 2 × 4)² = 256 slots. The
// slots hold 640 / 256 = 2.5 such batches, so that neighboring ones share their rings.
constexpr std::size_t kMaxBatch = 64;
constexpr std::size_t kSlots = 640;

class GpuGenerator : public gen::BatchGenerator {
  public:
    // Creates the generator. A slot takes 1 KiB a field, and for each 3D pass but the last 512 bytes a layer
    // (overworld with 256 layers, 15 fields and two 3D passes: 640 × (15 + 128) KiB = 89 MiB); the results of
    // a batch 64 × 128 KiB = 8 MiB, at most 32 MiB in taller worlds, once on the GPU and once for each of
    // three batches on their way back. Generators with more 3D passes or layers have fewer slots for blocks,
    // so that no buffer is larger than 256 MiB or than a shader can address. A generator whose single chunk
    // needs more slots is refused.
    [[nodiscard]] static base::Result<GpuGenerator> create(const gpu::ShaderLoader& shaders,
                                                           const gen::GeneratorGraph& generator,
                                                           std::uint64_t seed);
    GpuGenerator(GpuGenerator&&) noexcept;
    GpuGenerator& operator=(GpuGenerator&&) noexcept;
    ~GpuGenerator() override;

    // Accepts as many as kMaxBatch, the results' memory and the slots hold; positions that are close together
    // need the fewest slots. Three batches may be in flight.
    [[nodiscard]] std::size_t submit(std::span<const world::ChunkPos> positions) override;
    [[nodiscard]] std::vector<gen::GeneratedChunk> take(bool wait) override;
    std::string_view backend() const override { return "gpu"; }
    int level() const override;

  private:
    struct Impl;
    explicit GpuGenerator(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace terrane::gen_gpu
