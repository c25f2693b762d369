// --backend: whether the CPU or the GPU does work that both can do. Results are equal. This header is free of
// OpenGL: back_ends_gpu.cpp implements it for both, back_ends_cpu.cpp for a build without graphics.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>

#include "apps/terrane/options.h"
#include "terrane/gen/batch_generator.h"
#include "terrane/light/light_area.h"
#include "terrane/mesh/chunk_mesher.h"
#include "terrane/pack/content.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::app {

enum class Backend : std::uint8_t { Auto, Cpu, Gpu };

// Auto is the CPU: on the one machine measured with a graphics card, an NVIDIA H200, 16 threads load a view
// in a quarter of the time or less, and leave the GPU to the frames (docs/performance.md, NVIDIA H200).
void addBackendOption(CLI::App& command, Backend& backend, const std::string& description);

// A worker on a back end, and its OpenGL context if it runs on the GPU.
template <class Worker>
struct OnBackend {
    std::shared_ptr<void> context;  // null on the CPU; outlives the worker
    std::unique_ptr<Worker> worker;
};

base::Result<OnBackend<gen::BatchGenerator>> makeBatchGenerator(const io::WorldOptions& options,
                                                                Backend backend, const pack::Content& content,
                                                                int level = 0);
// `table` outlives it.
base::Result<OnBackend<light::AreaSolver>> makeLightSolver(Backend backend, const light::LightTable& table);
base::Result<OnBackend<mesh::BatchMesher>> makeBatchMesher(Backend backend,
                                                           const world::BlockRegistry& blocks);

// --backend of commands that draw: whether workers or the GPU generate, light and mesh the world on screen.
// True for Backend::Gpu; Auto is the CPU.
bool usesGpu(Backend backend);

// Facts about the graphics driver for `terrane info`; {"error": …} without one.
nlohmann::json graphicsInfo();

}  // namespace terrane::app
