// Single nodes of the light in LightStore.
#include "terrane/shared/light_grid.h"

layout(binding = kLightGridUnit) uniform usampler3D lightGrid;
layout(binding = kLightEntriesUnit) uniform usamplerBuffer lightEntries;
layout(binding = kLightPoolUnit) uniform sampler3D lightPool;

vec4 unpackLight(uint value) {
    return vec4(uvec4(value, value >> 4, value >> 8, value >> 12) & 15u) / 15.0;
}

// Light tile of a block counted from the corner of the camera's chunk, or its one value.
uint lightEntry(ivec3 block) {
    ivec3 tile = ivec3((block.xy >> 3) + frame.firstLightTile, (clamp(block.z, frame.bottom, frame.top - 1) - frame.bottom) >> 3);
    tile.xy &= frame.lightGridTiles - 1;
    uint entry = texelFetch(lightGrid, tile >> 1, 0).r;
    if ((entry & kLightUniformBit) != 0u) return entry;
    ivec3 inBrick = tile & 1;
    return texelFetch(lightEntries, 8 * int(entry) + inBrick.x + 2 * inBrick.y + 4 * inBrick.z).r;
}

ivec3 poolCorner(uint tile) {
    return ivec3(tile % kLightPoolTiles, tile / kLightPoolTiles % kLightPoolTiles,
                 tile / (kLightPoolTiles * kLightPoolTiles)) * 8;
}

// Red, green, blue, daylight of a block with a known entry, 0…1.
vec4 lightOfEntry(uint entry, ivec3 block) {
    // Above the world is the open sky.
    if (block.z >= frame.top) return vec4(0.0, 0.0, 0.0, 1.0);
    if ((entry & kLightUniformBit) != 0u) return unpackLight(entry & 0xFFFFu);
    return texelFetch(lightPool, poolCorner(entry) + ivec3(block.xy & 7, max(block.z, frame.bottom) & 7), 0);
}

// Light between a node and the next ones of its light tile: `f` is the place between them, 0…1 along each axis.
vec4 lightBetween(ivec3 block, vec3 f) {
    uint entry = lightEntry(block);
    bool isUniform = (entry & kLightUniformBit) != 0u;
    vec3 texel = vec3(poolCorner(isUniform ? 0u : entry) + (block & 7)) + f + 0.5;
    vec4 light = textureLod(lightPool, texel / vec3(textureSize(lightPool, 0)), 0.0);
    light = isUniform ? unpackLight(entry & 0xFFFFu) : light;
    // Above the world is the open sky.
    return block.z >= frame.top ? vec4(0.0, 0.0, 0.0, 1.0) : light;
}
