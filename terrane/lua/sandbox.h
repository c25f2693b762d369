// A Lua state for scripts that nobody trusts: it has only the functions that it is given, limits of steps,
// time and memory (budget.h), no files, no clock, no addresses, and errors of one line that name file and
// line. Generators (script.h) and rules (terrane/rules) run in one. One thread uses a sandbox.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/lua/budget.h"

namespace terrane::lua {

struct Script {
    std::string text;  // source; compiled scripts are refused
    std::string file;  // stands in errors: "generators/isles.lua:12: unknown block "gras""
};

constexpr std::size_t kMaxScriptBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxScripts = 64;  // in one sandbox: each has a letter

// What the functions of a state share. Users of sandboxes derive from it.
struct Sandbox {
    explicit Sandbox(const Limits& limits = {}) : budget(limits) {}

    Budget budget;
    std::vector<std::string> files;                      // of the scripts that ran, by letter
    std::function<void(std::string_view line)> print{};  // takes the lines of print(); empty: none
    int printsLeft = 20;
};

// Returns the sandbox of a state from openState().
Sandbox& sandboxOf(lua_State* L);

struct CloseState {
    void operator()(lua_State* state) const;
};
using StatePtr = std::unique_ptr<lua_State, CloseState>;

// Creates a state with the basic functions. `addGlobals` adds others to the table of globals, which is on top
// of the stack. The sandbox must outlive the state, whose memory it counts. Returns null without memory.
StatePtr openState(Sandbox& sandbox, void (*addGlobals)(lua_State*));

// Runs the script. Returns the reason if it fails, "FILE:LINE: reason", else an empty string.
std::string runScript(lua_State* L, const Script& script);
// Calls the function below `arguments` values on the stack, and removes them. Its `results` are on the stack
// unless it fails. Returns as runScript().
std::string callScript(lua_State* L, int arguments, int results = 0);

// Returns the names of the globals and their members: "select", "string.rep".
std::vector<std::string> globalsOf(lua_State* L);

}  // namespace terrane::lua
