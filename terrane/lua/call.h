// A call from a script into C++: its arguments, its results, its errors. Every function that scripts can call
// is
//
//     int repeat(Call& c) { … c.text(1) … lua_pushlstring(c.L, …); return 1; }
//
// and stands in a table of Functions. It returns how many results it pushed and throws ScriptError, which
// becomes an error at the script's line. Errors of Lua are C++ exceptions too, so destructors always run.
// Users of sandboxes derive from Call and have tables of FunctionOf<their class>.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "terrane/lua/lua_headers.h"
#include "terrane/lua/sandbox.h"

namespace terrane::lua {

struct ScriptError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
    throw ScriptError(fmt::format(format, std::forward<Args>(args)...));
}

class Call {
  public:
    explicit Call(lua_State* state) : L(state), sandbox(sandboxOf(state)) {}

    lua_State* const L;
    Sandbox& sandbox;
    std::string_view function;  // the script's name of it, for messages

    // Counts steps. Throws once the script has used up its steps or its time.
    void charge(std::int64_t steps);

    // Arguments count from 1, after the object of a method.
    int count() const { return arguments_; }
    bool isMissing(int argument) const { return lua_isnoneornil(L, argument); }
    bool isNumber(int argument) const { return lua_type(L, argument) == LUA_TNUMBER; }
    // Returns the value as messages show it: "Float", "number 1.5", "nil".
    std::string described(int argument) const;
    [[noreturn]] void expected(int argument, std::string_view what) const;

    std::string_view text(int argument) const;
    std::int32_t integer(int argument) const;
    std::int32_t integer(int argument, std::int32_t least, std::int32_t most) const;
    float number(int argument) const;  // finite
    void table(int argument) const;
    // Returns the length of a list. Throws if its positive whole keys are not exactly 1…n: if a list has
    // holes, the length that Lua gives depends on a hash seed. Goes through all keys, which costs steps.
    lua_Integer listLength(int argument);
    void function_(int argument) const;

    // Called before and after a function of a script, by its arguments on the stack.
    void begin() { arguments_ = lua_gettop(L); }
    void finish() {}

  protected:
    // Returns how errors of an argument begin: "rep: argument 2: ".
    std::string prefix(int argument) const;

  private:
    int arguments_ = 0;
};

template <class C>
struct FunctionOf {
    const char* name;
    int (*call)(C&);
};
using Function = FunctionOf<Call>;

constexpr std::int64_t kStepsOfCall = 40;  // 200 ns

// Calls `body`. What it throws becomes an error of Lua.
int callGuarded(lua_State* L, int (*body)(lua_State*));

template <class C>
int enter(lua_State* L) {
    return callGuarded(L, [](lua_State* state) {
        C c(state);
        const auto& function = *static_cast<const FunctionOf<C>*>(lua_touserdata(state, lua_upvalueindex(1)));
        c.function = function.name;
        c.charge(kStepsOfCall);
        c.begin();
        const int results = function.call(c);
        c.finish();
        return results;
    });
}

// Pushes the function. `tag` is its second upvalue, for derived classes of Call.
template <class C>
void pushFunction(lua_State* L, const FunctionOf<C>& function, lua_Integer tag = 0) {
    // Lua's interface has no const. NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
    lua_pushlightuserdata(L, const_cast<FunctionOf<C>*>(&function));
    lua_pushinteger(L, tag);
    lua_pushcclosure(L, enter<C>, 2);
}

// Adds the functions to the table on top of the stack, by their names.
template <class C>
void addFunctions(lua_State* L, std::span<const FunctionOf<C>> functions, lua_Integer tag = 0) {
    for (const FunctionOf<C>& function : functions) {
        pushFunction(L, function, tag);
        lua_setfield(L, -2, function.name);
    }
}

// Returns the name that type() returns: "number", "table", "Float".
std::string_view typeNameAt(lua_State* L, int index);
// Returns whether the value is a number that is not a number: its sign, which C prints, differs by processor.
bool isNotANumber(lua_State* L, int index);
// Returns whether the text of the value is the same on every machine. That of tables, functions and objects
// is an address.
bool hasText(lua_State* L, int index);

// The functions that all scripts have, by the file that has them.
std::span<const Function> baseFunctions();    // base_functions.cpp: print, pairs, type, …
std::span<const Function> stringFunctions();  // string_functions.cpp
std::span<const Function> tableFunctions();   // table_functions.cpp

}  // namespace terrane::lua
