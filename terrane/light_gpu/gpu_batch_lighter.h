// Lights chunks from scratch in compute shaders: the same levels as light::lightChunk, to the bit.
// docs/light.md has the algorithm. Results come some frames later through memory that nothing waits for. It
// is used on the context's thread.
#pragma once

#include <memory>

#include "terrane/base/result.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/light/batch_lighter.h"
#include "terrane/light/light_area.h"

namespace terrane::light_gpu {

class GpuBatchLighter : public light::BatchLighter {
  public:
    // Creates the lighter. Each of three batches in flight takes GPU memory, sized for the largest batch so
    // far: 8.3 KB a solved section of a solved chunk (requests and their neighbors), 8.2 KB a solved section
    // of a request, and the blocks. Sections of open sky and of rock are not solved (LightBatch::sections).
    // Example: 64 requests in a square have 100 solved chunks; with 10 sections each they take 14 MB. The
    // most, 8,191 sections, takes 136 MB. `table` outlives it.
    [[nodiscard]] static base::Result<GpuBatchLighter> create(const gpu::ShaderLoader& shaders,
                                                              const light::LightTable& table);
    GpuBatchLighter(GpuBatchLighter&&) noexcept;
    GpuBatchLighter& operator=(GpuBatchLighter&&) noexcept;
    ~GpuBatchLighter() override;

    // Accepts up to 256 requests with up to 324 chunks in all, or fewer where they have more than 25 solved
    // sections. A batch ends before a request that has another snapshot of a chunk than those before it, or
    // that requests the same chunk again.
    [[nodiscard]] std::size_t submit(std::span<const light::LightRequest> requests) override;
    // Returns finished results. Light in winding tunnels may need more rounds than a batch has; then several
    // calls without `wait` return nothing.
    [[nodiscard]] std::vector<light::LightResult> take(bool wait) override;
    std::string_view backend() const override { return "gpu"; }

  private:
    struct Impl;
    explicit GpuBatchLighter(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

// Lights whole areas in compute shaders: GpuBatchLighter behind the interface that both back ends have for
// files, tests and benchmarks. It is used on the context's thread.
class GpuLightSolver : public light::AreaSolver {
  public:
    // `table` outlives it.
    static base::Result<GpuLightSolver> create(const gpu::ShaderLoader& shaders,
                                               const light::LightTable& table);

    // Lights areas of any size in parts of 16×16 chunks, one batch each. Waits for the GPU.
    std::vector<light::ChunkLight> solve(const light::LightArea& area) override;
    std::string_view backend() const override { return "gpu"; }

  private:
    explicit GpuLightSolver(GpuBatchLighter lighter) : lighter_(std::move(lighter)) {}

    GpuBatchLighter lighter_;
};

}  // namespace terrane::light_gpu
