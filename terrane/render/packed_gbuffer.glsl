// The packed G-buffer: a surface in four channels of eight bits: color (sRGB), and in alpha the direction (3 bits) with the
// glow of the texel (5 bits). Direction 7 is an escape: the upper bits are the direction of a face of a far tile (3 bits) with
// its glow (2 bits). Nothing drawn is 7 there too: a cleared target, all ones.

const uint kDirectionPlant = 6u;  // planes that stand oblique: they are lit like the ground they stand on
const uint kDirectionNone = 7u;

struct Surface {
    vec3 albedo;
    vec3 normal;
    float glow;
    uint direction;
    bool isFar;  // of a tile of level 1 or more, which has no light of its own
};

const uint kFarTile = 7u;

vec3 normalOf(uint direction) {
    if (direction >= kDirectionPlant) return vec3(0.0, 0.0, 1.0);
    float along = (direction & 1u) == 0u ? -1.0 : 1.0;
    uint axis = direction >> 1;
    return along * vec3(axis == 0u, axis == 1u, axis == 2u);
}

vec4 packSurface(vec3 color, uint direction, float glow, bool isFar) {
    uint near = direction | uint(31.0 * glow + 0.5) << 3;
    uint far = kFarTile | direction << 3 | uint(3.0 * glow + 0.5) << 6;
    return vec4(color, float(isFar ? far : near) / 255.0);
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

Surface unpackSurface(vec4 packedSurface) {
    uint byte = uint(255.0 * packedSurface.a + 0.5), direction = packedDirection(packedSurface);
    bool isFar = packedIsFar(packedSurface);
    float glow = isFar ? float(byte >> 6) / 3.0 : float(byte >> 3) / 31.0;
    return Surface(linearFromSrgb(packedSurface.rgb), normalOf(direction), glow, direction, isFar);
}
