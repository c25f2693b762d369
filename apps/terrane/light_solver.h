// Light of areas on the back end that was asked for. The light is the same.
#pragma once

#include "apps/terrane/backend.h"
#include "terrane/light/area_solver.h"

namespace terrane::app {

// `table` outlives it.
base::Result<OnBackend<light::AreaSolver>> makeLightSolver(Backend backend, const light::LightTable& table);

}  // namespace terrane::app
