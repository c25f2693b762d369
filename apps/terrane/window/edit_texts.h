// What became of an edit, in the player's language.
#pragma once

#include <string>

#include "apps/terrane/window/text.h"
#include "terrane/game/session.h"

namespace terrane::app {

// Why an edit was refused; empty where there is nothing to tell.
std::string refusalText(game::EditResult result, const Texts& tr);
// Of an undo, or a redo; empty while a server decides.
std::string takenBackText(const game::TakenBack& done, bool isUndo, const Texts& tr);

}  // namespace terrane::app
