#include "apps/terrane/light_solver.h"

#include "apps/terrane/content.h"
#include "terrane/light_gpu/gpu_light_solver.h"

namespace terrane::app {

base::Result<OnBackend<light::AreaSolver>> makeLightSolver(Backend backend, const light::LightTable& table) {
    using Made = OnBackend<light::AreaSolver>;
    auto context = openBackend(backend);
    if (!context) return tl::unexpected(context.error());
    if (!*context) return Made{std::nullopt, light::makeCpuSolver(table)};
    auto solver = light_gpu::GpuLightSolver::create(makeShaderLoader(""), table);
    if (!solver) return tl::unexpected(solver.error());
    return Made{std::move(*context), std::make_unique<light_gpu::GpuLightSolver>(std::move(*solver))};
}

}  // namespace terrane::app
