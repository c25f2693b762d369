// Names of this machine and of this process, to be read by people on other machines.
#pragma once

#include <string>

namespace terrane::app {

std::string machineName();  // "localhost" if it has no name
std::string processName();  // "mill process 123"

}  // namespace terrane::app
