// A Lua state that has only the functions that scripts may use. One thread uses it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "terrane/lua/recording_internal.h"

namespace terrane::lua {

struct CloseState {
    void operator()(lua_State* state) const { lua_close(state); }
};
using StatePtr = std::unique_ptr<lua_State, CloseState>;

// Creates a state. The recording must outlive the state, whose memory it counts. Returns null if there is no
// memory.
StatePtr makeState(Recording& recording);

// Runs the script. Returns the reason if it fails, "FILE:LINE: reason", else an empty string.
std::string runScript(lua_State* state, const Script& script);

// Returns the names of all functions and members that scripts can use, sorted: "select", "string.rep",
// "Generator:field", "Expression:lt", "Variable.value" … Any thread; tests compare them with the
// documentation.
std::vector<std::string> scriptFunctions();

}  // namespace terrane::lua
