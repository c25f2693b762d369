// Back ends of a build without graphics: always the CPU.
#include "apps/terrane/back_ends.h"

#include <nlohmann/json.hpp>

#include "terrane/io/open_session.h"

namespace terrane::app {
namespace {

template <class Worker>
base::Result<OnBackend<Worker>> onCpu(Backend backend, std::unique_ptr<Worker> worker) {
    if (backend == Backend::Gpu) {
        return base::fail(base::ErrorCode::Unsupported,
                          "--backend gpu: this program was built without graphics");
    }
    return OnBackend<Worker>{nullptr, std::move(worker)};
}

}  // namespace

base::Result<OnBackend<gen::BatchGenerator>> makeBatchGenerator(const io::WorldOptions& options,
                                                                Backend backend, const pack::Content& content,
                                                                int level) {
    auto generator = TERRANE_TRY(io::makeGenerator(options, content, level));
    return onCpu(backend, gen::makeCpuGenerator(std::move(generator), io::threadCount(options)));
}

base::Result<OnBackend<light::AreaSolver>> makeLightSolver(Backend backend, const light::LightTable& table) {
    return onCpu(backend, light::makeCpuSolver(table));
}

base::Result<OnBackend<mesh::BatchMesher>> makeBatchMesher(Backend backend, const world::BlockRegistry&) {
    return onCpu(backend, mesh::makeCpuMesher());
}

nlohmann::json graphicsInfo() {
    return {{"error", "this program was built without graphics"}};
}

}  // namespace terrane::app
