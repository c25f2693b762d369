#include <algorithm>
#include <new>
#include <string>

#include "terrane/base/text.h"
#include "terrane/lua/graph_call_internal.h"

namespace terrane::lua {
namespace {

constexpr std::string_view kKindNames[] = {"Bool", "Int", "Float", "Block", "Vec2", "Vec3", "IVec2", "IVec3"};
static_assert(std::size(kKindNames) == static_cast<std::size_t>(Kind::Count));

// Completes the metatable on top of the stack. Lua calls `index` with the object and the key.
void makeType(lua_State* L, const GraphFunction& index, const GraphFunction& newIndex) {
    pushFunction(L, index);
    lua_setfield(L, -2, "__index");
    pushFunction(L, newIndex);
    lua_setfield(L, -2, "__newindex");
}

// Pushes the function of the type's table of methods, or fails.
int pushMethod(GraphCall& c, const char* table, std::string_view type) {
    luaL_getsubtable(c.L, LUA_REGISTRYINDEX, table);
    lua_pushvalue(c.L, 2);
    lua_rawget(c.L, -2);
    if (!lua_isnil(c.L, -1)) return 1;
    if (lua_type(c.L, 2) != LUA_TSTRING) fail("{} has only named members", type);
    std::vector<std::string> names;
    lua_pushnil(c.L);
    while (lua_next(c.L, -3) != 0) {
        lua_pop(c.L, 1);
        names.emplace_back(lua_tostring(c.L, -1));
    }
    std::sort(names.begin(), names.end());
    fail("{} has no \"{}\"{}", type, c.text(2), base::didYouMean(c.text(2), names));
}

int indexExpression(GraphCall& c) {
    const Expression* e = c.expression(1);
    if (e == nullptr) c.expected(1, "an expression");
    const std::string_view key = lua_type(c.L, 2) == LUA_TSTRING ? c.text(2) : "";
    const std::size_t component =
        key.size() == 1 ? std::string_view("xyz").find(key) : std::string_view::npos;
    const std::size_t count = partCount(e->kind);
    if (count > 1 && component < count) {
        const Kind kind = typeOf(e->kind) == gen::Type::Float ? Kind::Float : Kind::Int;
        return c.push(kind, {e->parts[component]});
    }
    return pushMethod(c, "comparisons", nameOf(e->kind));
}

int indexPass(GraphCall& c) {
    const Object& object = c.object(1, Tag::Pass);
    const std::string_view key = lua_type(c.L, 2) == LUA_TSTRING ? c.text(2) : "";
    if (key == "step" || key == "x" || key == "y" || key == "z") {
        if (!c.recording.isOpenPass(object.expression.pass))
            fail("p.{}: this pass is not the one that is being written", key);
        if (key == "x") return c.push(c.pass().x());
        if (key == "y") return c.push(c.pass().y());
        if (key == "z") return c.push(c.pass().z());
        c.recording.readsStep = true;
        lua_pushinteger(c.L, c.pass().step());
        return 1;
    }
    return pushMethod(c, "pass methods", "a pass");
}

int indexGenerator(GraphCall& c) {
    const std::string_view key = lua_type(c.L, 2) == LUA_TSTRING ? c.text(2) : "";
    if (key == "step") {
        c.recording.readsStep = true;
        lua_pushinteger(c.L, c.recording.builder.step());
        return 1;
    }
    if (key == "bottom" || key == "top") {
        const world::Heights heights = c.recording.builder.heights();
        c.recording.readsHeights = true;
        lua_pushinteger(c.L, key == "top" ? heights.top : heights.bottom);
        return 1;
    }
    return pushMethod(c, "generator methods", "the generator");
}

Variable& variableAt(GraphCall& c) {
    const Object& object = c.object(1, Tag::Variable);
    if (!c.recording.isOpenPass(object.expression.pass)) fail("this variable belongs to another pass");
    if (lua_type(c.L, 2) != LUA_TSTRING || c.text(2) != "value")
        fail("a variable has only its value: v.value");
    return c.recording.variables[object.number];
}

int indexVariable(GraphCall& c) {
    const Variable& variable = variableAt(c);
    return c.push(variable.kind, {variable.read()});
}

int setVariable(GraphCall& c) {
    Variable& variable = variableAt(c);
    variable.write(c.parts(3, variable.kind)[0]);
    return 0;
}

int indexNothing(GraphCall& c) {
    fail("{} has no members", c.described(1));
}

int refuseChange(GraphCall& c) {
    fail("{} cannot be changed", c.described(1));
}

constexpr GraphFunction kIndexExpression = {"__index", indexExpression};
constexpr GraphFunction kIndexPass = {"__index", indexPass};
constexpr GraphFunction kIndexGenerator = {"__index", indexGenerator};
constexpr GraphFunction kIndexVariable = {"__index", indexVariable};
constexpr GraphFunction kSetVariable = {"__newindex", setVariable};
constexpr GraphFunction kIndexNothing = {"__index", indexNothing};
constexpr GraphFunction kRefuseChange = {"__newindex", refuseChange};

// Comparisons are methods of numbers too, and logic works on booleans: constants may stand for expressions.
void makeLiteralTypes(lua_State* L) {
    lua_createtable(L, 0, 1);
    luaL_getsubtable(L, LUA_REGISTRYINDEX, "comparisons");
    lua_setfield(L, -2, "__index");
    lua_pushinteger(L, 0);
    lua_pushvalue(L, -2);
    lua_setmetatable(L, -2);
    lua_pop(L, 2);
    lua_createtable(L, 0, 3);
    for (const GraphFunction& function : operators()) {
        const std::string_view name = function.name;
        if (name != "__band" && name != "__bor" && name != "__bnot") continue;
        pushFunction(L, function);
        lua_setfield(L, -2, function.name);
    }
    lua_pushboolean(L, 1);
    lua_pushvalue(L, -2);
    lua_setmetatable(L, -2);
    lua_pop(L, 2);
}

}  // namespace

std::string_view nameOf(Kind kind) {
    return kind < Kind::Count ? kKindNames[static_cast<std::size_t>(kind)] : "nothing";
}

std::string_view nameOf(const Object& object) {
    switch (object.tag) {
        case Tag::Expression:
            return nameOf(object.expression.kind);
        case Tag::Variable:
            return "Variable";
        case Tag::Field:
            return "Field";
        case Tag::Drainage:
            return "Drainage";
        case Tag::Pass:
            return "Pass";
        default:
            return "Generator";
    }
}

const Object* objectAt(lua_State* L, int index) {
    return lua_type(L, index) == LUA_TUSERDATA ? static_cast<const Object*>(lua_touserdata(L, index))
                                               : nullptr;
}

void pushObject(lua_State* L, const Object& object) {
    void* memory = lua_newuserdatauv(L, sizeof(Object), 0);
    new (memory) Object(object);
    luaL_setmetatable(L, std::string(nameOf(object)).c_str());
}

void makeObjectTypes(lua_State* L) {
    luaL_getsubtable(L, LUA_REGISTRYINDEX, "comparisons");
    addFunctions(L, comparisons());
    luaL_getsubtable(L, LUA_REGISTRYINDEX, "pass methods");
    addMethods(L, passMethods(), Tag::Pass);
    addMethods(L, noiseMethods(), Tag::Pass);
    luaL_getsubtable(L, LUA_REGISTRYINDEX, "generator methods");
    addMethods(L, generatorMethods(), Tag::Generator);
    lua_pop(L, 3);
    for (const std::string_view name : kKindNames) {
        luaL_newmetatable(L, std::string(name).c_str());
        makeType(L, kIndexExpression, kRefuseChange);
        addFunctions(L, operators());
        lua_pop(L, 1);
    }
    struct Type {
        const char* name;
        const GraphFunction &index, &newIndex;
    };
    const Type types[] = {{"Variable", kIndexVariable, kSetVariable},
                          {"Field", kIndexNothing, kRefuseChange},
                          {"Drainage", kIndexNothing, kRefuseChange},
                          {"Pass", kIndexPass, kRefuseChange},
                          {"Generator", kIndexGenerator, kRefuseChange}};
    for (const Type& type : types) {
        luaL_newmetatable(L, type.name);
        makeType(L, type.index, type.newIndex);
        // Operators on these objects fail with advice.
        if (&type.index == &kIndexVariable || &type.index == &kIndexNothing) addFunctions(L, operators());
        lua_pop(L, 1);
    }
    makeLiteralTypes(L);
}

}  // namespace terrane::lua
