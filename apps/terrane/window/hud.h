// What the window's loop draws over the image while one plays, and the dialogs of blocks and places: their
// state, which holds from frame to frame. Game (game_hud.cpp) fills and draws it.
#pragma once

#include <optional>
#include <vector>

#include "apps/terrane/window/chat_view.h"
#include "apps/terrane/window/hand_view.h"
#include "apps/terrane/window/hotbar_view.h"
#include "apps/terrane/window/other_players.h"
#include "apps/terrane/window/palette.h"
#include "apps/terrane/window/places_panel.h"
#include "apps/terrane/window/screenshot_view.h"
#include "terrane/gen/generators/biome_map.h"
#include "terrane/view/block_particles.h"

namespace terrane::app {

struct Hud {
    HotbarView hotbar;
    HandView hand;
    ScreenshotView screenshot;
    view::BlockParticles particles;
    PaletteState palette;
    PlacesState placesDialog;
    std::vector<game::Place> places;  // of this world
    bool showsFacts = false;          // where one is
    bool isHidden = false;            // all but dialogs and messages
    std::optional<gen::BiomeMap> biomes;
    bool asksForBiomes = true;         // whether there are any: found out when they are first shown
    std::optional<world::Pose> spawn;  // once it was asked for
    ChatView chat;                     // of a server
    OtherPlayers others;
    bool showsPlayers = false;
    glm::dvec3 walkedFrom{0};  // where the player was in the last frame

    bool hasDialog() const { return palette.isOpen || placesDialog.isOpen || chat.isTyping(); }
    void closeDialog() {
        palette.isOpen = placesDialog.isOpen = false;
        chat.endTyping();
    }
};

// Splinters of broken blocks, as squares in the color of their block. `light`: what falls on them, 0…1.
void drawParticles(const Screen& screen, const render::Camera& camera, const view::BlockParticles& particles,
                   const world::TopColors& colors, const glm::vec3& light);

}  // namespace terrane::app
