// Lines that players type: chat, and commands that content packs or programs add. A server and the window of
// a single player call it on the world's thread.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/game/edit_command.h"

namespace terrane::game {

class Session;

// "/home set": name "home", arguments "set".
struct ChatCommand {
    std::string name;             // a-z, 0-9, _
    std::string arguments, help;  // for people: "[set]", "go to your home"
    // Returns a line for the player; empty: none.
    std::function<std::string(PlayerId, const std::string& arguments)> run;
    std::string owner = {};  // the pack that has it; empty: the program
};

// Tells listeners of a line of chat. Returns false if one of them refuses it; its reason was said to the
// player.
[[nodiscard]] bool mayChat(Session& session, PlayerId player, const std::string& text);

// Runs a command of Session::chatCommands, "home set" without its slash. Its answer, or why it is refused, is
// said to the player. Returns false if there is no such command.
bool runChatCommand(Session& session, PlayerId player, std::string_view line);

// Returns a line "/home [set]: go to your home" for each command.
std::string chatHelp(const std::vector<ChatCommand>& commands);

}  // namespace terrane::game
