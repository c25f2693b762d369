// --backend of commands that draw: whether workers or the GPU generate, light and mesh the world on screen.
#pragma once

#include "apps/terrane/back_ends.h"
#include "terrane/view/gpu_back_ends.h"

namespace terrane::app {

// True for Backend::Gpu; Auto is the CPU (back_ends.h).
bool usesGpu(Backend backend);

// Makes the GPU back ends and sets `parts` to use them; null if workers do the work. `generators` include the
// world's generator. The OpenGL context is current. Always uses the built-in shaders, not those of
// --shader-root.
base::Result<std::unique_ptr<view::GpuBackEnds>> chooseBackEnds(game::SessionParts& parts,
                                                                const gen::GeneratorCatalogue& generators,
                                                                Backend backend);

}  // namespace terrane::app
