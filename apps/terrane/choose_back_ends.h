// --backend of commands that draw: who generates, lights and meshes the world on screen.
#pragma once

#include "apps/terrane/back_ends.h"
#include "terrane/view/gpu_back_ends.h"

namespace terrane::app {

// Whether the GPU is to do the work.
bool usesGpu(Backend backend);

// `generators`: the world's is one of them. Null where workers are to do all. Else `parts` use the back ends
// from here on. The context is current.
base::Result<std::unique_ptr<view::GpuBackEnds>> chooseBackEnds(game::SessionParts& parts,
                                                                const gen::GeneratorCatalogue& generators,
                                                                Backend backend);

}  // namespace terrane::app
