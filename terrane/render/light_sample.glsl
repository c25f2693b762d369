// Light at a point of a surface, from the tiles of LightStore. Needs frame_uniforms.glsl. LIGHT_SMOOTH chooses between
// two ways of sampling, which docs/light.md compares: 0 classic, 1 smooth.
#include "terrane/render/light_nodes.glsl"
#if LIGHT_SMOOTH
#include "terrane/render/light_smooth.glsl"
#endif

// Nodes lie in the middles of blocks. Half a block along the normal from the surface the sample lies in the layer
// of nodes in front of it: solid blocks, which are dark, then do not count, but where they stand on that layer,
// which darkens inner corners.
vec4 sampleClassic(vec3 at) {
    ivec3 block = ivec3(floor(at));
    vec3 f = at - vec3(block);
    ivec3 last = block + 1;
    // In nine of ten cases all eight nodes lie in one tile: one entry, one filtered fetch.
    if (block.x >> 3 == last.x >> 3 && block.y >> 3 == last.y >> 3 && block.z >> 3 == last.z >> 3 && block.z >= 0 &&
        last.z < 256) {
        uint entry = lightEntry(block);
        if ((entry & kLightUniformBit) != 0u) return unpackLight(entry & 0xFFFFu);
        vec3 texel = vec3(poolCorner(entry) + (block & 7)) + f + 0.5;
        return textureLod(lightPool, texel / vec3(textureSize(lightPool, 0)), 0.0);
    }
    vec4 sum = vec4(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        ivec3 step = ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
        vec3 w = mix(1.0 - f, f, vec3(step));
        float weight = w.x * w.y * w.z;
        if (weight > 0.0) sum += weight * lightOfBlock(block + step);
    }
    return sum;
}

// Red, green, blue, daylight, 0…1. A normal of zero: inside a block, of plants.
vec4 sampleLight(vec3 position, vec3 normal) {
    vec3 at = position + 0.5 * normal - 0.5;
#if LIGHT_SMOOTH
    return sampleSmooth(at, normal);
#else
    return sampleClassic(at);
#endif
}
