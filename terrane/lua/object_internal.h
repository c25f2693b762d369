// The objects that scripts hold beside Lua's own values. All userdata of a state are such objects.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "terrane/gen/language/expr.h"
#include "terrane/lua/lua_headers.h"

namespace terrane::lua {

// Expressions of generators as values of Lua. Literals are Lua's own numbers and booleans; blocks may be
// given by name.
enum class Kind : std::uint8_t { Bool, Int, Float, Block, Vec2, Vec3, IVec2, IVec3, Count };

// A scalar, or the components of a vector. Lua stores it as bytes.
struct Expression {
    Kind kind = Kind::Int;
    std::uint32_t pass = 0;  // Recording::passNumber; 0: literals, which are good in every pass
    std::array<gen::Value, 3> parts{};
};
static_assert(std::is_trivially_destructible_v<Expression>, "Lua calls no destructor");

std::string_view nameOf(Kind kind);

constexpr std::size_t partCount(Kind kind) {
    if (kind == Kind::Vec2 || kind == Kind::IVec2) return 2;
    return kind == Kind::Vec3 || kind == Kind::IVec3 ? 3 : 1;
}

// Returns the type of a scalar or of a vector's components.
constexpr gen::Type typeOf(Kind kind) {
    if (kind == Kind::Bool) return gen::Type::Bool;
    return kind == Kind::Float || kind == Kind::Vec2 || kind == Kind::Vec3 ? gen::Type::Float
                                                                           : gen::Type::Int;
}

template <class T>
inline constexpr Kind kKindOf = Kind::Count;
template <>
inline constexpr Kind kKindOf<gen::Bool> = Kind::Bool;
template <>
inline constexpr Kind kKindOf<gen::Int> = Kind::Int;
template <>
inline constexpr Kind kKindOf<gen::Float> = Kind::Float;
template <>
inline constexpr Kind kKindOf<gen::Block> = Kind::Block;
template <>
inline constexpr Kind kKindOf<gen::Vec2> = Kind::Vec2;
template <>
inline constexpr Kind kKindOf<gen::Vec3> = Kind::Vec3;
template <>
inline constexpr Kind kKindOf<gen::IVec2> = Kind::IVec2;
template <>
inline constexpr Kind kKindOf<gen::IVec3> = Kind::IVec3;

using Parts = std::array<gen::Value, 3>;

template <class T>
T fromParts(const Parts& parts) {
    if constexpr (partCount(kKindOf<T>) == 1) {
        return T(parts[0]);
    } else {
        using Component = decltype(T::x);
        if constexpr (partCount(kKindOf<T>) == 2) return {Component(parts[0]), Component(parts[1])};
        if constexpr (partCount(kKindOf<T>) == 3)
            return {Component(parts[0]), Component(parts[1]), Component(parts[2])};
    }
}

template <class T>
Parts toParts(const T& value) {
    if constexpr (partCount(kKindOf<T>) == 1) return {value};
    if constexpr (partCount(kKindOf<T>) == 2) return {value.x, value.y};
    if constexpr (partCount(kKindOf<T>) == 3) return {value.x, value.y, value.z};
}

enum class Tag : std::uint8_t { None, Expression, Variable, Field, Drainage, Pass, Generator };

struct Object {
    Tag tag = Tag::None;
    std::uint32_t number = 0;  // the number of a variable, field, map
    Expression expression{};   // a variable, field or pass sets kind and pass alone
};

// Returns the object of a value; null if the value is no object.
const Object* objectAt(lua_State* L, int index);
// Returns the name that type() returns: "Float", "Pass", "Field".
std::string_view nameOf(const Object& object);

void pushObject(lua_State* L, const Object& object);
// Creates the operators and methods of each kind of object, for pushObject().
void makeObjectTypes(lua_State* L);

}  // namespace terrane::lua
