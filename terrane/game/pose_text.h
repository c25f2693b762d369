// A pose as text, "X Y Z YAW PITCH": in saves and in files of bookmarks.
#pragma once

#include <optional>
#include <string>

#include "terrane/world/pose.h"

namespace terrane::game {

// Reads back as the same pose.
std::string textOf(const world::Pose& pose);
// Nothing for anything else, and for what is no place in the world (world::isInWorld()) or no direction.
std::optional<world::Pose> poseFrom(const std::string& text);

}  // namespace terrane::game
