// A call from a script into C++: its arguments, its results, its errors. Every function that scripts can call
// is
//
//     int perlin2D(Call& c) { return c.push(c.pass().perlin2D(c.name(1), …)); }
//
// and stands in a table of Functions. It returns how many results it pushed and throws ScriptError, which
// becomes an error at the script's line. Errors of Lua are C++ exceptions too, so destructors always run.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

#include "terrane/lua/object_internal.h"
#include "terrane/lua/recording_internal.h"

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
    explicit Call(lua_State* state);

    lua_State* const L;
    Recording& recording;
    std::string_view function;  // the script's name of it, for messages

    gen::Pass& pass() { return *recording.pass; }  // in methods of a pass, which is open then
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
    std::string_view name(int argument);       // makes a seed: for noises, random numbers
    std::int32_t integer(int argument) const;  // plain ones
    std::int32_t integer(int argument, std::int32_t least, std::int32_t most) const;
    float number(int argument) const;                                              // finite
    std::int32_t size(int argument) const { return integer(argument, 1, 65536); }  // in blocks
    std::vector<float> weights(int argument);                                      // of 1 to 12 octaves
    void table(int argument) const;
    // Returns the length of a list. Throws if its positive whole keys are not exactly 1…n: if a list has
    // holes, the length that Lua gives depends on a hash seed. Goes through all keys, which costs steps.
    lua_Integer listLength(int argument);
    void function_(int argument) const;

    // Returns the expression that an argument is, if any; null for literals. Throws if it belongs to another
    // pass.
    const Expression* expression(int argument) const;
    // Returns an argument as an expression of a kind: literals of the kind too.
    Parts parts(int argument, Kind kind);
    template <class T>
    T get(int argument) {
        return fromParts<T>(parts(argument, kKindOf<T>));
    }
    // Returns the kind that arguments share: numbers take that of the others. Throws if there is none.
    Kind commonKind(std::initializer_list<int> arguments) const;
    const Object& object(int argument, Tag tag) const;
    // Returns the number of the field that is the argument. Throws unless it is of this kind.
    std::uint32_t field(int argument, Kind kind) const;

    // Pushes a value; literals but for blocks as Lua's own.
    int push(Kind kind, const Parts& parts);
    template <class T>
    int push(const T& value) {
        return push(kKindOf<T>, toParts(value));
    }
    // Sets a member of the table on top.
    template <class T>
    void set(const char* key, const T& value) {
        push(value);
        lua_setfield(L, -2, key);
    }

    // Throws the last mistake that the builder noted, or an error if the recording exceeds a limit.
    void checkMistakes();

    // Sets how many arguments the function was called with, after the object of a method.
    void setCount(int arguments) { arguments_ = arguments; }

  private:
    std::string prefix(int argument) const;
    int arguments_ = 0;
};

struct Function {
    const char* name;
    int (*call)(Call&);
};

// Returns whether the value is a number that is not a number: its sign, which C prints, differs by processor.
bool isNotANumber(lua_State* L, int index);
// Returns whether the text of the value is the same on every machine. That of tables, functions and objects
// is an address.
bool hasText(lua_State* L, int index);

// Pushes the function. `self`: of which object it is a method, with a colon; Tag::None: of none.
void pushFunction(lua_State* L, const Function& function, Tag self);
// Adds the functions to the table on top of the stack, by their names.
void addFunctions(lua_State* L, std::span<const Function> functions, Tag self);

// Tables of named numbers, {size = 128, octaves = 5}, as arguments.
struct Option {
    const char* name;
    std::variant<int*, float*> value;
};

// Sets the options that the table names. Throws on unknown names and on values that are not numbers.
void readOptions(Call& c, int argument, std::initializer_list<Option> options);

// All functions that scripts can call, by the file that has them. state.cpp gives them to a state.
std::span<const Function> baseFunctions();        // base_functions.cpp: print, pairs, type, …
std::span<const Function> stringFunctions();      // string_functions.cpp
std::span<const Function> tableFunctions();       // table_functions.cpp
std::span<const Function> expressionFunctions();  // expression_functions.cpp: select, min, sin, …
std::span<const Function> operators();            // operators.cpp, named as fields of metatables
std::span<const Function> comparisons();          // operators.cpp: lt, le, …
std::span<const Function> generatorMethods();     // generator_methods.cpp
std::span<const Function> passMethods();          // pass_methods.cpp
std::span<const Function> noiseMethods();         // noise_methods.cpp: of passes too

}  // namespace terrane::lua
