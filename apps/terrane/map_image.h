// A map of an area seen from above: each column's topmost block, shaded as relief, water by its depth. Any
// thread.
#pragma once

#include <functional>

#include "apps/terrane/option_values.h"
#include "terrane/base/image.h"
#include "terrane/base/job_system.h"
#include "terrane/gen/generator.h"
#include "terrane/render/block_textures.h"
#include "terrane/world/block_registry.h"

namespace terrane::app {

// One pixel a block; y points up. `onRow` is called with the number of chunk rows done.
base::Result<base::Image> drawMap(const gen::Generator& generator, const world::BlockRegistry& blocks,
                                  const render::TextureSource& textures, const Area& area,
                                  base::JobSystem& jobs, const std::function<void(std::size_t)>& onRow);

}  // namespace terrane::app
