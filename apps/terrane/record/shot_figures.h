// The figures of a shot's players at a time. A pure function; any thread.
#pragma once

#include <vector>

#include "apps/terrane/record/script.h"
#include "terrane/world/figure.h"

namespace terrane::app {

// In the order of the shot's players. A figure walks from the start of the shot in steps of its own, so that
// it is the same at any frame rate, and where a video begins in the middle of the shot. An arm swings while
// the player's edits are made.
std::vector<world::Figure> figuresAt(const Shot& shot, double secondsInShot);

}  // namespace terrane::app
