// Basic functions of Lua in a form that shows no addresses and has one result on every machine.
#include <algorithm>
#include <vector>

#include "terrane/lua/call.h"

namespace terrane::lua {
namespace {

constexpr std::size_t kMaxPrintedBytes = 200;

// As text; of tables, functions and objects the type, since the rest is an address.
std::string asText(Call& c, int argument) {
    if (!hasText(c.L, argument)) return std::string(typeNameAt(c.L, argument));
    if (isNotANumber(c.L, argument)) return "nan";
    std::size_t size = 0;
    const char* bytes = luaL_tolstring(c.L, argument, &size);
    std::string result(bytes, size);
    lua_pop(c.L, 1);
    return result;
}

int typeOfValue(Call& c) {
    if (c.count() < 1) c.expected(1, "a value");
    const std::string_view name = typeNameAt(c.L, 1);
    lua_pushlstring(c.L, name.data(), name.size());
    return 1;
}

int toString(Call& c) {
    if (lua_type(c.L, 1) == LUA_TSTRING) {
        lua_settop(c.L, 1);
        return 1;
    }
    const std::string text = asText(c, 1);
    lua_pushlstring(c.L, text.data(), text.size());
    return 1;
}

int print(Call& c) {
    if (!c.sandbox.print || c.sandbox.printsLeft <= 0) return 0;
    --c.sandbox.printsLeft;
    std::string line;
    for (int k = 1; k <= c.count() && line.size() < kMaxPrintedBytes; ++k) {
        if (k > 1) line += ' ';
        line += lua_type(c.L, k) == LUA_TSTRING ? std::string(c.text(k).substr(0, kMaxPrintedBytes))
                                                : asText(c, k);
    }
    c.sandbox.print(std::string_view(line).substr(0, kMaxPrintedBytes));
    return 0;
}

int assertThat(Call& c) {
    if (c.count() < 1) c.expected(1, "a value");
    if (lua_toboolean(c.L, 1) != 0) return c.count();
    fail("{}", c.count() < 2 ? "assertion failed" : asText(c, 2));
}

// Keys in an order of their own: whole numbers, other numbers, texts, then false and true.
struct Key {
    int rank;
    lua_Integer whole = 0;
    lua_Number number = 0;
    std::string_view text;  // Lua keeps it: it is a key of the table

    bool operator<(const Key& other) const {
        if (rank != other.rank) return rank < other.rank;
        if (rank == 2) return text < other.text;
        return rank == 1 ? number < other.number : whole < other.whole;
    }
};

Key keyAtTop(Call& c) {
    Key key{0, 0, 0, {}};
    switch (lua_type(c.L, -1)) {
        case LUA_TNUMBER:
            key.rank = lua_isinteger(c.L, -1) != 0 ? 0 : 1;
            if (key.rank == 0) key.whole = lua_tointeger(c.L, -1);
            if (key.rank == 1) key.number = lua_tonumber(c.L, -1);
            return key;
        case LUA_TSTRING:
            key.rank = 2;
            key.text = c.text(lua_gettop(c.L));
            return key;
        case LUA_TBOOLEAN:
            key.rank = 3;
            key.whole = lua_toboolean(c.L, -1);
            return key;
        default:
            fail("pairs: keys that are {} have no order that is the same each time",
                 c.described(lua_gettop(c.L)));
    }
}

void pushKey(lua_State* L, const Key& key) {
    if (key.rank == 0) lua_pushinteger(L, key.whole);
    if (key.rank == 1) lua_pushnumber(L, key.number);
    if (key.rank == 2) lua_pushlstring(L, key.text.data(), key.text.size());
    if (key.rank == 3) lua_pushboolean(L, static_cast<int>(key.whole));
}

// Upvalues: the list of keys, how many of them were visited, the table. Pushes the next key whose value is
// still there. Scripts can call this function with any arguments, so it ignores them.
int nextPair(lua_State* L) {
    lua_Integer next = lua_tointeger(L, lua_upvalueindex(2));
    const auto count = static_cast<lua_Integer>(lua_rawlen(L, lua_upvalueindex(1)));
    bool isThere = false;
    while (next < count && !isThere) {
        lua_settop(L, 0);
        lua_rawgeti(L, lua_upvalueindex(1), ++next);
        lua_pushvalue(L, 1);
        isThere = lua_rawget(L, lua_upvalueindex(3)) != LUA_TNIL;
    }
    lua_pushinteger(L, next);
    lua_replace(L, lua_upvalueindex(2));
    if (isThere) return 2;
    lua_pushnil(L);
    return 1;
}

int pairs(Call& c) {
    c.table(1);
    lua_settop(c.L, 1);
    std::vector<Key> keys;
    lua_pushnil(c.L);
    while (lua_next(c.L, 1) != 0) {
        lua_pop(c.L, 1);
        c.charge(20);
        keys.push_back(keyAtTop(c));
    }
    std::sort(keys.begin(), keys.end());
    lua_createtable(c.L, static_cast<int>(keys.size()), 0);
    for (std::size_t k = 0; k < keys.size(); ++k) {
        pushKey(c.L, keys[k]);
        lua_rawseti(c.L, 2, static_cast<lua_Integer>(k + 1));
    }
    lua_pushinteger(c.L, 0);
    lua_pushvalue(c.L, 1);
    lua_pushcclosure(c.L, nextPair, 3);
    return 1;
}

constexpr Function kBaseFunctions[] = {{"type", typeOfValue},
                                       {"tostring", toString},
                                       {"print", print},
                                       {"assert", assertThat},
                                       {"pairs", pairs}};

}  // namespace

std::span<const Function> baseFunctions() {
    return kBaseFunctions;
}

}  // namespace terrane::lua
