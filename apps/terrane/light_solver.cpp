#include "apps/terrane/light_solver.h"

#include "apps/terrane/content.h"
#include "terrane/light_gpu/gpu_light_solver.h"

namespace terrane::app {

base::Result<OnBackend<light::AreaSolver>> makeLightSolver(Backend backend, const light::LightTable& table) {
    const auto makeCpu = [&]() -> base::Result<std::unique_ptr<light::AreaSolver>> {
        return light::makeCpuSolver(table);
    };
    const auto makeGpu = [&] { return light_gpu::GpuLightSolver::create(makeShaderLoader(""), table); };
    return makeOnBackend<light::AreaSolver>(backend, makeCpu, makeGpu);
}

}  // namespace terrane::app
