// State of the HUD and of the dialogs of blocks and places. game_interface.h draws them.
#pragma once

#include <optional>
#include <vector>

#include "apps/terrane/window/game/pictures.h"
#include "apps/terrane/window/hud/hand_view.h"
#include "apps/terrane/window/hud/hotbar_view.h"
#include "apps/terrane/window/hud/inventory_dialog.h"
#include "apps/terrane/window/hud/places_panel.h"
#include "terrane/gen/generators/biomes.h"
#include "terrane/view/block_particles.h"

namespace terrane::app {

struct Hud {
    HotbarView hotbar;
    HandView hand;
    ScreenshotView screenshot;
    view::BlockParticles particles;
    PaletteState palette;
    PlacesState placesDialog;
    InventoryState inventory;
    std::vector<game::Place> places;  // named places of this world
    bool showsFacts = false;          // position and biome
    bool isHidden = false;            // all but dialogs and messages
    std::optional<gen::BiomeMap> biomes;
    bool asksForBiomes = true;         // biomes are not looked up yet
    std::optional<world::Pose> spawn;  // found at the first request
    glm::dvec3 walkedFrom{0};          // position in the last frame

    bool hasDialog() const { return palette.isOpen || placesDialog.isOpen || inventory.isOpen; }
    void closeDialog() {
        palette.isOpen = placesDialog.isOpen = false;
        inventory = {};
    }
};

}  // namespace terrane::app
