#include "terrane/view/gpu_back_ends.h"

#include <fmt/format.h>

#include <algorithm>

#include "terrane/gen_gpu/gpu_generator.h"
#include "terrane/light_gpu/gpu_batch_lighter.h"

namespace terrane::view {

namespace {

constexpr std::size_t kMebibyte = std::size_t{1} << 20;

// Chunks within the distance and one ring around it.
double chunksAround(int distance) {
    const double side = 2 * distance + 3;
    return side * side;
}

}  // namespace

std::size_t gpuMemoryBudget(const gpu::DeviceInfo& device, std::optional<int> mebibytes) {
    if (mebibytes) return static_cast<std::size_t>(*mebibytes) * kMebibyte;
    if (device.videoMemoryBytes <= 0) return 2048 * kMebibyte;
    return std::max(static_cast<std::size_t>(device.videoMemoryBytes) / 2, 256 * kMebibyte);
}

int fittingViewDistance(const MemoryNeed& need, int distance) {
    if (distance <= kMinViewDistance) return distance;
    const double limit = 15.0 / 16 * static_cast<double>(std::min(need.limitBytes, need.bytes));
    const double chunkBytes =
        static_cast<double>(need.bytes) / static_cast<double>(std::max<std::size_t>(need.chunks, 1));
    int fitting = distance - 1;
    while (fitting > kMinViewDistance && chunksAround(fitting) * chunkBytes > limit) --fitting;
    return fitting;
}

std::string shortViewNotice(int requested, int reached, std::size_t budgetBytes) {
    return fmt::format("view distance {} instead of {}: {} MiB of GPU memory hold no more (--gpu-memory)",
                       reached, requested, budgetBytes / kMebibyte);
}

base::Result<std::unique_ptr<GpuBackEnds>> makeGpuBackEnds(const gpu::ShaderLoader& shaders,
                                                           const gen::GeneratorGraph& graph,
                                                           std::uint64_t seed,
                                                           const world::BlockRegistry& blocks) {
    auto made = std::make_unique<GpuBackEnds>(GpuBackEnds{light::LightTable(blocks), nullptr, nullptr});
    auto generator = TERRANE_TRY(gen_gpu::GpuGenerator::create(shaders, graph, seed));
    made->generator = std::make_unique<gen_gpu::GpuGenerator>(std::move(generator));
    auto lighter = TERRANE_TRY(light_gpu::GpuBatchLighter::create(shaders, made->lights));
    made->lighter = std::make_unique<light_gpu::GpuBatchLighter>(std::move(lighter));
    return made;
}

void useBackEnds(game::SessionParts& parts, const GpuBackEnds& backEnds) {
    parts.batchGenerator = backEnds.generator.get();
    parts.batchLighter = backEnds.lighter.get();
    parts.meshing = stream::MeshPolicy::Caller;
}

base::Result<std::unique_ptr<GpuBackEnds>> useGpuBackEnds(game::SessionParts& parts,
                                                          const gen::GeneratorCatalogue& generators) {
    const store::WorldIdentity& identity = parts.store->identity();
    auto graph =
        TERRANE_TRY(gen::makeGenerator(identity.generator, *parts.blocks, {0, identity.heights}, generators));
    auto made = makeGpuBackEnds(gpu::builtInShaders(""), graph, identity.seed, *parts.blocks);
    if (made) useBackEnds(parts, **made);
    return made;
}

}  // namespace terrane::view
