// Functions of strings that replace Lua's own: those take unbounded time, or show addresses or the sign of
// NaN.
#include <algorithm>
#include <limits>

#include "terrane/lua/call.h"

namespace terrane::lua {
namespace {

constexpr std::int64_t kMaxBytesAtOnce = 200;  // results of byte()

int repeat(Call& c) {
    const std::string_view text = c.text(1), between = c.isMissing(3) ? std::string_view() : c.text(3);
    const std::int32_t times = c.integer(2);
    const std::size_t bytesEach = text.size() + between.size();
    if (times > 0 && bytesEach > kMaxTextBytes / static_cast<std::size_t>(times))
        fail("rep: the text would be longer than {} bytes", kMaxTextBytes);
    c.charge(std::max(times, 0) * (bytesEach > 0 ? 2 : 0));
    std::string result;
    if (bytesEach > 0) {
        result.reserve(bytesEach * static_cast<std::size_t>(std::max(times, 0)));
        for (int k = 0; k < times; ++k) {
            if (k > 0) result += between;
            result += text;
        }
    }
    c.charge(static_cast<std::int64_t>(result.size() / 16));
    lua_pushlstring(c.L, result.data(), result.size());
    return 1;
}

// The bytes from one position to another as numbers. Negative positions count from the end, as in Lua's own.
int bytesOf(Call& c) {
    const auto size = static_cast<std::int64_t>(c.text(1).size());
    const std::int64_t from = c.isMissing(2) ? 1 : c.integer(2), to = c.isMissing(3) ? from : c.integer(3);
    const std::int64_t first = std::max<std::int64_t>(1, from < 0 ? size + 1 + from : from);
    const std::int64_t last = std::min(size, to < 0 ? size + 1 + to : to);
    const std::int64_t count = std::max<std::int64_t>(0, last - first + 1);
    if (count > kMaxBytesAtOnce) fail("byte: {} bytes, at most {} at once", count, kMaxBytesAtOnce);
    luaL_checkstack(c.L, static_cast<int>(count), "too many values");
    for (std::int64_t k = 0; k < count; ++k)
        lua_pushinteger(c.L, static_cast<std::uint8_t>(c.text(1)[static_cast<std::size_t>(first - 1 + k)]));
    return static_cast<int>(count);
}

// Finds one text within another, without patterns.
int find(Call& c) {
    const std::string_view text = c.text(1), wanted = c.text(2);
    const std::int32_t from = c.isMissing(3) ? 1 : c.integer(3, 1, static_cast<std::int32_t>(kMaxTextBytes));
    // The search may compare the whole of it at each place.
    c.charge(static_cast<std::int64_t>(text.size() * std::max<std::size_t>(1, wanted.size() / 16)));
    const std::size_t at = text.find(wanted, static_cast<std::size_t>(from - 1));
    if (at == std::string_view::npos) {
        lua_pushnil(c.L);
        return 1;
    }
    lua_pushinteger(c.L, static_cast<lua_Integer>(at + 1));
    lua_pushinteger(c.L, static_cast<lua_Integer>(at + wanted.size()));
    return 2;
}

// Calls Lua's own, which the registry keeps. Refuses first where that would print an address: for %p, and for
// %s of a table or a function.
int format(Call& c) {
    const std::string_view pattern = c.text(1);
    if (pattern.size() > 1000) fail("format: the pattern is longer than 1000 bytes");
    for (std::size_t k = pattern.find('%'); k != std::string_view::npos; k = pattern.find('%', k)) {
        k = std::min(pattern.find_first_not_of("-+ #0123456789.", k + 1), pattern.size());
        if (k < pattern.size() && pattern[k] == 'p') fail("format: %p is not supported");
        k = std::min(k + 1, pattern.size());
    }
    for (int k = 2; k <= c.count(); ++k) {
        if (!hasText(c.L, k)) fail("format: argument {}: {} has no text", k, c.described(k));
        if (!isNotANumber(c.L, k)) continue;
        lua_pushnumber(c.L, std::numeric_limits<lua_Number>::quiet_NaN());  // whose sign is plus
        lua_replace(c.L, k);
    }
    const int arguments = c.count();
    lua_getfield(c.L, LUA_REGISTRYINDEX, "string.format");
    lua_insert(c.L, 1);
    if (lua_pcall(c.L, arguments, 1, 0) == LUA_OK) return 1;
    std::string reason = lua_type(c.L, -1) == LUA_TSTRING ? lua_tostring(c.L, -1) : "no memory";
    // Lua names functions by where they are called, and this one is called from here.
    if (const std::size_t at = reason.find("'?'"); at != std::string::npos) reason.replace(at, 3, "'format'");
    fail("{}", reason);
}

constexpr Function kStringFunctions[] = {
    {"byte", bytesOf}, {"rep", repeat}, {"find", find}, {"format", format}};

}  // namespace

std::span<const Function> stringFunctions() {
    return kStringFunctions;
}

}  // namespace terrane::lua
