// Expressions of two and three numbers, component by component. See expr.h.
#pragma once

#include "terrane/gen/expr.h"

namespace terrane::gen {

struct Vec2 {
    Float x, y;
};

struct Vec3 {
    Float x, y, z;
};

struct IVec2 {
    Int x, y;
};

struct IVec3 {
    Int x, y, z;
};

// clang-format off
inline Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
inline Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
inline Vec2 operator*(Vec2 a, Float s) { return {a.x * s, a.y * s}; }
inline Vec2 operator*(Float s, Vec2 a) { return a * s; }
inline Float dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
inline Float length(Vec2 v) { return sqrt(dot(v, v)); }
inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(Vec3 a, Float s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3 operator*(Float s, Vec3 a) { return a * s; }
inline Float dot(Vec3 a, Vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
inline Float length(Vec3 v) { return sqrt(dot(v, v)); }
inline IVec2 operator+(IVec2 a, IVec2 b) { return {a.x + b.x, a.y + b.y}; }
inline IVec2 operator-(IVec2 a, IVec2 b) { return {a.x - b.x, a.y - b.y}; }
inline Bool operator==(IVec2 a, IVec2 b) { return a.x == b.x && a.y == b.y; }
// clang-format on

}  // namespace terrane::gen
