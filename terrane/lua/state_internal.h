// The sandbox in which generators are recorded. One thread uses it.
#pragma once

#include <string>
#include <vector>

#include "terrane/lua/recording_internal.h"

namespace terrane::lua {

// Creates a state with the functions of generators, as openState().
StatePtr makeState(Recording& recording);

// Returns the names of all functions and members that scripts can use, sorted: "select", "string.rep",
// "Generator:field", "Expression:lt", "Variable.value" … Any thread; tests compare them with the
// documentation.
std::vector<std::string> scriptFunctions();

}  // namespace terrane::lua
