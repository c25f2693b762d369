// Lights whole areas in compute shaders: GpuBatchLighter behind the interface that both back ends have for
// files, tests and benchmarks. Used on the context's thread.
#pragma once

#include "terrane/light/area_solver.h"
#include "terrane/light_gpu/gpu_batch_lighter.h"

namespace terrane::light_gpu {

class GpuLightSolver : public light::AreaSolver {
  public:
    // `table` outlives it.
    static base::Result<GpuLightSolver> create(const gpu::ShaderLoader& shaders,
                                               const light::LightTable& table);

    // Takes areas of any size, in parts of 16×16 chunks, one batch each. Waits for the GPU.
    std::vector<light::ChunkLight> solve(const light::LightArea& area) override;
    std::string_view backend() const override { return "gpu"; }

  private:
    explicit GpuLightSolver(GpuBatchLighter lighter) : lighter_(std::move(lighter)) {}

    GpuBatchLighter lighter_;
};

}  // namespace terrane::light_gpu
