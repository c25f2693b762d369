// Arguments and results of the functions of rules.
#include <algorithm>
#include <cmath>

#include "terrane/base/text.h"
#include "terrane/rules/rules_internal.h"
#include "terrane/world/items/item_table.h"

namespace terrane::rules {
namespace {

// A member of a table as a finite number.
double member(RuleCall& c, int argument, const char* name) {
    c.table(argument);
    lua_getfield(c.L, argument, name);
    const double value = c.isNumber(-1) ? lua_tonumber(c.L, -1) : std::nan("");
    lua_pop(c.L, 1);
    if (!std::isfinite(value))
        lua::fail("{}: argument {}: expected a position {{x = …, y = …, z = …}}", c.function, argument);
    return value;
}

std::int32_t blockOfNumber(double value) {
    return static_cast<std::int32_t>(std::clamp(std::floor(value), -2147483648.0, 2147483647.0));
}

}  // namespace

glm::dvec3 RuleCall::point(int argument) {
    return {member(*this, argument, "x"), member(*this, argument, "y"), member(*this, argument, "z")};
}

world::BlockPos RuleCall::pos(int argument) {
    const glm::dvec3 at = point(argument);
    return {blockOfNumber(at.x), blockOfNumber(at.y), blockOfNumber(at.z)};
}

world::BlockId RuleCall::block(int argument) {
    const std::string name = pack.blockNames.find(text(argument));
    return name == "air" ? world::kAir : session.blocks().find(name)->id;
}

// An item of the pack needs no prefix.
std::string RuleCall::item(int argument) {
    const std::string_view name = text(argument);
    const world::ItemTable& table = session.blocks().items();
    const std::string own = pack.name + ":" + std::string(name);
    if (table.find(own)) return own;
    if (table.find(name)) return std::string(name);
    std::vector<std::string> names;
    for (const world::ItemType& type : table.types()) names.push_back(type.name);
    lua::fail("{}: there is no item \"{}\"{}", function, name, base::didYouMean(name, names));
}

std::uint16_t RuleCall::state(int argument) {
    return isMissing(argument) ? std::uint16_t{0} : static_cast<std::uint16_t>(integer(argument, 0, 65535));
}

double RuleCall::real(int argument, double least, double most) const {
    if (!isNumber(argument)) expected(argument, "a number");
    const double value = lua_tonumber(L, argument);
    if (!(value >= least && value <= most))
        lua::fail("{}{} is not in {}…{}", prefix(argument), described(argument), least, most);
    return value;
}

game::PlayerId RuleCall::player(int argument) const {
    if (lua::typeNameAt(L, argument) != "Player") expected(argument, "a player");
    return *static_cast<const game::PlayerId*>(lua_touserdata(L, argument));
}

std::string RuleCall::line(int argument) const {
    const bool isNumeric = isNumber(argument) && !lua::isNotANumber(L, argument);
    std::string said(isNumeric ? std::string_view(lua_tostring(L, argument)) : text(argument));
    if (said.size() > kMaxSaidBytes) said.resize(kMaxSaidBytes);
    return said;
}

void RuleCall::requireChange() const {
    if (pack.isDeciding)
        lua::fail("{}: not in events.before, which only decides: change the world in events.on", function);
}

int RuleCall::keep(int argument) {
    function_(argument);
    lua_pushvalue(L, argument);
    return luaL_ref(L, LUA_REGISTRYINDEX);
}

int RuleCall::push(std::string_view text) {
    lua_pushlstring(L, text.data(), text.size());
    return 1;
}

int RuleCall::push(std::int64_t number) {
    lua_pushinteger(L, number);
    return 1;
}

int RuleCall::push(world::BlockPos pos) {
    pushPos(L, pos);
    return 1;
}

int RuleCall::push(const glm::dvec3& point) {
    lua_createtable(L, 0, 3);
    setField(L, "x", point.x);
    setField(L, "y", point.y);
    setField(L, "z", point.z);
    return 1;
}

int RuleCall::pushBlock(world::BlockId block) {
    return push(std::string_view(session.blocks().type(block).name));
}

int RuleCall::pushPlayer(game::PlayerId player) {
    rules::pushPlayer(L, player);
    return 1;
}

void setField(lua_State* L, const char* name, std::string_view text) {
    lua_pushlstring(L, text.data(), text.size());
    lua_setfield(L, -2, name);
}

void setField(lua_State* L, const char* name, double number) {
    lua_pushnumber(L, number);
    lua_setfield(L, -2, name);
}

void setField(lua_State* L, const char* name, std::int64_t number) {
    lua_pushinteger(L, number);
    lua_setfield(L, -2, name);
}

void pushPos(lua_State* L, world::BlockPos pos) {
    lua_createtable(L, 0, 3);
    setField(L, "x", std::int64_t{pos.x});
    setField(L, "y", std::int64_t{pos.y});
    setField(L, "z", std::int64_t{pos.z});
}

}  // namespace terrane::rules
