// Texts of the user interface in the player's language. The sources have them in English as tr("…"); a test
// compares these with the language files.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "terrane/content/language.h"
#include "terrane/game/session.h"
#include "terrane/pack/content.h"

namespace terrane::app {

// Returned texts stay valid while the object lives and keeps its language.
struct Texts {
    content::Language language;

    // For Dear ImGui and printf; has the same fields (%d, {}) as `english`.
    const char* operator()(const char* english) const { return content::text(language, english).data(); }
    std::string block(const world::BlockType& type) const { return content::blockName(language, type); }
    std::string item(const std::string& name) const { return content::itemName(language, name); }
};

// Marks a text that is translated later as tr(kTexts[k]).
constexpr const char* trLater(const char* english) {
    return english;
}

// Values of --language: auto and the codes of the languages.
std::vector<std::pair<std::string, std::string>> languageChoices();
// "auto": the language of the environment, the first of LC_ALL, LC_MESSAGES and LANG that is set.
std::string_view languageCode(const std::string& choice);
Texts textsOf(const std::string& choice);
// With the names of the packs' blocks.
Texts textsOf(const std::string& choice, const pack::Content& content);

// Texts about results of edits, in the player's language.
// Why an edit was refused; empty if it was not, or needs no message.
std::string refusalText(game::EditResult result, const Texts& tr);
// The result of an undo or a redo; empty while a server decides.
std::string takenBackText(const game::UndoResult& done, game::HistoryWay way, const Texts& tr);

}  // namespace terrane::app
