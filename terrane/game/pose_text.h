// A pose as text, "X Y Z YAW PITCH", in saves and files of bookmarks.
#pragma once

#include <optional>
#include <string>

#include "terrane/world/pose.h"

namespace terrane::game {

// poseFrom() gives the same pose back.
std::string textOf(const world::Pose& pose);
// Nothing if the text is invalid, the position is not in the world (world::isInWorld()) or the direction is
// none.
std::optional<world::Pose> poseFrom(const std::string& text);

}  // namespace terrane::game
