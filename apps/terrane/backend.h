// --backend: whether work that both can do is done by the processor or by the graphics card.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "apps/terrane/option_values.h"
#include "terrane/gpu/context.h"

namespace terrane::app {

enum class Backend : std::uint8_t { Auto, Cpu, Gpu };

// Auto is the GPU where the renderer is a real one.
void addBackendOption(CLI::App& command, Backend& backend, const std::string& description);

// Of the current context: whether it is to do the work.
bool usesGpu(Backend backend);

// A context to work in, or nothing where the processor is to do it.
base::Result<std::optional<gpu::HeadlessContext>> openBackend(Backend backend);

// What works on a back end, and the context that it works in, if it does.
template <class Worker>
struct OnBackend {
    std::optional<gpu::HeadlessContext> context;  // outlives what lives in it
    std::unique_ptr<Worker> worker;
};

// `makeCpu` returns a Result<unique_ptr<Worker>>, `makeGpu` a Result of what implements Worker in the
// context.
template <class Worker, class MakeCpu, class MakeGpu>
base::Result<OnBackend<Worker>> makeOnBackend(Backend backend, const MakeCpu& makeCpu,
                                              const MakeGpu& makeGpu) {
    auto context = openBackend(backend);
    if (!context) return tl::unexpected(context.error());
    if (!*context) {
        base::Result<std::unique_ptr<Worker>> worker = makeCpu();
        if (!worker) return tl::unexpected(worker.error());
        return OnBackend<Worker>{std::nullopt, std::move(*worker)};
    }
    auto worker = makeGpu();
    if (!worker) return tl::unexpected(worker.error());
    using GpuWorker = typename decltype(worker)::value_type;
    return OnBackend<Worker>{std::move(*context), std::make_unique<GpuWorker>(std::move(*worker))};
}

}  // namespace terrane::app
