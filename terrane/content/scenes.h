// The reference scenes: fixed places in the overworld of seed 1, for measurements and images.
#pragma once

#include <span>
#include <string_view>

#include "terrane/world/pose.h"

namespace terrane::content {

struct Scene {
    std::string_view name;
    world::Pose pose;
    float timeDay;
};

constexpr const char* kSceneGenerator = "overworld";

std::span<const Scene> scenes();
const Scene* findScene(std::string_view name);  // null if there is none

}  // namespace terrane::content
