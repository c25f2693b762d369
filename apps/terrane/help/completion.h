// Scripts that complete the command line in shells, made from the list of commands.
#pragma once

#include <string>

#include "apps/terrane/help/command_list.h"

namespace terrane::app {

std::string bashCompletion(const std::vector<CommandListEntry>& commands);
std::string zshCompletion(const std::vector<CommandListEntry>& commands);
std::string fishCompletion(const std::vector<CommandListEntry>& commands);

}  // namespace terrane::app
