// Commands of the server console, which operators can also give in the chat with a leading slash: say, kick,
// ban, op, claim, rollback, stop and others. On the server's thread.
#pragma once

#include <string>
#include <string_view>

#include "terrane/net/server/server_state.h"

namespace terrane::net {

// Runs a line and returns the answer: one or more lines without a final newline. Arguments are separated by
// spaces; double quotes enclose arguments that contain spaces.
std::string runConsoleLine(ServerState& server, std::string_view line,
                           CommandFrom from = CommandFrom::Console);

// One line per command.
std::string consoleHelp();

}  // namespace terrane::net
