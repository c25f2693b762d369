// What this machine and this process are called, for people on other machines.
#pragma once

#include <string>

namespace terrane::app {

std::string machineName();  // "localhost" where it has no name
std::string processName();  // "mill process 123"

}  // namespace terrane::app
