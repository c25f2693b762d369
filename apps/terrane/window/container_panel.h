// The slots of an open chest in the middle of the window. Immediate mode: draws, and returns the click.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "apps/terrane/window/overlay.h"
#include "terrane/game/container.h"

namespace terrane::app {

// Image and name of an item, by its name in the inventory.
struct ItemLooks {
    std::function<unsigned(const std::string&)> image;  // OpenGL texture, 0: none
    std::function<std::string(const std::string&)> name;
};

std::optional<game::SlotClick> drawContainer(const Screen& screen, const world::Inventory& items,
                                             const ItemLooks& looks, const Texts& tr);

}  // namespace terrane::app
