// --backend: whether the CPU or the GPU does work that both can do. Both give the same. The header knows no
// OpenGL: back_ends_gpu.cpp implements it for both, back_ends_cpu.cpp for a build without graphics.
#pragma once

#include <memory>

#include "apps/terrane/option_values.h"
#include "terrane/gen/batch_generator.h"
#include "terrane/light/area_solver.h"
#include "terrane/mesh/batch_mesher.h"
#include "terrane/pack/content.h"
#include "terrane/world/block_registry.h"

namespace terrane::app {

enum class Backend : std::uint8_t { Auto, Cpu, Gpu };

// Auto is the CPU: beside the one graphics card measured, an NVIDIA H200, 16 threads load a view in a quarter
// of the time or less, and leave the GPU to the frames (docs/performance.md, NVIDIA H200).
void addBackendOption(CLI::App& command, Backend& backend, const std::string& description);

// A worker on a back end, and the OpenGL context that it works in, if it does.
template <class Worker>
struct OnBackend {
    std::shared_ptr<void> context;  // outlives what lives in it
    std::unique_ptr<Worker> worker;
};

base::Result<OnBackend<gen::BatchGenerator>> makeBatchGenerator(const WorldOptions& options, Backend backend,
                                                                const pack::Content& content);
// `table` outlives it.
base::Result<OnBackend<light::AreaSolver>> makeLightSolver(Backend backend, const light::LightTable& table);
base::Result<OnBackend<mesh::BatchMesher>> makeBatchMesher(Backend backend,
                                                           const world::BlockRegistry& blocks);

}  // namespace terrane::app
