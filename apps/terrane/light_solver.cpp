#include "apps/terrane/light_solver.h"

#include "apps/terrane/content.h"
#include "terrane/light_gpu/gpu_light_solver.h"

namespace terrane::app {
namespace {

class SolverWithContext : public light::AreaSolver {
  public:
    SolverWithContext(gpu::HeadlessContext context, light_gpu::GpuLightSolver solver)
        : context_(std::move(context)), solver_(std::move(solver)) {}

    std::vector<light::ChunkLight> solve(const light::LightArea& area) override {
        return solver_.solve(area);
    }
    std::string_view backend() const override { return solver_.backend(); }

  private:
    gpu::HeadlessContext context_;  // outlives what lives in it
    light_gpu::GpuLightSolver solver_;
};

}  // namespace

base::Result<std::unique_ptr<light::AreaSolver>> makeLightSolver(Backend backend,
                                                                 const light::LightTable& table) {
    auto context = openBackend(backend);
    if (!context) return tl::unexpected(context.error());
    if (!*context) return light::makeCpuSolver(table);
    auto solver = light_gpu::GpuLightSolver::create(makeShaderLoader(""), table);
    if (!solver) return tl::unexpected(solver.error());
    return std::make_unique<SolverWithContext>(std::move(**context), std::move(*solver));
}

}  // namespace terrane::app
