#include "terrane/light_gpu/gpu_light_solver.h"

#include <algorithm>

namespace terrane::light_gpu {
namespace {

constexpr int kPartChunks = 16;  // a side

}  // namespace

base::Result<GpuLightSolver> GpuLightSolver::create(const gpu::ShaderLoader& shaders,
                                                    const light::LightTable& table) {
    auto lighter = TERRANE_TRY(GpuBatchLighter::create(shaders, table));
    return GpuLightSolver(std::move(lighter));
}

std::vector<light::ChunkLight> GpuLightSolver::solve(const light::LightArea& area) {
    light::requireWhole(area);
    std::vector<light::ChunkLight> lights(area.chunks.size());
    std::vector<light::LightRequest> part;
    for (int y = 0; y < area.chunksY; y += kPartChunks) {
        for (int x = 0; x < area.chunksX; x += kPartChunks) {
            part.clear();
            for (int cy = y; cy < std::min(y + kPartChunks, area.chunksY); ++cy) {
                for (int cx = x; cx < std::min(x + kPartChunks, area.chunksX); ++cx)
                    part.push_back(light::requestIn(area, cx, cy));
            }
            std::vector<light::ChunkLight> found = light::lightAll(lighter_, part);
            for (std::size_t k = 0; k < found.size(); ++k) {
                const world::ChunkPos pos = part[k].pos;
                lights[static_cast<std::size_t>(pos.x + area.chunksX * pos.y)] = std::move(found[k]);
            }
        }
    }
    return lights;
}

}  // namespace terrane::light_gpu
