// Computes the figures of a shot's players at a time. Pure; any thread.
#pragma once

#include <vector>

#include "apps/terrane/record/script.h"
#include "terrane/world/figure.h"

namespace terrane::app {

// One figure per player, in the order of the shot. Walking is simulated from the start of the shot in fixed
// steps, so it does not depend on the frame rate or on the first frame of the video. An arm swings during the
// player's edits.
std::vector<world::Figure> figuresAt(const Shot& shot, double secondsInShot);

}  // namespace terrane::app
