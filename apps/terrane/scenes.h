// The reference scenes: fixed places in the world of seed 1 with the character that measurements and images
// need.
#pragma once

#include <span>
#include <string_view>

#include "terrane/render/camera.h"

namespace terrane::app {

struct Scene {
    std::string_view name;
    render::Camera camera;
    float timeDay;
};

std::span<const Scene> scenes();
const Scene* findScene(std::string_view name);  // null where there is none

}  // namespace terrane::app
