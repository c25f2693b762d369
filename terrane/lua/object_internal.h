// The objects that scripts hold beside Lua's own values. All userdata of a state are such objects.
#pragma once

#include <cstdint>
#include <string_view>

#include "terrane/lua/expression_internal.h"
#include "terrane/lua/lua_internal.h"

namespace terrane::lua {

enum class Tag : std::uint8_t { None, Expression, Variable, Field, Drainage, Pass, Generator };

struct Object {
    Tag tag = Tag::None;
    std::uint32_t number = 0;  // the number of a variable, field, map
    Expression expression{};   // a variable, field or pass sets kind and pass alone
};

// Null if the value is no object.
const Object* objectAt(lua_State* L, int index);
// "Float", "Pass", "Field": what type() gives.
std::string_view nameOf(const Object& object);
// The same for any value: "number", "Float".
std::string_view typeNameAt(lua_State* L, int index);

void pushObject(lua_State* L, const Object& object);
// Makes what pushObject needs: operators and methods of each kind of object.
void makeObjectTypes(lua_State* L);

}  // namespace terrane::lua
