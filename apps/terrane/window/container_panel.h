// The slots of an open chest in the middle of the window. Immediate mode: draws, and tells what was clicked.
#pragma once

#include <functional>
#include <optional>

#include "apps/terrane/window/overlay.h"
#include "terrane/game/container.h"

namespace terrane::app {

// `image`: the OpenGL texture for an item's name, 0: none.
std::optional<game::SlotClick> drawContainer(const Screen& screen, const world::Inventory& items,
                                             const std::function<unsigned(const std::string&)>& image);

}  // namespace terrane::app
