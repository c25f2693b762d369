// Handles keys, mouse and gamepad.
#pragma once

#include "apps/terrane/window/game/game_state.h"

namespace terrane::app {

// Actions of the player: break and build, undo, and everything bound to keys; also the world's thumbnail.
// Does nothing for actions of held keys: see moveKeysOf(). `seconds`: of the window's clock, when the key was
// pressed.
void act(GameState& game, Action action, double seconds);
// Breaks or builds while a button is held; shows it with the arm and particles. `seconds`: since the last
// frame. No value if nothing was tried.
std::optional<game::EditResult> breakAndBuild(game::BlockInteraction& interaction, game::Session& session,
                                              const game::Player& player, Hud& hud, double seconds);
// Writes the thumbnail for the list of worlds over the last one. Does nothing if the world has no file for
// it.
void writeThumbnailOf(const render::Renderer& renderer, const std::filesystem::path& file);

// Handles all events since the last frame.
void handleEvents(GameState& game);
// Sticks turn the view; buttons do the actions that they are bound to. Also ends what released keys did.
void handlePad(GameState& game, double seconds);
// While a key of time is held, a day passes in ten seconds.
void passHeldTime(GameState& game, double seconds);
// The state of the keys and the stick that move the player.
game::MoveKeys moveKeysOf(const GameState& game);

}  // namespace terrane::app
