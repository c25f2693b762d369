// Opens and closes the menu, dialogs and the question before unsaved data is lost; captures the mouse.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/terrane/window/game/game_state.h"
#include "apps/terrane/window/hud/overlay_layout.h"
#include "apps/terrane/window/settings/key_bindings.h"
#include "apps/terrane/window/text.h"
#include "terrane/store/chunk_store.h"

namespace terrane::app {

// Notices while a world cannot be saved. Immediate mode: drawn each frame.
// Shows the error, its duration and the number of waiting chunks at the top of the screen. Draws nothing
// while saving works.
void drawSaveNotice(OverlayLayout& layout, const store::SaveStatus& status, const Texts& tr);

enum class QuitChoice : std::uint8_t { Stay, TryAgain, QuitUnsaved };

// Asks what to do after the last attempt to save failed. None until a button is clicked.
std::optional<QuitChoice> drawQuitDialog(const Screen& screen, const store::SaveStatus& status,
                                         const Texts& tr);

// The menu of the paused game. Immediate mode: drawn each frame.
enum class PauseChoice : std::uint8_t { Resume, Settings, Help, ToTitle, Quit };

// None until a button is clicked, or chosen with the arrow keys and Enter.
std::optional<PauseChoice> drawPauseMenu(const Screen& screen, const KeyBindings& keys, const Texts& tr);

// Captures the mouse for the player and closes dialogs, or frees the cursor.
void captureMouse(GameState& game, bool isCaptured);

// Ends the loop.
void leave(Leaving& leaving, bool toTitle);

// Closes the last thing that opened, for one press of Escape; if nothing is open, pauses the game.
void closeOne(GameState& game);
void answerPauseMenu(GameState& game, PauseChoice choice);

// Asks the player before unsaved data is lost; false, without asking, after a signal or if the player already
// agreed.
bool askBeforeLoss(GameState& game);
void answerQuitDialog(GameState& game, QuitChoice choice);

}  // namespace terrane::app
