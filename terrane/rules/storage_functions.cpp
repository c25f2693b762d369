// Values that a pack keeps with the world: the table `storage`. All of them are one setting of the world's
// store, rules.PACK, with a line KEY=VALUE for each.
#include <algorithm>
#include <cmath>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/match.h"
#include "terrane/rules/rules_internal.h"
#include "terrane/rules/stored_value.h"

namespace terrane::rules {
namespace {

constexpr std::int64_t kStepsOfValue = 20;

std::string settingOf(const PackRules& pack) {
    return "rules." + pack.name;
}

std::size_t lineBytes(std::string_view key, std::string_view value) {
    return key.size() + value.size() + 2;
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
    const auto found = c.pack.storage.find(escapedKey(key));
    if (found == c.pack.storage.end()) {
        lua_pushnil(c.L);
        return 1;
    }
    c.charge(static_cast<std::int64_t>(found->second.size()));
    const auto value = decodeStored(found->second);
    if (!value) lua::fail("get: the stored value of \"{}\" is damaged", key);
    decode(c, *value);
    return 1;
}

int set(RuleCall& c) {
    c.requireChange();
    const std::string key = escapedKey(keyAt(c));
    std::string text;
    if (!lua_isnoneornil(c.L, 2)) encode(c, text, 2, 0);
    PackRules& pack = c.pack;
    // All values of the pack are saved as one text.
    c.charge(200 + static_cast<std::int64_t>(text.size() + pack.storageBytes / 64));
    const auto found = pack.storage.find(key);
    const std::size_t freed = found == pack.storage.end() ? 0 : lineBytes(key, found->second);
    const std::size_t bytes = pack.storageBytes - freed + (text.empty() ? 0 : lineBytes(key, text));
    if (bytes > pack.storageBytes && bytes > kMaxStorage)
        lua::fail("set: the storage of a pack takes at most {} KiB", kMaxStorage >> 10);
    pack.storageBytes = bytes;
    pack.isStorageChanged = true;
    if (text.empty())
        pack.storage.erase(key);
    else
        pack.storage.insert_or_assign(key, std::move(text));
    return 0;
}

constexpr RuleFunction kStorage[] = {{"get", get}, {"set", set}};

}  // namespace

void loadStorage(PackRules& pack) {
    const std::string text = pack.host.session.store().metadata(settingOf(pack)).value_or("");
    if (text.size() > kMaxStorage)
        return base::logError("the storage of the rules of {} is damaged", pack.name);
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = std::string_view(text).substr(at, end - at);
        const std::size_t sign = std::min(line.find('='), line.size());
        pack.storage.emplace(line.substr(0, sign), line.substr(std::min(sign + 1, line.size())));
        at = end + 1;
    }
    for (const auto& [key, value] : pack.storage) pack.storageBytes += lineBytes(key, value);
}

void saveStorage(RulesHost& host) {
    if (std::ranges::any_of(host.packs, [](const auto& pack) { return pack->isStorageChanged; }))
        host.session.queueSaves();
}

void queueStorage(PackRules& pack) {
    if (!std::exchange(pack.isStorageChanged, false)) return;
    std::string text;
    text.reserve(pack.storageBytes);
    for (const auto& [key, value] : pack.storage) {
        text += key;
        text += '=';
        text += value;
        text += '\n';
    }
    pack.host.session.store().setMetadata(settingOf(pack), std::move(text));
}

void addStorageFunctions(lua_State* L) {
    lua_createtable(L, 0, 2);
    lua::addFunctions<RuleCall>(L, kStorage);
    lua_setfield(L, -2, "storage");
}

}  // namespace terrane::rules
