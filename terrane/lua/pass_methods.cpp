// Methods of passes: fields and blocks, variables, branches and loops.
#include <memory>

#include "terrane/lua/graph_call_internal.h"

namespace terrane::lua {
namespace {

using gen::Bool;
using gen::Float;
using gen::Int;

// Calls `use` with the field as a gen::Field of its type.
template <class Use>
int withField(GraphCall& c, int argument, Use use) {
    const Object& field = c.object(argument, Tag::Field);
    switch (field.expression.kind) {
        case Kind::Bool:
            return use(gen::Field<Bool>{field.number});
        case Kind::Int:
            return use(gen::Field<Int>{field.number});
        case Kind::Float:
            return use(gen::Field<Float>{field.number});
        default:
            return use(gen::Field<gen::Block>{field.number});
    }
}

template <class T>
T valueFor(GraphCall& c, gen::Field<T>, int argument) {
    return c.get<T>(argument);
}

int read(GraphCall& c) {
    return withField(c, 1, [&](auto field) { return c.push(c.pass().read(field)); });
}

// An offset as a vector, or as two numbers.
gen::IVec2 offset(GraphCall& c, int argument) {
    if (const Expression* e = c.expression(argument); e != nullptr && e->kind == Kind::IVec2)
        return c.get<gen::IVec2>(argument);
    return {c.get<Int>(argument), c.get<Int>(argument + 1)};
}

int readAt(GraphCall& c) {
    const gen::IVec2 at = offset(c, 2);
    return withField(c, 1, [&](auto field) { return c.push(c.pass().readAt(field, at)); });
}

int slope(GraphCall& c) {
    return c.push(c.pass().slope(gen::Field<Float>{c.field(1, Kind::Float)}));
}

int lowestBeside(GraphCall& c) {
    return c.push(c.pass().lowestBeside(gen::Field<Float>{c.field(1, Kind::Float)}));
}

int readBetween(GraphCall& c) {
    const gen::Field<Float> field{c.field(1, Kind::Float)};
    return c.push(c.pass().readBetween(field, c.get<gen::Vec2>(2)));
}

int set(GraphCall& c) {
    return withField(c, 1, [&](auto field) {
        c.pass().set(field, valueFor(c, field, 2));
        return 0;
    });
}

int setAt(GraphCall& c) {
    const Int z = c.get<Int>(2);
    return withField(c, 1, [&](auto field) {
        c.pass().setAt(field, z, valueFor(c, field, 3));
        return 0;
    });
}

int block(GraphCall& c) {
    return c.push(c.get<gen::Block>(1));
}

int blockHere(GraphCall& c) {
    return c.push(c.pass().blockHere());
}

int blockInColumn(GraphCall& c) {
    return c.push(c.pass().blockInColumn(c.get<Int>(1)));
}

int blockAt(GraphCall& c) {
    const gen::IVec2 at = offset(c, 1);
    const Expression* first = c.expression(1);
    const bool isVector = first != nullptr && first->kind == Kind::IVec2;
    return c.push(c.pass().blockAt(at, c.get<Int>(isVector ? 2 : 3)));
}

int setBlock(GraphCall& c) {
    c.pass().setBlock(c.get<gen::Block>(1));
    return 0;
}

int stamp(GraphCall& c) {
    return c.push(
        c.pass().stamp(gen::Field<Int>{c.field(1, Kind::Int)}, gen::Field<Int>{c.field(2, Kind::Int)}));
}

template <class T>
Variable makeVariable(GraphCall& c, const T& initial) {
    const std::shared_ptr<gen::Var<T>> variable(new gen::Var<T>(c.pass().var(initial)));
    return {kKindOf<T>, [variable] { return static_cast<T>(*variable); },
            [variable](gen::Value value) { *variable = T(value); }};
}

int var(GraphCall& c) {
    auto& variables = c.recording.variables;
    if (variables.size() == kMaxVariablesInPass)
        fail("var: more than {} variables in a pass", kMaxVariablesInPass);
    const Kind kind = c.commonKind({1});
    if (kind == Kind::Bool) {
        variables.push_back(makeVariable(c, c.get<Bool>(1)));
    } else if (kind == Kind::Int) {
        variables.push_back(makeVariable(c, c.get<Int>(1)));
    } else if (kind == Kind::Float) {
        variables.push_back(makeVariable(c, c.get<Float>(1)));
    } else if (kind == Kind::Block) {
        variables.push_back(makeVariable(c, c.get<gen::Block>(1)));
    } else {
        fail("var: a variable cannot hold a {}: make one for each component", nameOf(kind));
    }
    Object object{Tag::Variable, static_cast<std::uint32_t>(variables.size() - 1), {}};
    object.expression.pass = c.recording.passNumber;
    pushObject(c.L, object);
    return 1;
}

// Calls a function that the script passed as an argument.
void callBack(GraphCall& c, int argument, int results) {
    luaL_checkstack(c.L, 10, "calls are nested too deeply");
    lua_pushvalue(c.L, argument);
    lua_call(c.L, 0, results);
}

// Joining goes through all variables and fields.
void chargeBranch(GraphCall& c) {
    c.charge(static_cast<std::int64_t>(10 * (c.recording.variables.size() + c.recording.fields.size())));
}

int if_(GraphCall& c) {
    const Bool condition = c.get<Bool>(1);
    c.function_(2);
    std::function<void()> otherwise;
    if (!c.isMissing(3)) {
        c.function_(3);
        otherwise = [&] { callBack(c, 3, 0); };
    }
    chargeBranch(c);
    c.pass().if_(
        condition, [&] { callBack(c, 2, 0); }, otherwise);
    return 0;
}

int while_(GraphCall& c) {
    c.function_(1);
    c.function_(2);
    chargeBranch(c);
    const auto condition = [&] {
        callBack(c, 1, 1);
        const int result = lua_gettop(c.L);
        const bool isBool = lua_isboolean(c.L, result) ||
                            (c.expression(result) != nullptr && c.expression(result)->kind == Kind::Bool);
        if (!isBool) fail("while_: its first function must return a Bool, got {}", c.described(result));
        return c.get<Bool>(result);
    };
    c.pass().while_(condition, [&] { callBack(c, 2, 0); });
    return 0;
}

constexpr GraphFunction kPassMethods[] = {{"read", read},
                                          {"readAt", readAt},
                                          {"slope", slope},
                                          {"lowestBeside", lowestBeside},
                                          {"readBetween", readBetween},
                                          {"set", set},
                                          {"setAt", setAt},
                                          {"block", block},
                                          {"blockHere", blockHere},
                                          {"blockInColumn", blockInColumn},
                                          {"blockAt", blockAt},
                                          {"setBlock", setBlock},
                                          {"stamp", stamp},
                                          {"var", var},
                                          {"if_", if_},
                                          {"while_", while_}};

}  // namespace

std::span<const GraphFunction> passMethods() {
    return kPassMethods;
}

}  // namespace terrane::lua
