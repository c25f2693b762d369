// A strip at the top of the image with the directions and named places. Immediate mode.
#pragma once

#include <span>

#include "apps/terrane/window/hud/overlay_layout.h"
#include "terrane/game/places.h"

namespace terrane::app {

void drawCompass(OverlayLayout& layout, const world::Pose& pose, std::span<const game::Place> places);

// Debug view: a map of the loading state of the chunks around the camera, and of the far tiles beyond.
void drawLoadingMap(OverlayLayout& layout, const stream::ChunkPipeline& pipeline,
                    const stream::TileTable& tiles);

}  // namespace terrane::app
