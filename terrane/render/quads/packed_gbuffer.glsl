// The packed G-buffer: a surface in four channels of eight bits: color (sRGB), and in alpha the direction (3 bits) and
// the glow of the texel (5 bits). Direction 7 is an escape: the upper bits are the direction of a face of a far tile (3
// bits) and its glow (2 bits). If that direction is 7 too, nothing was drawn: a cleared target has all ones.

#include "terrane/shared/shape_face.h"  // directions of faces
const uint kDirectionNone = 7u;

struct Surface {
    vec3 albedo;
    vec3 normal;
    float glow;
    uint direction;
    bool isFar;  // of a tile of level 1 or more, which has no light levels
    bool isFigure;  // `direction`: the nearest one to the normal
};

const uint kFarTile = 7u;
const uint kFigureMask = 0x87u, kFigure = 0x80u | kDirectionPlant;  // of alpha

vec3 normalOf(uint direction) {
    if (direction >= kDirectionPlant) return vec3(0.0, 0.0, 1.0);
    float along = (direction & 1u) == 0u ? -1.0 : 1.0;
    uint axis = direction >> 1;
    return along * vec3(axis == 0u, axis == 1u, axis == 2u);
}

vec4 packSurface(vec3 color, uint direction, float glow, bool isFar) {
    uint near = direction | uint((direction == kDirectionPlant ? 15.0 : 31.0) * glow + 0.5) << 3;
    uint far = kFarTile | direction << 3 | uint(3.0 * glow + 0.5) << 6;
    return vec4(color, float(isFar ? far : near) / 255.0);
}

// Normals of figures on an octahedron unfolded into a square of 31 × 31 (Q. Meyer et al., On Floating-Point Normal Vectors,
// 2010): axes are exact, others off by 4° at most.
const float kNormalSteps = 15.0;  // to each side of the middle

vec2 folded(vec2 v) {
    return (1.0 - abs(v.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(v, vec2(0.0)));
}

uint packNormal(vec3 normal) {
    vec3 n = normal / (abs(normal.x) + abs(normal.y) + abs(normal.z));
    uvec2 steps = uvec2(kNormalSteps * (n.z >= 0.0 ? n.xy : folded(n.xy)) + kNormalSteps + 0.5);
    return steps.x | steps.y << 5;
}

vec3 unpackNormal(uint bits) {
    vec2 v = (vec2(bits & 31u, bits >> 5) - kNormalSteps) / kNormalSteps;
    float z = 1.0 - abs(v.x) - abs(v.y);
    return normalize(vec3(z >= 0.0 ? v : folded(v), z));
}

vec4 packFigure(vec3 color, vec3 normal) {
    uint bits = packNormal(normal);
    uvec3 low = uvec3(bits, bits >> 2, bits >> 4) & 3u;
    return vec4(vec3(uvec3(63.0 * clamp(color, 0.0, 1.0) + 0.5) << 2u | low), float(kFigure | bits >> 6 << 3)) / 255.0;
}

// -x, +x, -y, +y, -z, +z as 0 … 5.
uint nextDirection(vec3 normal) {
    vec3 size = abs(normal);
    uint axis = size.x >= max(size.y, size.z) ? 0u : size.y >= size.z ? 1u : 2u;
    return 2u * axis + (normal[axis] > 0.0 ? 1u : 0u);
}

// sRGB to linear by a cubic, off by 0.002 at most (I. Taylor, sRGB approximations for HLSL, 2012).
vec3 linearFromSrgb(vec3 c) {
    return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878);
}

bool packedIsFar(vec4 packedSurface) {
    return (uint(255.0 * packedSurface.a + 0.5) & 7u) == kFarTile;
}

uint packedDirection(vec4 packedSurface) {
    uint byte = uint(255.0 * packedSurface.a + 0.5);
    return (byte & 7u) == kFarTile ? byte >> 3 & 7u : byte & 7u;
}

Surface unpackFigure(uvec4 bytes) {
    vec3 normal = unpackNormal((bytes.r & 3u) | (bytes.g & 3u) << 2 | (bytes.b & 3u) << 4 | (bytes.a >> 3 & 15u) << 6);
    return Surface(linearFromSrgb(vec3(bytes.rgb >> 2u) / 63.0), normal, 0.0, nextDirection(normal), false, true);
}

Surface unpackSurface(vec4 packedSurface) {
    uvec4 bytes = uvec4(255.0 * packedSurface + 0.5);
    if ((bytes.a & kFigureMask) == kFigure) return unpackFigure(bytes);
    uint direction = packedDirection(packedSurface);
    bool isFar = packedIsFar(packedSurface);
    float glow = isFar ? float(bytes.a >> 6) / 3.0 : float(bytes.a >> 3) / (direction == kDirectionPlant ? 15.0 : 31.0);
    return Surface(linearFromSrgb(packedSurface.rgb), normalOf(direction), glow, direction, isFar, false);
}
