// A call from a script that records a generator: arguments and results are expressions too.
//
//     int perlin2D(GraphCall& c) { return c.push(c.pass().perlin2D(c.name(1), …)); }
#pragma once

#include <initializer_list>
#include <variant>
#include <vector>

#include "terrane/lua/call.h"
#include "terrane/lua/object_internal.h"
#include "terrane/lua/recording_internal.h"

namespace terrane::lua {

class GraphCall : public Call {
  public:
    explicit GraphCall(lua_State* state) : Call(state), recording(recordingOf(state)) {}

    Recording& recording;

    gen::Pass& pass() { return *recording.pass; }  // in methods of a pass, which is open then

    std::string_view name(int argument);  // makes a seed: for noises, random numbers
    std::int32_t size(int argument) const { return integer(argument, 1, 65536); }  // in blocks
    std::vector<float> weights(int argument);                                      // of 1 to 12 octaves

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

    // Takes the object of a method away.
    void begin();
    // Throws the last mistake that the builder noted, or an error if the recording exceeds a limit.
    void finish();
};

using GraphFunction = FunctionOf<GraphCall>;

// Adds methods of objects with this tag.
inline void addMethods(lua_State* L, std::span<const GraphFunction> functions, Tag self) {
    addFunctions(L, functions, static_cast<lua_Integer>(self));
}

// Tables of named numbers, {size = 128, octaves = 5}, as arguments.
struct Option {
    const char* name;
    std::variant<int*, float*> value;
};

// Sets the options that the table names. Throws on unknown names and on values that are not numbers.
void readOptions(GraphCall& c, int argument, std::initializer_list<Option> options);

// The functions that generators have beside those of all scripts, by the file that has them.
std::span<const GraphFunction> expressionFunctions();  // expression_functions.cpp: select, min, sin, …
std::span<const GraphFunction> operators();            // operators.cpp, named as fields of metatables
std::span<const GraphFunction> comparisons();          // operators.cpp: lt, le, …
std::span<const GraphFunction> generatorMethods();     // generator_methods.cpp
std::span<const GraphFunction> passMethods();          // pass_methods.cpp
std::span<const GraphFunction> noiseMethods();         // noise_methods.cpp: of passes too

}  // namespace terrane::lua
