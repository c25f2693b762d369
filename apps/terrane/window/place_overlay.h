// Where the player is and what it looks at, in words: at the left of the image. Immediate mode.
#pragma once

#include <string>

#include "apps/terrane/window/overlay.h"
#include "apps/terrane/window/text.h"

namespace terrane::app {

struct PlaceFacts {
    world::Pose pose;
    std::string biome;   // empty: the generator has none
    std::string world;   // generator and seed
    std::string target;  // what is looked at; empty: nothing
    double timeDay = 0;  // 0 to 1
    double framesASecond = 0;
};

void drawPlaceFacts(const PlaceFacts& facts, const Texts& tr);

}  // namespace terrane::app
