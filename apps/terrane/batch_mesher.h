// Meshes of chunks on the back end that was asked for. The quads are the same.
#pragma once

#include "apps/terrane/backend.h"
#include "terrane/mesh/batch_mesher.h"

namespace terrane::app {

base::Result<OnBackend<mesh::BatchMesher>> makeBatchMesher(Backend backend,
                                                           const world::BlockRegistry& blocks);

}  // namespace terrane::app
