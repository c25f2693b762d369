#include "terrane/lua/call.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace terrane::lua {

namespace {

constexpr std::int64_t kStepsOfKey = 4;  // 20 ns a key of a table

}  // namespace

int callGuarded(lua_State* L, int (*body)(lua_State*)) {
    std::string reason;
    try {
        return body(L);
    } catch (const std::bad_alloc&) {
        reason = "no memory";
    } catch (const std::exception& e) {
        reason = e.what();
    }
    return luaL_error(L, "%s", reason.c_str());
}

void Call::charge(std::int64_t steps) {
    if (!sandbox.budget.charge(steps)) fail("runs too long");
}

std::string Call::prefix(int argument) const {
    if (function.starts_with("__")) return "";
    if (argument > arguments_ && argument <= lua_gettop(L))
        return fmt::format("{}: ", function);  // in a table
    return fmt::format("{}: argument {}: ", function, argument);
}

bool isNotANumber(lua_State* L, int index) {
    return lua_type(L, index) == LUA_TNUMBER && std::isnan(lua_tonumber(L, index));
}

bool hasText(lua_State* L, int index) {
    const int type = lua_type(L, index);
    return type == LUA_TNUMBER || type == LUA_TSTRING || type == LUA_TBOOLEAN || type == LUA_TNIL;
}

std::string Call::described(int argument) const {
    if (isNotANumber(L, argument)) return "number nan";
    if (isNumber(argument)) return fmt::format("number {}", luaL_tolstring(L, argument, nullptr));
    if (lua_type(L, argument) == LUA_TSTRING) return "a string";
    if (lua_isnoneornil(L, argument)) return "nil";
    return std::string(typeNameAt(L, argument));
}

void Call::expected(int argument, std::string_view what) const {
    fail("{}expected {}, got {}", prefix(argument), what, described(argument));
}

std::string_view Call::text(int argument) const {
    if (lua_type(L, argument) != LUA_TSTRING) expected(argument, "a string");
    std::size_t size = 0;
    const char* bytes = lua_tolstring(L, argument, &size);
    return {bytes, size};
}

std::int32_t Call::integer(int argument) const {
    return integer(argument, std::numeric_limits<std::int32_t>::min(),
                   std::numeric_limits<std::int32_t>::max());
}

std::int32_t Call::integer(int argument, std::int32_t least, std::int32_t most) const {
    int isInteger = 0;
    const lua_Integer value = isNumber(argument) ? lua_tointegerx(L, argument, &isInteger) : 0;
    if (isInteger == 0) expected(argument, "a whole number");
    if (value < least || value > most) fail("{}{} is not in {}…{}", prefix(argument), value, least, most);
    return static_cast<std::int32_t>(value);
}

float Call::number(int argument) const {
    if (!isNumber(argument)) expected(argument, "a number");
    const double value = lua_tonumber(L, argument);
    if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max())))
        fail("{}{} is beyond what a Float holds", prefix(argument), described(argument));
    return static_cast<float>(value);
}

void Call::table(int argument) const {
    if (!lua_istable(L, argument)) expected(argument, "a table");
}

void Call::function_(int argument) const {
    if (!lua_isfunction(L, argument)) expected(argument, "a function");
}

lua_Integer Call::listLength(int argument) {
    table(argument);
    lua_Integer count = 0, last = 0;
    lua_pushnil(L);
    while (lua_next(L, argument) != 0) {
        lua_pop(L, 1);
        charge(kStepsOfKey);
        const lua_Integer key = lua_isinteger(L, -1) != 0 ? lua_tointeger(L, -1) : 0;
        if (key < 1) continue;
        ++count;
        last = std::max(last, key);
    }
    if (count != last)
        fail("{}the list has holes: {} items, the last one at {}", prefix(argument), count, last);
    return last;
}

std::string_view typeNameAt(lua_State* L, int index) {
    if (lua_type(L, index) == LUA_TUSERDATA && luaL_getmetafield(L, index, "__name") == LUA_TSTRING) {
        const char* name = lua_tostring(L, -1);  // the metatable keeps it
        lua_pop(L, 1);
        return name;
    }
    return luaL_typename(L, index);
}

}  // namespace terrane::lua
