// The list of keys, for `terrane play --help` and the window.
#pragma once

#include <string>
#include <vector>

#include "apps/terrane/window/settings/key_bindings.h"
#include "apps/terrane/window/text.h"

namespace terrane::app {

struct KeyHelpLine {
    std::string keys, effect;
};

// The name of the key, or the word for none, in the player's language.
std::string keyText(std::optional<Key> key, const Texts& tr);
std::string padButtonText(std::optional<PadButton> button, const Texts& tr);
// The player's keys and the fixed ones.
std::vector<KeyHelpLine> keyHelpLines(const KeyBindings& bindings, const Texts& tr);
// The few lines that a new player needs.
std::vector<std::string> hintLines(const KeyBindings& bindings, const Texts& tr);
// The default keys in English: indented lines in two columns.
std::string keyHelpText();

}  // namespace terrane::app
