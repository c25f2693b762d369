// All functions that scripts can call, by the file that has them. state.cpp gives them to a state.
#pragma once

#include <span>

#include "terrane/lua/call_internal.h"

namespace terrane::lua {

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
