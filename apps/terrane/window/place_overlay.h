// Text about the position and the targeted block, at the left of the image. Immediate mode.
#pragma once

#include <string>

#include "apps/terrane/window/overlay.h"
#include "apps/terrane/window/text.h"

namespace terrane::app {

struct PlaceFacts {
    world::Pose pose;
    std::string biome;   // empty: none
    std::string world;   // generator and seed
    std::string target;  // targeted block; empty: none
    double timeDay = 0;  // 0 to 1
    double framesASecond = 0;
};

void drawPlaceFacts(const PlaceFacts& facts, const Texts& tr);

}  // namespace terrane::app
