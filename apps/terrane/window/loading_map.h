// A map of the chunks around the camera and how far each is, and of the tiles beyond them: for what nobody
// sees otherwise.
#pragma once

#include "apps/terrane/window/overlay.h"

namespace terrane::app {

void drawLoadingMap(const Screen& screen, const stream::ChunkPipeline& pipeline,
                    const stream::TileTable& tiles);

}  // namespace terrane::app
