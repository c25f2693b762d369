// A Lua state with nothing in it but what scripts may use. One thread.
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

// The recording must outlive the state, whose memory it counts. Null if there is no memory.
StatePtr makeState(Recording& recording);

// Runs the script. Returns the reason if it fails, "FILE:LINE: reason", else an empty string.
std::string runScript(lua_State* state, const Script& script);

}  // namespace terrane::lua
