// The dialog of a world's named places: names the current position, goes to places, removes them. Immediate
// mode: drawn each frame.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/terrane/window/hud/overlay_layout.h"
#include "apps/terrane/window/text.h"
#include "terrane/game/places.h"

namespace terrane::app {

// Text about the position and the targeted block, at the left of the image. Immediate mode.
struct PlaceFacts {
    world::Pose pose;
    std::string biome;   // empty: none
    std::string world;   // generator and seed
    std::string target;  // targeted block; empty: none
    double timeDay = 0;  // 0 to 1
    double framesASecond = 0;
};

void drawPlaceFacts(OverlayLayout& layout, const PlaceFacts& facts, const Texts& tr);

struct PlacesState {
    bool isOpen = false;
    std::array<char, game::kMaxPlaceName + 1> name{};
    std::string problem;  // why the typed name was refused; empty: it was not

    void open() { *this = {.isOpen = true, .name = {}, .problem = {}}; }
};

struct PlacesAnswer {
    bool isChanged = false;           // `places` must be saved
    std::optional<world::Pose> goTo;  // place to go to
};

// `here`: the player's pose. Changes `places`.
PlacesAnswer drawPlaces(const Screen& screen, PlacesState& state, std::vector<game::Place>& places,
                        const world::Pose& here, const Texts& tr);

}  // namespace terrane::app
