#include "terrane/light_gpu/gpu_batch_lighter.h"

#include <algorithm>
#include <array>
#include <deque>

#include "terrane/light_gpu/light_workspace_internal.h"

namespace terrane::light_gpu {

namespace {

constexpr std::size_t kLightBatchesInFlight = 3;

}  // namespace

struct GpuBatchLighter::Impl {
    Impl(LightPrograms p, const light::LightTable& t) : programs(std::move(p)), table(t) {}

    LightPrograms programs;
    const light::LightTable& table;
    std::array<LightWorkspace, kLightBatchesInFlight> workspaces;
    std::deque<LightWorkspace*> inFlight;  // oldest first
};

GpuBatchLighter::GpuBatchLighter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
GpuBatchLighter::GpuBatchLighter(GpuBatchLighter&&) noexcept = default;
GpuBatchLighter& GpuBatchLighter::operator=(GpuBatchLighter&&) noexcept = default;
GpuBatchLighter::~GpuBatchLighter() = default;

base::Result<GpuBatchLighter> GpuBatchLighter::create(const gpu::ShaderLoader& shaders,
                                                      const light::LightTable& table) {
    auto programs = TERRANE_TRY(LightPrograms::create(shaders));
    return GpuBatchLighter(std::make_unique<Impl>(std::move(programs), table));
}

std::size_t GpuBatchLighter::submit(std::span<const light::LightRequest> requests) {
    const auto workspace = std::find_if(impl_->workspaces.begin(), impl_->workspaces.end(),
                                        [](const LightWorkspace& w) { return w.isFree(); });
    if (workspace == impl_->workspaces.end() || requests.empty()) return 0;
    const auto most = requests.first(std::min(requests.size(), kMaxRequests));
    for (const light::LightRequest& request : most) light::requireLevel0(request);
    const LightBatch batch = gatherBatch(most, impl_->table);
    workspace->start(impl_->programs, batch, impl_->table);
    impl_->inFlight.push_back(&*workspace);
    return batch.requested.size();
}

std::vector<light::LightResult> GpuBatchLighter::take(bool wait) {
    if (impl_->inFlight.empty() || !impl_->inFlight.front()->isFinished(impl_->programs, wait)) return {};
    LightWorkspace& oldest = *impl_->inFlight.front();
    impl_->inFlight.pop_front();
    return oldest.takeResult();
}

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
