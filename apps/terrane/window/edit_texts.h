// Texts about results of edits, in the player's language.
#pragma once

#include <string>

#include "apps/terrane/window/text.h"
#include "terrane/game/session.h"

namespace terrane::app {

// Why an edit was refused; empty if it was not, or needs no message.
std::string refusalText(game::EditResult result, const Texts& tr);
// The result of an undo or a redo; empty while a server decides.
std::string takenBackText(const game::TakenBack& done, game::HistoryWay way, const Texts& tr);

}  // namespace terrane::app
