// The dialog of a world's named places: names the current position, goes to places, removes them. Immediate
// mode: drawn each frame.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "apps/terrane/window/overlay.h"
#include "apps/terrane/window/text.h"
#include "terrane/game/places.h"

namespace terrane::app {

struct PlacesState {
    bool isOpen = false;
    std::array<char, game::kMaxPlaceName + 1> name{};

    void open() { *this = {.isOpen = true, .name = {}}; }
};

struct PlacesAnswer {
    bool isChanged = false;           // `places` must be saved
    std::optional<world::Pose> goTo;  // place to go to
};

// `here`: the player's pose. Changes `places`.
PlacesAnswer drawPlaces(const Screen& screen, PlacesState& state, std::vector<game::Place>& places,
                        const world::Pose& here, const Texts& tr);

}  // namespace terrane::app
