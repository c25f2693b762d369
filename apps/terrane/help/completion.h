// Makes completion scripts for shells from the list of commands.
#pragma once

#include <string>

#include "apps/terrane/help/command_list.h"

namespace terrane::app {

std::string bashCompletion(const CommandList& list);
std::string zshCompletion(const CommandList& list);
std::string fishCompletion(const CommandList& list);

}  // namespace terrane::app
