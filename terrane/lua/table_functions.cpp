// Functions of lists. Lua's own sort depends on the clock, and none of its own counts the steps it takes.
#include <algorithm>
#include <vector>

#include "terrane/lua/call.h"

namespace terrane::lua {
namespace {

constexpr lua_Integer kMaxUnpacked = 200;

int insert(Call& c) {
    const lua_Integer length = c.listLength(1);
    if (c.count() != 2 && c.count() != 3) fail("insert: expected (list, value) or (list, position, value)");
    const lua_Integer at = c.count() == 2 ? length + 1 : c.integer(2);
    if (at < 1 || at > length + 1) fail("insert: position {} is not in 1…{}", at, length + 1);
    for (lua_Integer k = length; k >= at; --k) {
        lua_rawgeti(c.L, 1, k);
        lua_rawseti(c.L, 1, k + 1);
    }
    lua_pushvalue(c.L, c.count());
    lua_rawseti(c.L, 1, at);
    return 0;
}

int remove(Call& c) {
    const lua_Integer length = c.listLength(1);
    const lua_Integer at = c.isMissing(2) ? length : c.integer(2);
    if (length == 0 && (at == 0 || at == 1)) {
        lua_pushnil(c.L);
        return 1;
    }
    if (at < 1 || at > length) fail("remove: position {} is not in 1…{}", at, length);
    lua_rawgeti(c.L, 1, at);
    for (lua_Integer k = at; k < length; ++k) {
        lua_rawgeti(c.L, 1, k + 1);
        lua_rawseti(c.L, 1, k);
    }
    lua_pushnil(c.L);
    lua_rawseti(c.L, 1, length);
    return 1;
}

int concat(Call& c) {
    const lua_Integer length = c.listLength(1);
    const std::string between(c.isMissing(2) ? std::string_view() : c.text(2));
    std::string result;
    for (lua_Integer k = 1; k <= length; ++k) {
        const int type = lua_rawgeti(c.L, 1, k);
        if (type != LUA_TSTRING && type != LUA_TNUMBER)
            fail("concat: item {} is {}", k, c.described(lua_gettop(c.L)));
        std::size_t size = 0;
        if (k > 1) result += between;
        if (isNotANumber(c.L, -1)) {
            result += "nan";
        } else {
            const char* bytes = lua_tolstring(c.L, -1, &size);
            result.append(bytes, size);
        }
        lua_pop(c.L, 1);
        if (result.size() > kMaxTextBytes) fail("concat: the text is longer than {} bytes", kMaxTextBytes);
    }
    c.charge(static_cast<std::int64_t>(result.size() / 16));
    lua_pushlstring(c.L, result.data(), result.size());
    return 1;
}

int unpack(Call& c) {
    const lua_Integer length = c.listLength(1);
    if (length > kMaxUnpacked) fail("unpack: more than {} items", kMaxUnpacked);
    luaL_checkstack(c.L, static_cast<int>(length), "too many values");
    for (lua_Integer k = 1; k <= length; ++k) lua_rawgeti(c.L, 1, k);
    return static_cast<int>(length);
}

// Whether item a stands before item b of the list, by the script's function or as numbers and texts compare.
bool isBefore(Call& c, lua_Integer a, lua_Integer b) {
    c.charge(20);
    const bool hasFunction = c.count() >= 2 && !lua_isnil(c.L, 2);
    if (hasFunction) lua_pushvalue(c.L, 2);
    const int first = lua_rawgeti(c.L, 1, a), second = lua_rawgeti(c.L, 1, b);
    bool result = false;
    if (hasFunction) {
        lua_call(c.L, 2, 1);
        if (!lua_isboolean(c.L, -1))
            fail("sort: its function must return true or false, got {}", c.described(lua_gettop(c.L)));
        result = lua_toboolean(c.L, -1) != 0;
        lua_pop(c.L, 1);
        return result;
    }
    const int top = lua_gettop(c.L);
    if (first == LUA_TNUMBER && second == LUA_TNUMBER) {
        result = lua_compare(c.L, -2, -1, LUA_OPLT) != 0;
    } else if (first == LUA_TSTRING && second == LUA_TSTRING) {
        result = c.text(top - 1) < c.text(top);
    } else {
        fail("sort: {} and {} have no order", c.described(top - 1), c.described(top));
    }
    lua_pop(c.L, 2);
    return result;
}

// Merges, so that equal items keep their order and a function that contradicts itself does no harm.
void mergeSort(Call& c, std::vector<lua_Integer>& order) {
    std::vector<lua_Integer> merged(order.size());
    for (std::size_t width = 1; width < order.size(); width *= 2) {
        for (std::size_t start = 0; start < order.size(); start += 2 * width) {
            const std::size_t middle = std::min(start + width, order.size());
            const std::size_t end = std::min(start + 2 * width, order.size());
            std::size_t left = start, right = middle;
            for (std::size_t k = start; k < end; ++k) {
                const bool takesRight =
                    left == middle || (right < end && isBefore(c, order[right], order[left]));
                merged[k] = takesRight ? order[right++] : order[left++];
            }
        }
        order.swap(merged);
    }
}

int sort(Call& c) {
    const lua_Integer length = c.listLength(1);
    if (c.count() >= 2 && !lua_isnil(c.L, 2)) c.function_(2);
    std::vector<lua_Integer> order(static_cast<std::size_t>(length));
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<lua_Integer>(k + 1);
    mergeSort(c, order);
    lua_createtable(c.L, static_cast<int>(length), 0);
    const int sorted = lua_gettop(c.L);
    for (lua_Integer k = 1; k <= length; ++k) {
        lua_rawgeti(c.L, 1, order[static_cast<std::size_t>(k - 1)]);
        lua_rawseti(c.L, sorted, k);
    }
    for (lua_Integer k = 1; k <= length; ++k) {
        lua_rawgeti(c.L, sorted, k);
        lua_rawseti(c.L, 1, k);
    }
    return 0;
}

constexpr Function kTableFunctions[] = {
    {"insert", insert}, {"remove", remove}, {"concat", concat}, {"unpack", unpack}, {"sort", sort}};

}  // namespace

std::span<const Function> tableFunctions() {
    return kTableFunctions;
}

}  // namespace terrane::lua
