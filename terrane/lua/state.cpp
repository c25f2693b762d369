#include "terrane/lua/state_internal.h"

#include <algorithm>
#include <cstring>

#include "terrane/base/text.h"
#include "terrane/lua/call_internal.h"

namespace terrane::lua {
namespace {

constexpr int kStepsBetweenHooks = 200;
// Stands for the script's file, of which Lua would show 60 bytes at most.
constexpr char kFileMark = '\x01';
constexpr std::size_t kMaxReasonBytes = 300;

// Functions of Lua's own libraries with bounded time, no addresses and one result on every machine.
constexpr const char* kBase[] = {"error", "ipairs", "tonumber"};
constexpr const char* kString[] = {"char", "sub", "len", "upper", "lower", "reverse"};
constexpr const char* kMath[] = {"abs", "ceil",       "floor", "fmod", "huge",      "max",  "maxinteger",
                                 "min", "mininteger", "pi",    "sqrt", "tointeger", "type", "ult"};

void hook(lua_State* L, lua_Debug*) {
    if (!recordingOf(L).budget.chargeAndReadClock(kStepsBetweenHooks)) luaL_error(L, "runs too long");
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
    addFunctions(L, stringFunctions(), Tag::None);
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
    lua_createtable(L, 0, 64);
    takeFrom(L, luaopen_base, kBase);
    addFunctions(L, baseFunctions(), Tag::None);
    addFunctions(L, expressionFunctions(), Tag::None);
    addStrings(L);
    lua_createtable(L, 0, 16);
    takeFrom(L, luaopen_math, kMath);
    lua_setfield(L, -2, "math");
    lua_createtable(L, 0, 8);
    addFunctions(L, tableFunctions(), Tag::None);
    lua_setfield(L, -2, "table");
    makeObjectTypes(L);
    pushObject(L, {Tag::Generator, 0, {}});
    lua_setfield(L, -2, "g");
    lua_rawseti(L, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
    return 0;
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
    if (std::strchr(lua_tostring(L, 1), kFileMark) != nullptr) return 1;
    luaL_checkstack(L, 4, nullptr);
    lua_Debug frame;
    for (int level = 0; lua_getstack(L, level, &frame) != 0; ++level) {
        lua_getinfo(L, "l", &frame);
        if (frame.currentline <= 0) continue;
        lua_pushfstring(L, "%c:%d: %s", kFileMark, frame.currentline, lua_tostring(L, 1));
        return 1;
    }
    return 1;
}

std::string limitReached(lua_State* L, int status) {
    const Recording& recording = recordingOf(L);
    const bool isSpent = recording.budget.spent() != Budget::Spent::Nothing;
    if (!isSpent && status != LUA_ERRMEM) return "";
    const int line = recording.budget.line();
    const std::string where = fmt::format("{}{}: ", kFileMark, line > 0 ? fmt::format(":{}", line) : "");
    if (recording.budget.spent() == Budget::Spent::Steps)
        return fmt::format("{}runs too long: more than {} steps", where, Limits{}.steps);
    if (recording.budget.spent() == Budget::Spent::Time)
        return fmt::format("{}runs too long: more than {} ms", where, Limits{}.time.count());
    return fmt::format("{}needs more memory: {} MiB are allowed, {} MiB for a list, {} KiB for a text", where,
                       Limits{}.memoryBytes >> 20, Limits{}.blockBytes >> 20, Limits{}.textBytes >> 10);
}

// The error on top of the stack as one line with the file's name.
std::string reasonOf(lua_State* L, int status, const std::string& file) {
    std::string reason = limitReached(L, status);
    if (reason.empty() && lua_type(L, -1) == LUA_TSTRING) {
        std::size_t size = 0;
        const char* bytes = lua_tolstring(L, -1, &size);
        reason.assign(bytes, std::min(size, kMaxReasonBytes));
    }
    if (reason.find(kFileMark) == std::string::npos) reason = fmt::format("{}: {}", kFileMark, reason);
    std::string line;
    for (const char byte : reason) {
        if (byte == kFileMark) {
            line += file;
        } else {
            line += byte == '\n' ? ' ' : byte;
        }
    }
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

StatePtr makeState(Recording& recording) {
    StatePtr state(lua_newstate(Budget::allocate, &recording.budget));
    if (!state) return state;
    lua_State* L = state.get();
    *static_cast<Recording**>(lua_getextraspace(L)) = &recording;
    lua_pushcfunction(L, fillState);
    if (lua_pcall(L, 0, 0, 0) != LUA_OK) return nullptr;
    recording.budget.watch(L);
    lua_sethook(L, hook, LUA_MASKCOUNT, kStepsBetweenHooks);
    return state;
}

std::string runScript(lua_State* L, const Script& script) {
    const char name[] = {'=', kFileMark, '\0'};
    lua_pushcfunction(L, nameLine);
    int status = luaL_loadbufferx(L, script.text.data(), script.text.size(), name, "t");
    if (status == LUA_OK) status = lua_pcall(L, 0, 0, -2);
    return status == LUA_OK ? "" : reasonOf(L, status, script.file);
}

std::vector<std::string> scriptFunctions() {
    std::vector<std::string> names = {"Pass.x",        "Pass.y",         "Pass.z",
                                      "Pass.step",     "Generator.step", "Generator.bottom",
                                      "Generator.top", "Variable.value"};
    const auto add = [&](const char* prefix, std::span<const Function> functions) {
        for (const Function& function : functions) names.push_back(std::string(prefix) + function.name);
    };
    add("Pass:", passMethods());
    add("Pass:", noiseMethods());
    add("Generator:", generatorMethods());
    add("Expression:", comparisons());
    const StatePtr state(luaL_newstate());
    lua_State* L = state.get();
    fillState(L);
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
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace terrane::lua
