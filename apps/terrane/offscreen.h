// Opens the world and the graphics that the options of a command name, for render, record and flight-bench.
#pragma once

#include <memory>

#include "apps/terrane/back_ends.h"
#include "apps/terrane/graphics_options.h"
#include "apps/terrane/options.h"
#include "terrane/store/saves/open_world.h"
#include "terrane/view/offscreen.h"

namespace terrane::app {

struct OffscreenOptions {
    io::WorldOptions world;
    io::SaveOptions save;
    GraphicsOptions graphics;
    Backend backend = Backend::Cpu;
    store::WorldAccess access = store::WorldAccess::ReadOnly;
    double meshMilliseconds = view::WorldView::kNoLimit;  // GPU time for meshing per frame
};

base::Result<std::unique_ptr<view::Offscreen>> openOffscreen(const OffscreenOptions& options);

}  // namespace terrane::app
