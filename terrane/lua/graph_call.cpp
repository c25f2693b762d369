#include "terrane/lua/graph_call_internal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "terrane/base/text.h"

namespace terrane::lua {

namespace {

constexpr std::int64_t kStepsOfNode = 40;

// Takes the object of a method away.
void takeSelf(GraphCall& c, Tag self) {
    const Object* object = objectAt(c.L, 1);
    if (object == nullptr || object->tag != self) {
        fail("{0}: its object is missing: write a colon, as in {1}:{0}(…)", c.function,
             self == Tag::Pass ? "p" : "g");
    }
    if (self == Tag::Pass && !c.recording.isOpenPass(object->expression.pass))
        fail("{}: this pass is not the one that is being written", c.function);
    lua_remove(c.L, 1);
}

}  // namespace

void GraphCall::begin() {
    const auto self = static_cast<Tag>(lua_tointeger(L, lua_upvalueindex(2)));
    if (self != Tag::None) takeSelf(*this, self);
    Call::begin();
}

std::string_view GraphCall::name(int argument) {
    const std::string_view result = text(argument);
    if (result.empty() || result.size() > kMaxNameBytes)
        fail("{}names have 1 to {} bytes", prefix(argument), kMaxNameBytes);
    if (recording.seedNames.emplace(result).second && recording.seedNames.size() > kMaxSeedNames)
        fail("more than {} names of noises and random numbers", kMaxSeedNames);
    return result;
}

std::vector<float> GraphCall::weights(int argument) {
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

const Object& GraphCall::object(int argument, Tag tag) const {
    const Object* found = objectAt(L, argument);
    if (found != nullptr && found->tag == tag) return *found;
    expected(argument, nameOf(Object{tag, 0, {}}));
}

std::uint32_t GraphCall::field(int argument, Kind kind) const {
    const Object& found = object(argument, Tag::Field);
    if (found.expression.kind == kind) return found.number;
    fail("{}expected a field of {}, got one of {}", prefix(argument), nameOf(kind),
         nameOf(found.expression.kind));
}

const Expression* GraphCall::expression(int argument) const {
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

Parts GraphCall::parts(int argument, Kind kind) {
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

Kind GraphCall::commonKind(std::initializer_list<int> arguments) const {
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

int GraphCall::push(Kind kind, const Parts& parts) {
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

void GraphCall::finish() {
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

void readOptions(GraphCall& c, int argument, std::initializer_list<Option> options) {
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
