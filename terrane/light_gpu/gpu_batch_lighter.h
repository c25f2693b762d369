// Light from scratch in compute shaders: the same levels as light::lightChunk, to the bit. docs/light.md
// tells how. Results come some frames later through memory that nothing waits for. Used on the context's
// thread.
#pragma once

#include <memory>

#include "terrane/base/result.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/light/batch_lighter.h"

namespace terrane::light_gpu {

class GpuBatchLighter : public light::BatchLighter {
  public:
    // Memory on the GPU for each of three batches in flight, as large as the largest batch was: 132 KB a
    // chunk that is lit or lies beside one, 129 KB a chunk that is lit, and the blocks. 64 chunks of a square
    // are 100 with those around them, in buffers of 128: 25 MB; the most, 256 of 324, 85 MB. `table` outlives
    // it.
    [[nodiscard]] static base::Result<GpuBatchLighter> create(const gpu::ShaderLoader& shaders,
                                                              const light::LightTable& table);
    GpuBatchLighter(GpuBatchLighter&&) noexcept;
    GpuBatchLighter& operator=(GpuBatchLighter&&) noexcept;
    ~GpuBatchLighter() override;

    // Takes up to 256 requests of 324 chunks with those around them. A batch ends before a request that knows
    // another snapshot of a chunk than those before it, or that asks for the same chunk again.
    [[nodiscard]] std::size_t submit(std::span<const light::LightRequest> requests) override;
    // Light of winding tunnels takes more than one call without waiting.
    [[nodiscard]] std::vector<light::LightResult> take(bool wait) override;
    std::string_view backend() const override { return "gpu"; }

  private:
    struct Impl;
    explicit GpuBatchLighter(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace terrane::light_gpu
