#include "terrane/game/chat.h"

#include <fmt/format.h>

#include <algorithm>

#include "terrane/game/session.h"

namespace terrane::game {

bool mayChat(Session& session, PlayerId player, const std::string& text) {
    BeforeChat before{{player, text}, {}};
    session.events.beforeChat.notify(before);
    if (before.refusal) session.events.said.notify({player, *before.refusal});
    return !before.refusal;
}

bool runChatCommand(Session& session, PlayerId player, std::string_view line) {
    const std::size_t end = std::min(line.find(' '), line.size());
    const std::string_view name = line.substr(0, end);
    const auto found = std::ranges::find(session.chatCommands, name, &ChatCommand::name);
    if (found == session.chatCommands.end()) return false;
    const std::size_t start = std::min(line.find_first_not_of(' ', end), line.size());
    const CommandLine typed{player, std::string(name), std::string(line.substr(start))};
    BeforeCommand before{typed, {}};
    session.events.beforeCommand.notify(before);
    if (before.refusal) {
        session.events.said.notify({player, *before.refusal});
        return true;
    }
    const auto run = found->run;  // it may add commands
    if (const std::string answer = run(player, typed.arguments); !answer.empty())
        session.events.said.notify({player, answer});
    session.events.command.notify(CommandLine(typed));
    return true;
}

std::string chatHelp(const std::vector<ChatCommand>& commands) {
    std::string text;
    for (const ChatCommand& command : commands)
        text += fmt::format("{}/{}{}{}: {}", text.empty() ? "" : "\n", command.name,
                            command.arguments.empty() ? "" : " ", command.arguments, command.help);
    return text;
}

}  // namespace terrane::game
