#include "terrane/lua/call_internal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "terrane/base/text.h"

namespace terrane::lua {

namespace {

constexpr std::int64_t kStepsOfCall = 40;  // 200 ns
constexpr std::int64_t kStepsOfNode = 40;
constexpr std::int64_t kStepsOfKey = 4;  // 20 ns a key of a table

// Takes the object of a method away.
void takeSelf(Call& c, Tag self) {
    const Object* object = objectAt(c.L, 1);
    if (object == nullptr || object->tag != self) {
        fail("{0}: its object is missing: write a colon, as in {1}:{0}(…)", c.function,
             self == Tag::Pass ? "p" : "g");
    }
    if (self == Tag::Pass && !c.recording.isOpenPass(object->expression.pass))
        fail("{}: this pass is not the one that is being written", c.function);
    lua_remove(c.L, 1);
}

int enter(lua_State* L) {
    std::string reason;
    try {
        Call c(L);
        const auto& function = *static_cast<const Function*>(lua_touserdata(L, lua_upvalueindex(1)));
        const auto self = static_cast<Tag>(lua_tointeger(L, lua_upvalueindex(2)));
        c.function = function.name;
        c.charge(kStepsOfCall);
        if (self != Tag::None) takeSelf(c, self);
        c.setCount(lua_gettop(L));
        const int results = function.call(c);
        c.checkMistakes();
        return results;
    } catch (const std::bad_alloc&) {
        reason = "no memory";
    } catch (const std::exception& e) {
        reason = e.what();
    }
    return luaL_error(L, "%s", reason.c_str());
}

}  // namespace

void pushFunction(lua_State* L, const Function& function, Tag self) {
    // Lua's interface has no const. NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
    lua_pushlightuserdata(L, const_cast<Function*>(&function));
    lua_pushinteger(L, static_cast<lua_Integer>(self));
    lua_pushcclosure(L, enter, 2);
}

void addFunctions(lua_State* L, std::span<const Function> functions, Tag self) {
    for (const Function& function : functions) {
        pushFunction(L, function, self);
        lua_setfield(L, -2, function.name);
    }
}

Call::Call(lua_State* state) : L(state), recording(recordingOf(state)) {}

void Call::charge(std::int64_t steps) {
    if (!recording.budget.charge(steps)) fail("runs too long");
}

std::string Call::prefix(int argument) const {
    if (function.starts_with("__")) return "";
    if (argument > arguments_ && argument <= lua_gettop(L))
        return fmt::format("{}: ", function);  // in a table
    return fmt::format("{}: argument {}: ", function, argument);
}

bool isNotANumber(lua_State* L, int index) {
    return lua_type(L, index) == LUA_TNUMBER && std::isnan(lua_tonumber(L, index));
}

bool hasText(lua_State* L, int index) {
    const int type = lua_type(L, index);
    return type == LUA_TNUMBER || type == LUA_TSTRING || type == LUA_TBOOLEAN || type == LUA_TNIL;
}

std::string Call::described(int argument) const {
    if (isNotANumber(L, argument)) return "number nan";
    if (isNumber(argument)) return fmt::format("number {}", luaL_tolstring(L, argument, nullptr));
    if (lua_type(L, argument) == LUA_TSTRING) return "a string";
    if (lua_isnoneornil(L, argument)) return "nil";
    return std::string(typeNameAt(L, argument));
}

void Call::expected(int argument, std::string_view what) const {
    fail("{}expected {}, got {}", prefix(argument), what, described(argument));
}

std::string_view Call::text(int argument) const {
    if (lua_type(L, argument) != LUA_TSTRING) expected(argument, "a string");
    std::size_t size = 0;
    const char* bytes = lua_tolstring(L, argument, &size);
    return {bytes, size};
}

std::string_view Call::name(int argument) {
    const std::string_view result = text(argument);
    if (result.empty() || result.size() > kMaxNameBytes)
        fail("{}names have 1 to {} bytes", prefix(argument), kMaxNameBytes);
    if (recording.seedNames.emplace(result).second && recording.seedNames.size() > kMaxSeedNames)
        fail("more than {} names of noises and random numbers", kMaxSeedNames);
    return result;
}

std::int32_t Call::integer(int argument) const {
    return integer(argument, std::numeric_limits<std::int32_t>::min(),
                   std::numeric_limits<std::int32_t>::max());
}

std::int32_t Call::integer(int argument, std::int32_t least, std::int32_t most) const {
    int isInteger = 0;
    const lua_Integer value = isNumber(argument) ? lua_tointegerx(L, argument, &isInteger) : 0;
    if (isInteger == 0) expected(argument, "a whole number");
    if (value < least || value > most) fail("{}{} is not in {}…{}", prefix(argument), value, least, most);
    return static_cast<std::int32_t>(value);
}

float Call::number(int argument) const {
    if (!isNumber(argument)) expected(argument, "a number");
    const double value = lua_tonumber(L, argument);
    if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max())))
        fail("{}{} is beyond what a Float holds", prefix(argument), described(argument));
    return static_cast<float>(value);
}

void Call::table(int argument) const {
    if (!lua_istable(L, argument)) expected(argument, "a table");
}

void Call::function_(int argument) const {
    if (!lua_isfunction(L, argument)) expected(argument, "a function");
}

lua_Integer Call::listLength(int argument) {
    table(argument);
    lua_Integer count = 0, last = 0;
    lua_pushnil(L);
    while (lua_next(L, argument) != 0) {
        lua_pop(L, 1);
        charge(kStepsOfKey);
        const lua_Integer key = lua_isinteger(L, -1) != 0 ? lua_tointeger(L, -1) : 0;
        if (key < 1) continue;
        ++count;
        last = std::max(last, key);
    }
    if (count != last)
        fail("{}the list has holes: {} items, the last one at {}", prefix(argument), count, last);
    return last;
}

std::vector<float> Call::weights(int argument) {
    const lua_Integer octaves = listLength(argument);
    if (octaves < 1 || octaves > 12) fail("{}takes 1 to 12 octave weights", prefix(argument));
    std::vector<float> result;
    for (lua_Integer k = 1; k <= octaves; ++k) {
        lua_rawgeti(L, argument, k);
        result.push_back(number(lua_gettop(L)));
        lua_pop(L, 1);
    }
    return result;
}

const Object& Call::object(int argument, Tag tag) const {
    const Object* found = objectAt(L, argument);
    if (found != nullptr && found->tag == tag) return *found;
    expected(argument, nameOf(Object{tag, 0, {}}));
}

std::uint32_t Call::field(int argument, Kind kind) const {
    const Object& found = object(argument, Tag::Field);
    if (found.expression.kind == kind) return found.number;
    fail("{}expected a field of {}, got one of {}", prefix(argument), nameOf(kind),
         nameOf(found.expression.kind));
}

const Expression* Call::expression(int argument) const {
    const Object* found = objectAt(L, argument);
    if (found == nullptr) return nullptr;
    if (found->tag == Tag::Variable) fail("{}this is a variable: its value is v.value", prefix(argument));
    if (found->tag == Tag::Field) fail("{}this is a field: p:read(field) gives its value", prefix(argument));
    if (found->tag != Tag::Expression) return nullptr;
    const bool isForeign = found->expression.pass != 0 && !recording.isOpenPass(found->expression.pass);
    if (isForeign)
        fail("{}this {} belongs to another pass: pass it on in a field", prefix(argument), nameOf(*found));
    return &found->expression;
}

namespace {

bool isWhole(lua_State* L, int argument) {
    return lua_isinteger(L, argument) != 0;
}

// The kind of a literal; Count if it has none.
Kind literalKind(lua_State* L, int argument) {
    switch (lua_type(L, argument)) {
        case LUA_TNUMBER:
            return isWhole(L, argument) ? Kind::Int : Kind::Float;
        case LUA_TBOOLEAN:
            return Kind::Bool;
        case LUA_TSTRING:
            return Kind::Block;
        default:
            return Kind::Count;
    }
}

std::string_view adviceFor(Kind from, Kind to) {
    if (from == Kind::Int && to == Kind::Float) return ": write float(…)";
    if (from == Kind::Float && to == Kind::Int) return ": write int(…), after floor(…) for negative numbers";
    return "";
}

}  // namespace

Parts Call::parts(int argument, Kind kind) {
    if (const Expression* found = expression(argument)) {
        if (found->kind == kind) return found->parts;
        fail("{}expected {}, got {}{}", prefix(argument), nameOf(kind), nameOf(found->kind),
             adviceFor(found->kind, kind));
    }
    const Kind literal = literalKind(L, argument);
    if (kind == Kind::Float && isNumber(argument)) {
        const double value = lua_tonumber(L, argument);
        return {std::isinf(value) ? gen::Float(static_cast<float>(value)) : gen::Float(number(argument))};
    }
    if (literal != kind) expected(argument, nameOf(kind));
    if (kind == Kind::Int) return {gen::Int(integer(argument))};
    if (kind == Kind::Bool) return {gen::Bool(lua_toboolean(L, argument) != 0)};
    if (recording.pass == nullptr) fail("{}blocks can only be used in a pass", prefix(argument));
    return {pass().block(recording.blocks.find(text(argument)))};
}

Kind Call::commonKind(std::initializer_list<int> arguments) const {
    Kind common = Kind::Count, number = Kind::Int;
    bool hasNumber = false;
    for (const int argument : arguments) {
        const Expression* found = expression(argument);
        const Kind kind = found ? found->kind : literalKind(L, argument);
        if (kind == Kind::Count) expected(argument, "an expression");
        if (found == nullptr && isNumber(argument)) {
            hasNumber = true;
            if (kind == Kind::Float) number = Kind::Float;
            continue;
        }
        if (common == Kind::Count) common = kind;
        if (common == kind) continue;
        const std::string_view advice =
            kind == Kind::Int && common == Kind::Float ? adviceFor(kind, common) : adviceFor(common, kind);
        fail("{}{} and {} do not match{}", prefix(argument), nameOf(common), nameOf(kind), advice);
    }
    if (common == Kind::Count) return hasNumber ? number : Kind::Int;
    return common;
}

int Call::push(Kind kind, const Parts& parts) {
    bool isLiteral = true;
    for (std::size_t k = 0; k < partCount(kind); ++k) isLiteral = isLiteral && parts[k].graph == nullptr;
    const gen::Bits bits = parts[0].bits;
    if (isLiteral && kind == Kind::Bool) {
        lua_pushboolean(L, gen::asBool(bits) ? 1 : 0);
    } else if (isLiteral && kind == Kind::Int) {
        lua_pushinteger(L, gen::asInt(bits));
    } else if (isLiteral && kind == Kind::Float) {
        lua_pushnumber(L, static_cast<double>(gen::asFloat(bits)));
    } else {
        pushObject(L, {Tag::Expression, 0, {kind, isLiteral ? 0 : recording.passNumber, parts}});
    }
    return 1;
}

void Call::checkMistakes() {
    const std::vector<std::string>& mistakes =
        recording.pass != nullptr ? recording.pass->mistakes() : recording.builder.mistakes();
    if (!mistakes.empty()) fail("{}", mistakes.back());
    const std::size_t nodes = recording.pass != nullptr ? recording.pass->nodeCount() : 0;
    // Nodes that one call added take time too: a call of simplex noise adds hundreds.
    if (nodes > recording.chargedNodes)
        charge(static_cast<std::int64_t>(nodes - recording.chargedNodes) * kStepsOfNode);
    recording.chargedNodes = nodes;
    if (nodes > kMaxNodesInPass)
        fail(
            "a pass has more than {} operations: split it into several, or leave out what large steps do not "
            "show",
            kMaxNodesInPass);
}

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

// Blocks by the names that scripts use.

std::string BlockNames::find(std::string_view name) {
    if (name == "air") return std::string(name);
    const std::string ofPack = pack_.empty() ? std::string() : fmt::format("{}:{}", pack_, name);
    for (std::string candidate : {ofPack, std::string(name)}) {
        if (const auto alias = aliases_.find(candidate); alias != aliases_.end()) candidate = alias->second;
        if (candidate.empty() || blocks_.find(candidate) == nullptr) continue;
        addUsed(candidate);
        return candidate;
    }
    std::vector<std::string> known;
    const std::string prefix = pack_ + ":";
    for (const world::BlockType& type : blocks_.types())
        known.push_back(type.name.starts_with(prefix) ? type.name.substr(prefix.size()) : type.name);
    fail("unknown block \"{}\"{}", name, base::didYouMean(name, known));
}

void BlockNames::addUsed(std::string_view name) {
    if (std::find(used_.begin(), used_.end(), name) == used_.end()) used_.emplace_back(name);
}

}  // namespace terrane::lua
