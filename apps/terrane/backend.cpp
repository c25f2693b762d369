#include "apps/terrane/backend.h"

#include "apps/terrane/options.h"

#include "terrane/gpu/device_info.h"

namespace terrane::app {

void addBackendOption(CLI::App& command, Backend& backend, const std::string& description) {
    addChoice<Backend>(command, "--backend", backend,
                       {{"auto", Backend::Auto}, {"cpu", Backend::Cpu}, {"gpu", Backend::Gpu}}, description);
}

bool usesGpu(Backend backend) {
    return backend == Backend::Gpu || (backend == Backend::Auto && !gpu::queryDevice().software);
}

base::Result<std::optional<gpu::HeadlessContext>> openBackend(Backend backend) {
    if (backend == Backend::Cpu) return std::nullopt;
    auto context = gpu::HeadlessContext::create({});
    if (context && usesGpu(backend)) return std::move(*context);
    if (!context && backend == Backend::Gpu) return tl::unexpected(context.error());
    return std::nullopt;
}

}  // namespace terrane::app
