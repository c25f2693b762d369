// Debug view: a map of the loading state of the chunks around the camera, and of the far tiles beyond.
#pragma once

#include "apps/terrane/window/overlay.h"

namespace terrane::app {

void drawLoadingMap(const Screen& screen, const stream::ChunkPipeline& pipeline,
                    const stream::TileTable& tiles);

}  // namespace terrane::app
