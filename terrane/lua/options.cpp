#include <algorithm>

#include "terrane/base/nearest_name.h"
#include "terrane/lua/options_internal.h"

namespace terrane::lua {

void readOptions(Call& c, int argument, std::initializer_list<Option> options) {
    c.table(argument);
    int known = 0, given = 0;
    std::vector<std::string> names;
    for (const Option& option : options) {
        names.emplace_back(option.name);
        if (lua_getfield(c.L, argument, option.name) != LUA_TNIL) {
            ++known;
            const int value = lua_gettop(c.L);
            if (!c.isNumber(value))
                fail("{}: {}: expected a number, got {}", c.function, option.name, c.described(value));
            if (auto* whole = std::get_if<int*>(&option.value)) **whole = c.integer(value);
            if (auto* number = std::get_if<float*>(&option.value)) **number = c.number(value);
        }
        lua_pop(c.L, 1);
    }
    std::string unknown;
    lua_pushnil(c.L);
    while (lua_next(c.L, argument) != 0) {
        lua_pop(c.L, 1);
        ++given;
        c.charge(10);
        const bool isName = lua_type(c.L, -1) == LUA_TSTRING;
        const std::string key = isName ? lua_tostring(c.L, -1) : "a list's item";
        const bool isKnown = std::find(names.begin(), names.end(), key) != names.end();
        // The least of the unknown: the order of keys differs from run to run.
        if (!isKnown && (unknown.empty() || key < unknown)) unknown = key;
    }
    if (given > known)
        fail("{}: there is no option {}{}", c.function, unknown, base::didYouMean(unknown, names));
}

}  // namespace terrane::lua
