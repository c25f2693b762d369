// Names of all that scripts can use, for tools that describe them. Any thread.
#pragma once

#include <string>
#include <vector>

namespace terrane::lua {

// Sorted: "select", "string.rep", "Generator:field", "Pass:read", "Expression:lt", "Pass.x", "Variable.value"
// …
std::vector<std::string> scriptFunctions();

}  // namespace terrane::lua
