// Commands of a server's console, which operators can give in the chat as well, behind a slash: say, kick,
// ban, op, claim, rollback, stop and others. On the server's thread.
#pragma once

#include <string>
#include <string_view>

#include "terrane/net/server_state.h"

namespace terrane::net {

// Runs a line, and gives the answer: one or more lines, without a newline at the end. Words are separated by
// spaces; those with spaces stand between double quotes.
std::string runConsoleLine(ServerState& server, std::string_view line);

// A line a command.
std::string consoleHelp();

}  // namespace terrane::net
