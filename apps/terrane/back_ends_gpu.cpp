#include "apps/terrane/back_ends.h"

#include <nlohmann/json.hpp>

#include "terrane/gen_gpu/gpu_generator.h"
#include "terrane/gpu/context.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/io/open_session.h"
#include "terrane/light_gpu/gpu_batch_lighter.h"
#include "terrane/mesh_gpu/gpu_mesher.h"
#include "terrane/render/quads/draw_check.h"

namespace terrane::app {
namespace {

using Context = std::shared_ptr<gpu::HeadlessContext>;

// A headless context for work on the GPU; null for work on the CPU.
base::Result<Context> openContext(Backend backend) {
    if (!usesGpu(backend)) return nullptr;
    auto context = TERRANE_TRY(gpu::HeadlessContext::create({}));
    return std::make_shared<gpu::HeadlessContext>(std::move(context));
}

// `makeCpu` returns a Result<unique_ptr<Worker>>, `makeGpu` a Result of a class that implements Worker in the
// context.
template <class Worker, class MakeCpu, class MakeGpu>
base::Result<OnBackend<Worker>> makeOnBackend(Backend backend, const MakeCpu& makeCpu,
                                              const MakeGpu& makeGpu) {
    auto context = TERRANE_TRY(openContext(backend));
    if (!context) {
        std::unique_ptr<Worker> worker = TERRANE_TRY(makeCpu());
        return OnBackend<Worker>{nullptr, std::move(worker)};
    }
    auto worker = makeGpu();
    if (!worker) return tl::unexpected(worker.error());
    using GpuWorker = typename decltype(worker)::value_type;
    return OnBackend<Worker>{std::move(context), std::make_unique<GpuWorker>(std::move(*worker))};
}

}  // namespace

bool usesGpu(Backend backend) {
    return backend == Backend::Gpu;
}

base::Result<OnBackend<gen::BatchGenerator>> makeBatchGenerator(const io::WorldOptions& options,
                                                                Backend backend, const pack::Content& content,
                                                                int level) {
    const auto makeCpu = [&]() -> base::Result<std::unique_ptr<gen::BatchGenerator>> {
        auto generator = TERRANE_TRY(io::makeGenerator(options, content, level));
        return gen::makeCpuGenerator(std::move(generator), io::threadCount(options));
    };
    const auto makeGpu = [&]() -> base::Result<gen_gpu::GpuGenerator> {
        auto graph = TERRANE_TRY(io::makeGraph(options, content, level));
        return gen_gpu::GpuGenerator::create(gpu::builtInShaders(""), graph, options.effectiveSeed());
    };
    return makeOnBackend<gen::BatchGenerator>(backend, makeCpu, makeGpu);
}

base::Result<OnBackend<light::AreaSolver>> makeLightSolver(Backend backend, const light::LightTable& table) {
    const auto makeCpu = [&]() -> base::Result<std::unique_ptr<light::AreaSolver>> {
        return light::makeCpuSolver(table);
    };
    const auto makeGpu = [&] { return light_gpu::GpuLightSolver::create(gpu::builtInShaders(""), table); };
    return makeOnBackend<light::AreaSolver>(backend, makeCpu, makeGpu);
}

base::Result<OnBackend<mesh::BatchMesher>> makeBatchMesher(Backend backend,
                                                           const world::BlockRegistry& blocks) {
    const auto makeCpu = []() -> base::Result<std::unique_ptr<mesh::BatchMesher>> {
        return mesh::makeCpuMesher();
    };
    const auto makeGpu = [&]() -> base::Result<mesh_gpu::GpuBatchMesher> {
        auto mesher = TERRANE_TRY(mesh_gpu::GpuMesher::create(gpu::builtInShaders(""), blocks));
        return mesh_gpu::GpuBatchMesher(std::move(mesher));
    };
    return makeOnBackend<mesh::BatchMesher>(backend, makeCpu, makeGpu);
}

nlohmann::json graphicsInfo() {
    const auto context = gpu::HeadlessContext::create({});
    if (!context) return {{"error", context.error().message}};
    const gpu::DeviceInfo d = render::checkedDevice(gpu::builtInShaders(""));
    return {{"vendor", d.vendor},
            {"renderer", d.renderer},
            {"version", d.version},
            {"glsl", d.glsl},
            {"software", d.software},
            {"max_samples", d.maxSamples},
            {"max_storage_block_bytes", d.maxStorageBlockBytes},
            {"max_texture_size", d.maxTextureSize},
            {"max_texture_3d_size", d.maxTexture3dSize},
            {"max_anisotropy", d.maxAnisotropy},
            {"subpixel_bits", d.subpixelBits},
            {"indirect_draws", d.indirectDraws},
            {"indirect_counts", d.indirectCount}};
}

}  // namespace terrane::app
