// A map of the chunks around the camera and how far each is: a pixel for what nobody sees otherwise.
#pragma once

#include "apps/terrane/window/overlay.h"

namespace terrane::app {

void drawLoadingMap(const Screen& screen, const stream::ChunkPipeline& pipeline, world::ChunkPos center,
                    int viewDistance);

}  // namespace terrane::app
