// Light from scratch in compute shaders: the same levels as light::lightArea, to the bit. docs/light.md tells
// how. Used on the context's thread.
#pragma once

#include <memory>

#include "terrane/base/result.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/light/area_solver.h"

namespace terrane::light_gpu {

class GpuLightSolver : public light::AreaSolver {
  public:
    // Memory on the GPU: 77 MB, of which levels of 324 chunks take 42 and the result of 256 of them 34; and
    // the blocks that light is found for.
    static base::Result<GpuLightSolver> create(const gpu::ShaderLoader& shaders,
                                               const light::LightTable& table);
    GpuLightSolver(GpuLightSolver&&) noexcept;
    GpuLightSolver& operator=(GpuLightSolver&&) noexcept;
    ~GpuLightSolver() override;

    // Any size, in parts of 16×16 chunks. Waits for the GPU.
    std::vector<light::ChunkLight> solve(const light::LightArea& area) override;
    std::string_view backend() const override { return "gpu"; }

  private:
    struct Impl;
    explicit GpuLightSolver(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace terrane::light_gpu
