// A packed layer: a blended surface in four channels of sixteen bits: color (sRGB), and in alpha eight bits of coverage
// above the direction, a bit for far tiles and a bit for liquids.
#include "terrane/render/quads/packed_gbuffer.glsl"

struct Layer {
    Surface surface;
    float alpha;
    bool isLiquid;
};

vec4 packLayer(vec4 color, uint direction, bool isFar, bool isLiquid) {
    uint bits = uint(255.0 * color.a + 0.5) << 8 | (isLiquid ? 16u : 0u) | (isFar ? 8u : 0u) | direction;
    return vec4(color.rgb, float(bits) / 65535.0);
}

Layer unpackLayer(vec4 packedLayer) {
    uint bits = uint(65535.0 * packedLayer.a + 0.5);
    Surface s = Surface(linearFromSrgb(packedLayer.rgb), normalOf(bits & 7u), 0.0, bits & 7u, (bits & 8u) != 0u, false);
    return Layer(s, float(bits >> 8) / 255.0, (bits & 16u) != 0u);
}
