// Tables of named numbers, {size = 128, octaves = 5}, as arguments.
#pragma once

#include <initializer_list>
#include <variant>

#include "terrane/lua/call_internal.h"

namespace terrane::lua {

struct Option {
    const char* name;
    std::variant<int*, float*> value;
};

// Sets the options that the table names. Throws on unknown names and on values that are not numbers.
void readOptions(Call& c, int argument, std::initializer_list<Option> options);

}  // namespace terrane::lua
