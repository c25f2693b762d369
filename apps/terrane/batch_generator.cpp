#include "apps/terrane/batch_generator.h"

#include <unordered_map>

#include "apps/terrane/content.h"
#include "apps/terrane/world_session.h"
#include "terrane/base/job_system.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen_gpu/gpu_generator.h"

namespace terrane::app {
namespace {

class CpuBatches : public BatchGenerator {
  public:
    CpuBatches(gen::Generator generator, unsigned threads) : generator_(std::move(generator)) {
        // The calling thread works too, so one worker less.
        if (threads > 1) helpers_.emplace(threads - 1);
    }

    base::Result<void> generate(std::span<const world::ChunkPos> positions,
                                std::span<world::Chunk> chunks) override {
        const auto one = [&](std::size_t k) { chunks[k] = generator_.generate(positions[k]); };
        if (helpers_) return base::parallelFor(*helpers_, positions.size(), one);
        for (std::size_t k = 0; k < positions.size(); ++k) one(k);
        return {};
    }
    std::string backend() const override { return "cpu"; }

  private:
    gen::Generator generator_;
    std::optional<base::JobSystem> helpers_;
};

class GpuBatches : public BatchGenerator {
  public:
    GpuBatches(gpu::HeadlessContext context, gen_gpu::GpuGenerator generator)
        : context_(std::move(context)), generator_(std::move(generator)) {}

    base::Result<void> generate(std::span<const world::ChunkPos> positions,
                                std::span<world::Chunk> chunks) override {
        std::size_t submitted = 0, done = 0;
        while (done < positions.size()) {
            while (submitted < positions.size()) {
                const std::size_t taken = generator_.submit(positions.subspan(submitted));
                if (taken == 0) break;
                submitted += taken;
            }
            // Batches come back in the order in which they were submitted.
            auto batch = generator_.take(true);
            for (auto& [pos, chunk] : *batch) chunks[done++] = std::move(chunk);
        }
        return {};
    }
    std::string backend() const override { return "gpu"; }

  private:
    gpu::HeadlessContext context_;  // outlives what lives in it
    gen_gpu::GpuGenerator generator_;
};

base::Result<std::unique_ptr<BatchGenerator>> makeGpuBatches(const WorldOptions& options,
                                                             const world::BlockRegistry& blocks,
                                                             gpu::HeadlessContext context) {
    auto graph = gen::makeGenerator(options.effectiveGenerator(), blocks);
    if (!graph) return tl::unexpected(graph.error());
    auto generator = gen_gpu::GpuGenerator::create(makeShaderLoader(""), *graph, options.effectiveSeed());
    if (!generator) return tl::unexpected(generator.error());
    return std::make_unique<GpuBatches>(std::move(context), std::move(*generator));
}

}  // namespace

base::Result<std::unique_ptr<BatchGenerator>> makeBatchGenerator(const WorldOptions& options, Backend backend,
                                                                 const world::BlockRegistry& blocks) {
    auto context = openBackend(backend);
    if (!context) return tl::unexpected(context.error());
    if (*context) return makeGpuBatches(options, blocks, std::move(**context));
    auto generator = makeGenerator(options, blocks);
    if (!generator) return tl::unexpected(generator.error());
    return std::make_unique<CpuBatches>(std::move(*generator), threadCount(options));
}

}  // namespace terrane::app
