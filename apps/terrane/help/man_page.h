// Makes the manual page terrane(1) from the list of commands.
#pragma once

#include <string>

#include "apps/terrane/help/command_list.h"

namespace terrane::app {

std::string manPage(const CommandList& list, const std::string& version);

}  // namespace terrane::app
