// Players, chat and commands: the type Player, the tables `players`, `chat` and `commands`.
#include <algorithm>
#include <new>
#include <string>
#include <utility>

#include "terrane/base/text.h"
#include "terrane/rules/rules_internal.h"

namespace terrane::rules {
namespace {

constexpr const char* kType = "Player";
constexpr std::string_view kRoles[] = {"guest", "player", "operator"};
static_assert(std::size(kRoles) == static_cast<std::size_t>(game::Role::Count));

void say(RuleCall& c, game::PlayerId to, std::string text) {
    if (++c.pack.linesSaid > kMaxSaidLines)
        lua::fail("{}: more than {} lines in a tick", c.function, kMaxSaidLines);
    c.charge(200);
    c.session.events.said.notify({to, std::move(text)});
}

int sayTo(RuleCall& c) {
    const game::PlayerId to = c.player(1);
    if (c.pack.host.players.contains(to)) say(c, to, c.line(2));
    return 0;
}

// In steps of 5 ns: all changed chunks are passed to the store with the items.
constexpr std::int64_t kStepsOfItems = 10'000;

int countAt(RuleCall& c, int argument) {
    return c.isMissing(argument) ? 1 : c.integer(argument, 0, kMaxItemCount);
}

// Returns the number of items that found room.
int give(RuleCall& c) {
    c.requireChange();
    c.charge(kStepsOfItems);
    const game::PlayerId to = c.player(1);
    const std::string item = c.item(2);
    const int count = countAt(c, 3);
    if (!c.pack.host.players.contains(to)) return c.push(std::int64_t{0});
    const int left = c.session.give(to, {item, static_cast<std::uint16_t>(count)});
    return c.push(std::int64_t{count - left});
}

// Returns the number of items that the player had.
int take(RuleCall& c) {
    c.requireChange();
    c.charge(kStepsOfItems);
    const game::PlayerId from = c.player(1);
    const std::string item = c.item(2);
    return c.push(std::int64_t{c.session.take(from, item, countAt(c, 3))});
}

int count(RuleCall& c) {
    c.charge(game::kPlayerSlots * 2);
    const std::string item = c.item(2);
    return c.push(std::int64_t{world::countItems(c.session.itemsOf(c.player(1)).slots, item)});
}

constexpr RuleFunction kMethods[] = {{"say", sayTo}, {"give", give}, {"take", take}, {"count", count}};
constexpr std::string_view kMembers[] = {"id",   "name",     "pos",  "yaw", "pitch",
                                         "role", "isOnline", "mode", "hand"};

int pushMember(RuleCall& c, game::PlayerId id, std::string_view key) {
    const auto& players = c.pack.host.players;
    const auto known = players.find(id);
    const world::Pose pose = c.session.poseOf(id).value_or(world::Pose{});
    if (key == "name")
        return c.push(std::string_view(known == players.end() ? std::string() : known->second));
    if (key == "pos") return c.push(pose.position);
    if (key == "role") return c.push(kRoles[static_cast<std::size_t>(c.session.permissions.roleOf(id))]);
    if (key == "mode") return c.push(game::kModeNames[static_cast<std::size_t>(c.session.modeOf(id))]);
    if (key == "hand") {
        const world::ItemStack& hand = c.session.itemsOf(id).hand();
        if (hand.count > 0) return c.push(std::string_view(hand.item));
        lua_pushnil(c.L);
    }
    if (key == "id") lua_pushinteger(c.L, id);
    if (key == "yaw") lua_pushnumber(c.L, static_cast<lua_Number>(pose.yaw));
    if (key == "pitch") lua_pushnumber(c.L, static_cast<lua_Number>(pose.pitch));
    if (key == "isOnline") lua_pushboolean(c.L, known != players.end());
    return 1;
}

int index(RuleCall& c) {
    const game::PlayerId id = c.player(1);
    const std::string_view key = lua_type(c.L, 2) == LUA_TSTRING ? c.text(2) : "";
    if (std::ranges::count(kMembers, key) > 0) return pushMember(c, id, key);
    const auto* const method = std::ranges::find(kMethods, key, &RuleFunction::name);
    if (method != std::end(kMethods)) {
        lua::pushFunction(c.L, *method);
        return 1;
    }
    std::vector<std::string> names(std::begin(kMembers), std::end(kMembers));
    for (const RuleFunction& one : kMethods) names.emplace_back(one.name);
    lua::fail("a player has no \"{}\"{}", key, base::didYouMean(key, names));
}

int refuseChange(RuleCall&) {
    lua::fail("a player's members cannot be changed");
}

int equal(RuleCall& c) {
    lua_pushboolean(c.L, c.player(1) == c.player(2));
    return 1;
}

constexpr RuleFunction kMetamethods[] = {{"__index", index}, {"__newindex", refuseChange}, {"__eq", equal}};

// The players in the game, in the order in which they first joined the world.
int all(RuleCall& c) {
    lua_createtable(c.L, static_cast<int>(c.pack.host.players.size()), 0);
    lua_Integer number = 0;
    for (const auto& [id, name] : c.pack.host.players) {
        c.charge(40);
        c.pushPlayer(id);
        lua_rawseti(c.L, -2, ++number);
    }
    return 1;
}

int find(RuleCall& c) {
    const std::string_view wanted = c.text(1);
    for (const auto& [id, name] : c.pack.host.players) {
        c.charge(10);
        if (name == wanted) return c.pushPlayer(id);
    }
    lua_pushnil(c.L);
    return 1;
}

constexpr RuleFunction kPlayers[] = {{"all", all}, {"find", find}};

int sayToAll(RuleCall& c) {
    say(c, game::kNoPlayer, c.line(1));
    return 0;
}

constexpr RuleFunction kChat[] = {{"say", sayToAll}};

// A member of the table of a command; empty if it is missing.
std::string textMember(RuleCall& c, const char* name) {
    if (lua_getfield(c.L, 1, name) == LUA_TNIL) {
        lua_pop(c.L, 1);
        return {};
    }
    const std::string text(c.text(lua_gettop(c.L)).substr(0, kMaxSaidBytes));
    lua_pop(c.L, 1);
    return text;
}

// Runs a command of a pack and returns its answer.
std::string runCommand(PackRules& pack, int function, game::PlayerId player, const std::string& arguments) {
    if (pack.isSuspended) return "the rules of " + pack.name + " are suspended";
    const auto answer = callFunction(pack, function, player, [&](lua_State* L) {
        pushPlayer(L, player);
        lua_pushlstring(L, arguments.data(), arguments.size());
        return 2;
    });
    saveStorage(pack.host);
    return answer.value_or("");
}

int addCommand(RuleCall& c) {
    c.table(1);
    game::ChatCommand command{
        textMember(c, "name"), textMember(c, "args"), textMember(c, "help"), {}, c.pack.name};
    if (!pack::isPackName(command.name))
        lua::fail("add: name: expected 1 to {} of a-z, 0-9 and _", pack::kMaxPackName);
    if (std::ranges::count(c.session.chatCommands, command.name, &game::ChatCommand::name) > 0)
        lua::fail("add: there is a command /{} already", command.name);
    if (++c.pack.commands > kMaxCommands) lua::fail("add: more than {} commands", kMaxCommands);
    if (lua_getfield(c.L, 1, "run") != LUA_TFUNCTION) lua::fail("add: run: expected a function");
    const int function = luaL_ref(c.L, LUA_REGISTRYINDEX);
    command.run = [&pack = c.pack, function](game::PlayerId player, const std::string& arguments) {
        return runCommand(pack, function, player, arguments);
    };
    c.session.chatCommands.push_back(std::move(command));
    return 0;
}

constexpr RuleFunction kCommands[] = {{"add", addCommand}};

void addTable(lua_State* L, const char* name, std::span<const RuleFunction> functions) {
    lua_createtable(L, 0, static_cast<int>(functions.size()));
    lua::addFunctions<RuleCall>(L, functions);
    lua_setfield(L, -2, name);
}

}  // namespace

void pushPlayer(lua_State* L, game::PlayerId player) {
    new (lua_newuserdatauv(L, sizeof(game::PlayerId), 0)) game::PlayerId(player);
    luaL_setmetatable(L, kType);
}

std::vector<std::string> playerMembers() {
    std::vector<std::string> names;
    for (const std::string_view member : kMembers) names.push_back("." + std::string(member));
    for (const RuleFunction& method : kMethods) names.push_back(std::string(":") + method.name);
    return names;
}

void addPlayerFunctions(lua_State* L) {
    luaL_newmetatable(L, kType);
    lua::addFunctions<RuleCall>(L, kMetamethods);
    lua_pop(L, 1);
    addTable(L, "players", kPlayers);
    addTable(L, "chat", kChat);
    addTable(L, "commands", kCommands);
}

}  // namespace terrane::rules
