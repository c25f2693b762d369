// Values that a pack keeps with the world: the table `storage`. Each key is a setting of the world's store,
// rules.PACK.KEY, and rules.PACK holds the bytes of all.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "terrane/base/match.h"
#include "terrane/rules/rules_internal.h"
#include "terrane/rules/stored_value.h"

namespace terrane::rules {
namespace {

constexpr std::int64_t kStepsOfValue = 20;

std::string settingOf(const PackRules& pack, std::string_view key) {
    return fmt::format("rules.{}.{}", pack.name, escapedKey(key));
}

// The text of a setting; empty if there is none.
std::string textOf(RuleCall& c, const std::string& name) {
    const auto unsaved = c.pack.unsaved.find(name);
    if (unsaved != c.pack.unsaved.end()) return unsaved->second;
    return c.session.store().metadata(name).value_or("");
}

std::size_t bytesStored(RuleCall& c) {
    const std::string text = textOf(c, "rules." + c.pack.name);
    std::size_t bytes = 0;
    std::from_chars(text.data(), text.data() + text.size(), bytes);
    return bytes;
}

std::string_view keyAt(RuleCall& c) {
    const std::string_view key = c.text(1);
    if (key.empty() || key.size() > kMaxKeyBytes)
        lua::fail("{}: a key has 1 to {} bytes, got {}", c.function, kMaxKeyBytes, key.size());
    return key;
}

// A value that is no table; nothing for others.
std::optional<StoredValue> scalarAt(RuleCall& c, int index) {
    switch (lua_type(c.L, index)) {
        case LUA_TBOOLEAN:
            return StoredValue{lua_toboolean(c.L, index) != 0};
        case LUA_TSTRING:
            return StoredValue{std::string(c.text(index))};
        case LUA_TNUMBER:
            if (lua_isinteger(c.L, index)) return StoredValue{std::int64_t{lua_tointeger(c.L, index)}};
            if (std::isfinite(lua_tonumber(c.L, index))) return StoredValue{lua_tonumber(c.L, index)};
            break;
        default:
            break;
    }
    lua::fail("set: {} cannot be stored", c.described(index));
}

// Whole numbers, other numbers, texts, then false and true.
bool isBefore(const StoredValue& a, const StoredValue& b) {
    constexpr int kRanks[] = {3, 0, 1, 2, 4};  // by the index of the variant
    if (a.value.index() != b.value.index()) return kRanks[a.value.index()] < kRanks[b.value.index()];
    return std::visit(base::Match{
                          [](const StoredValue::Table&) { return false; },
                          [&]<class Value>(const Value& value) { return value < std::get<Value>(b.value); },
                      },
                      a.value);
}

void pushScalar(RuleCall& c, const StoredValue& value) {
    std::visit(base::Match{
                   [&](bool is) { lua_pushboolean(c.L, is ? 1 : 0); },
                   [&](std::int64_t number) { lua_pushinteger(c.L, number); },
                   [&](double number) { lua_pushnumber(c.L, number); },
                   [&](const std::string& text) { c.push(std::string_view(text)); },
                   [&](const StoredValue::Table&) { lua_pushnil(c.L); },
               },
               value.value);
}

// Appends the text of the value at an absolute index.
void encode(RuleCall& c, std::string& text, int index, int depth) {
    c.charge(kStepsOfValue);
    if (!lua_istable(c.L, index)) {
        encodeStored(text, *scalarAt(c, index));
    } else {
        if (depth >= kMaxStoredDepth) lua::fail("set: tables in tables, {} deep at most", kMaxStoredDepth);
        luaL_checkstack(c.L, 4, "tables are nested too deeply");
        std::vector<StoredValue> keys;
        for (lua_pushnil(c.L); lua_next(c.L, index) != 0; lua_pop(c.L, 1)) {
            c.charge(kStepsOfValue);
            if (lua_istable(c.L, -2)) lua::fail("set: a table cannot be a key of what is stored");
            keys.push_back(*scalarAt(c, lua_gettop(c.L) - 1));
        }
        std::ranges::sort(keys, isBefore);
        text += '{';
        for (const StoredValue& key : keys) {
            encodeStored(text, key);
            pushScalar(c, key);
            lua_rawget(c.L, index);
            encode(c, text, lua_gettop(c.L), depth + 1);
            lua_pop(c.L, 1);
        }
        text += '}';
    }
    if (text.size() > kMaxStoredBytes)
        lua::fail("set: the value takes more than {} KiB", kMaxStoredBytes >> 10);
}

void decode(RuleCall& c, const StoredValue& value) {
    c.charge(kStepsOfValue);
    const auto* table = std::get_if<StoredValue::Table>(&value.value);
    if (!table) return pushScalar(c, value);
    luaL_checkstack(c.L, 4, "tables are nested too deeply");
    lua_createtable(c.L, 0, 0);
    for (const auto& [key, held] : *table) {
        pushScalar(c, key);
        decode(c, held);
        lua_rawset(c.L, -3);
    }
}

int get(RuleCall& c) {
    const std::string_view key = keyAt(c);
    const std::string text = textOf(c, settingOf(c.pack, key));
    c.charge(static_cast<std::int64_t>(text.size()));
    if (text.empty()) {
        lua_pushnil(c.L);
        return 1;
    }
    const auto value = decodeStored(text);
    if (!value) lua::fail("get: the stored value of \"{}\" is damaged", key);
    decode(c, *value);
    return 1;
}

int set(RuleCall& c) {
    c.requireChange();
    const std::string name = settingOf(c.pack, keyAt(c));
    std::string text;
    if (!lua_isnoneornil(c.L, 2)) encode(c, text, 2, 0);
    c.charge(200 + static_cast<std::int64_t>(text.size()));
    const std::string before = textOf(c, name);
    // The name of a removed key still takes its bytes, since its setting stays.
    const bool isNew = before.empty() && !c.session.store().metadata(name) && !c.pack.unsaved.contains(name);
    const std::size_t bytes = bytesStored(c) + (isNew ? name.size() : 0) + text.size() - before.size();
    if (text.size() > before.size() && bytes > kMaxStorage)
        lua::fail("set: the storage of a pack takes at most {} KiB", kMaxStorage >> 10);
    c.pack.unsaved["rules." + c.pack.name] = std::to_string(bytes);
    c.pack.unsaved[name] = std::move(text);
    return 0;
}

constexpr RuleFunction kStorage[] = {{"get", get}, {"set", set}};

}  // namespace

void saveStorage(RulesHost& host) {
    if (std::ranges::any_of(host.packs, [](const auto& pack) { return !pack->unsaved.empty(); }))
        host.session.queueSaves();
}

void addStorageFunctions(lua_State* L) {
    lua_createtable(L, 0, 2);
    lua::addFunctions<RuleCall>(L, kStorage);
    lua_setfield(L, -2, "storage");
}

}  // namespace terrane::rules
