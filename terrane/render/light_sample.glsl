// Light at a point of a surface, from the tiles of LightStore. Needs frame_uniforms.glsl.
#include "terrane/shared/light_grid.h"

layout(binding = kLightGridUnit) uniform usampler3D lightGrid;
layout(binding = kLightPoolUnit) uniform sampler3D lightPool;

vec4 unpackLight(uint value) {
    return vec4(uvec4(value, value >> 4, value >> 8, value >> 12) & 15u) / 15.0;
}

// The tile of a block counted from the corner of the camera's chunk, or its one value.
uint lightEntry(ivec3 block) {
    ivec2 tile = (block.xy >> 3) + ivec2(frame.lightGrid.xy);
    int mask = int(frame.lightGrid.z) - 1;
    return texelFetch(lightGrid, ivec3(tile & mask, clamp(block.z, 0, 255) >> 3), 0).r;
}

ivec3 poolCorner(uint tile) {
    return ivec3(tile % kLightPoolTiles, tile / kLightPoolTiles % kLightPoolTiles,
                 tile / (kLightPoolTiles * kLightPoolTiles)) * 8;
}

// Red, green, blue, daylight of one block, 0…1.
vec4 lightOfBlock(ivec3 block) {
    // Above the world is the open sky.
    if (block.z > 255) return vec4(0.0, 0.0, 0.0, 1.0);
    uint entry = lightEntry(block);
    if ((entry & kLightUniformBit) != 0u) return unpackLight(entry & 0xFFFFu);
    return texelFetch(lightPool, poolCorner(entry) + ivec3(block.xy & 7, max(block.z, 0) & 7), 0);
}

// Nodes lie in the middles of blocks. Half a block along the normal from the surface the sample lies in the layer
// of nodes in front of it: solid blocks, which are dark, then do not count, but where they stand on that layer,
// which darkens inner corners.
vec4 sampleLight(vec3 position, vec3 normal) {
    vec3 at = position + 0.5 * normal - 0.5;
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
