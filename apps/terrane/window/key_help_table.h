// Draws the keys of key_help.h in two columns, in the player's language.
#pragma once

#include <string>
#include <vector>

#include "apps/terrane/window/text.h"

namespace terrane::app {

struct KeyHelpLine {
    std::string keys, action;
};

std::vector<KeyHelpLine> keyHelpLines();  // of kKeyHelp
// Draws into the current Dear ImGui window; lines wrap at `width`.
void drawKeyHelp(float width, const Texts& tr);

}  // namespace terrane::app
