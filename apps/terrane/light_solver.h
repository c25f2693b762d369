// Light of areas on the back end that was asked for. The light is the same.
#pragma once

#include <memory>

#include "apps/terrane/backend.h"
#include "terrane/light/area_solver.h"

namespace terrane::app {

// `table` outlives it.
base::Result<std::unique_ptr<light::AreaSolver>> makeLightSolver(Backend backend,
                                                                 const light::LightTable& table);

}  // namespace terrane::app
