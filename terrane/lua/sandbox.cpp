#include "terrane/lua/sandbox.h"
#include "terrane/lua/lua_headers.h"

#include <algorithm>
#include <limits>

#include "terrane/base/text.h"
#include "terrane/lua/call.h"

namespace terrane::lua {
namespace {

constexpr int kStepsBetweenHooks = 200;
// Stands for a script's file, of which Lua would show 60 bytes at most. The file's letter follows.
constexpr char kFileMark = '\x01';
constexpr char kFirstLetter = '0';
constexpr std::size_t kMaxReasonBytes = 300;

// Functions of Lua's own libraries with bounded time, no addresses and one result on every machine.
constexpr const char* kBase[] = {"error", "ipairs", "tonumber"};
constexpr const char* kString[] = {"char", "sub", "len", "upper", "lower", "reverse"};
constexpr const char* kMath[] = {"abs", "ceil",       "floor", "fmod", "huge",      "max",  "maxinteger",
                                 "min", "mininteger", "pi",    "sqrt", "tointeger", "type", "ult"};

void hook(lua_State* L, lua_Debug*) {
    if (!sandboxOf(L).budget.chargeAndReadClock(kStepsBetweenHooks)) luaL_error(L, "runs too long");
}

// Opens one of Lua's libraries and gives the table on top of the stack some of its members.
void takeFrom(lua_State* L, lua_CFunction open, std::span<const char* const> names) {
    lua_pushcfunction(L, open);
    lua_call(L, 0, 1);
    for (const char* name : names) {
        lua_getfield(L, -1, name);
        lua_setfield(L, -3, name);
    }
    lua_pop(L, 1);
}

// A table of strings' functions, which are their methods too: ("x"):rep(3).
void addStrings(lua_State* L) {
    lua_createtable(L, 0, 10);
    takeFrom(L, luaopen_string, kString);
    addFunctions(L, stringFunctions());
    lua_pushcfunction(L, luaopen_string);
    lua_call(L, 0, 1);
    lua_getfield(L, -1, "format");
    lua_setfield(L, LUA_REGISTRYINDEX, "string.format");
    lua_pop(L, 1);
    lua_pushliteral(L, "");
    lua_createtable(L, 0, 1);
    lua_pushvalue(L, -3);
    lua_setfield(L, -2, "__index");
    lua_setmetatable(L, -2);
    lua_pop(L, 1);
    lua_setfield(L, -2, "string");
}

// Fills a new table of globals, so that it has nothing of Lua but the names listed here.
int fillState(lua_State* L) {
    const auto addGlobals = reinterpret_cast<void (*)(lua_State*)>(lua_touserdata(L, 1));
    lua_settop(L, 0);
    lua_createtable(L, 0, 64);
    takeFrom(L, luaopen_base, kBase);
    addFunctions(L, baseFunctions());
    addStrings(L);
    lua_createtable(L, 0, 16);
    takeFrom(L, luaopen_math, kMath);
    lua_setfield(L, -2, "math");
    lua_createtable(L, 0, 8);
    addFunctions(L, tableFunctions());
    lua_setfield(L, -2, "table");
    addGlobals(L);
    lua_rawseti(L, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
    return 0;
}

// Whether a text begins with the mark of one of the files.
bool startsWithPlace(std::string_view text, std::size_t files) {
    return text.size() > 1 && text[0] == kFileMark && text[1] >= kFirstLetter &&
           static_cast<std::size_t>(text[1] - kFirstLetter) < files;
}

// Adds the innermost line of the script to an error that has none. Called where the error occurs.
int nameLine(lua_State* L) {
    if (isNotANumber(L, 1)) {
        lua_settop(L, 0);
        lua_pushliteral(L, "nan");
    } else if (lua_type(L, 1) == LUA_TNUMBER) {
        lua_tostring(L, 1);  // changes it in place
    } else if (lua_type(L, 1) != LUA_TSTRING) {
        lua_settop(L, 0);
        lua_pushliteral(L, "error: its message is not a text");
    }
    if (startsWithPlace(lua_tostring(L, 1), sandboxOf(L).files.size())) return 1;
    luaL_checkstack(L, 4, nullptr);
    const ScriptPlace place = placeOf(L, std::numeric_limits<int>::max());
    if (place.line > 0)
        lua_pushfstring(L, "%c%c:%d: %s", kFileMark, place.file, place.line, lua_tostring(L, 1));
    return 1;
}

char letterOf(std::size_t file) {
    return static_cast<char>(kFirstLetter + file);
}

std::string limitReached(const Budget& budget, int status) {
    const Limits& limits = budget.limits();
    if (budget.spent() == Budget::Spent::Nothing && status != LUA_ERRMEM) return "";
    const ScriptPlace place = budget.place();
    const std::string where =
        place.line > 0 ? fmt::format("{}{}:{}: ", kFileMark, place.file, place.line) : std::string();
    if (budget.spent() == Budget::Spent::Steps)
        return fmt::format("{}runs too long: more than {} steps", where, limits.steps);
    if (budget.spent() == Budget::Spent::Time)
        return fmt::format("{}runs too long: more than {} ms", where, limits.time.count());
    return fmt::format("{}needs more memory: {} MiB are allowed, {} MiB for a list, {} KiB for a text", where,
                       limits.memoryBytes >> 20, limits.blockBytes >> 20, limits.textBytes >> 10);
}

// The error on top of the stack as one line with the file's name.
std::string reasonOf(lua_State* L, int status) {
    const Sandbox& sandbox = sandboxOf(L);
    std::string reason = limitReached(sandbox.budget, status);
    if (reason.empty() && lua_type(L, -1) == LUA_TSTRING) {
        std::size_t size = 0;
        const char* bytes = lua_tolstring(L, -1, &size);
        reason.assign(bytes, std::min(size, kMaxReasonBytes));
    }
    if (!startsWithPlace(reason, sandbox.files.size()))
        reason = fmt::format("{}{}: {}", kFileMark, letterOf(sandbox.files.size() - 1), reason);
    std::string line = sandbox.files[static_cast<std::size_t>(reason[1] - kFirstLetter)];
    for (const char byte : std::string_view(reason).substr(2)) line += byte == '\n' ? ' ' : byte;
    return base::printable(line);
}

std::vector<std::string> keysOf(lua_State* L) {
    std::vector<std::string> keys;
    lua_pushnil(L);
    while (lua_next(L, -2) != 0) {
        lua_pop(L, 1);
        keys.emplace_back(lua_tostring(L, -1));
    }
    return keys;
}

}  // namespace

Sandbox& sandboxOf(lua_State* L) {
    return **static_cast<Sandbox**>(lua_getextraspace(L));
}

void CloseState::operator()(lua_State* state) const {
    lua_close(state);
}

StatePtr openState(Sandbox& sandbox, void (*addGlobals)(lua_State*)) {
    StatePtr state(lua_newstate(Budget::allocate, &sandbox.budget));
    if (!state) return state;
    lua_State* L = state.get();
    *static_cast<Sandbox**>(lua_getextraspace(L)) = &sandbox;
    lua_pushcfunction(L, fillState);
    lua_pushlightuserdata(L, reinterpret_cast<void*>(addGlobals));
    if (lua_pcall(L, 1, 0, 0) != LUA_OK) return nullptr;
    sandbox.budget.watch(L);
    lua_sethook(L, hook, LUA_MASKCOUNT, kStepsBetweenHooks);
    return state;
}

std::string runScript(lua_State* L, const Script& script) {
    std::vector<std::string>& files = sandboxOf(L).files;
    if (script.text.size() > kMaxScriptBytes)
        return fmt::format("{}: more than {} bytes", script.file, kMaxScriptBytes);
    if (files.size() == kMaxScripts) return fmt::format("{}: more than {} scripts", script.file, kMaxScripts);
    const char name[] = {'=', kFileMark, letterOf(files.size()), '\0'};
    files.push_back(script.file);
    const int status = luaL_loadbufferx(L, script.text.data(), script.text.size(), name, "t");
    if (status == LUA_OK) return callScript(L, 0);
    std::string reason = reasonOf(L, status);
    lua_pop(L, 1);
    return reason;
}

std::string callScript(lua_State* L, int arguments, int results) {
    const int function = lua_gettop(L) - arguments;
    lua_pushcfunction(L, nameLine);
    lua_insert(L, function);
    const int status = lua_pcall(L, arguments, results, function);
    std::string reason = status == LUA_OK ? std::string() : reasonOf(L, status);
    if (status != LUA_OK) lua_settop(L, function);
    lua_remove(L, function);
    return reason;
}

std::vector<std::string> globalsOf(lua_State* L) {
    std::vector<std::string> names;
    lua_rawgeti(L, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
    for (const std::string& key : keysOf(L)) {
        const bool isTable = lua_getfield(L, -1, key.c_str()) == LUA_TTABLE;
        if (isTable) {
            for (const std::string& member : keysOf(L)) names.push_back(key + "." + member);
        } else {
            names.push_back(key);
        }
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
    return names;
}

}  // namespace terrane::lua
