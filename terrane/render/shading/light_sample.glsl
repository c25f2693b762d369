// Light at a point of a surface, from the light tiles of LightStore. Needs frame_uniforms.glsl. LIGHT selects the way of
// sampling, see docs/light.md: classic, smooth, or smooth without the wide filter, whose effect is invisible far away.
#include "terrane/render/shading/light_nodes.glsl"
#if LIGHT != LIGHT_CLASSIC
#include "terrane/render/shading/light_smooth.glsl"
#endif

// Nodes lie in the middles of blocks. The sample is half a block off the surface along the normal, in the layer of
// nodes in front of it. So the dark solid blocks behind the surface do not count; solid blocks in that layer do, and
// darken inner corners. The eight nodes are in one light tile, or in two along each axis: the part in a light tile
// takes one entry and one filtered fetch. The loop goes through the subsets of the axes on which a second light tile
// begins; for most samples that is the empty one.
vec4 sampleClassic(vec3 at) {
    const float kOnNode = 1.0 / 64.0;  // this near a node the next one does not count
    const float kSteps = 256.0;        // makes sums exact, so that the place of a light tile in the pool is not visible
    at.z = max(at.z, float(frame.bottom));
    ivec3 block = ivec3(floor(at));
    vec3 f = floor(kSteps * (at - vec3(block)) + 0.5) / kSteps;
    f *= vec3(greaterThan(f, vec3(kOnNode)));
    ivec3 crosses = ivec3(equal(block & 7, ivec3(7))) * ivec3(greaterThan(f, vec3(0.0)));
    vec3 inTile = vec3(1 - crosses) * f;
    int axes = crosses.x | crosses.y << 1 | crosses.z << 2, beyond = 0;
    vec4 sum = vec4(0.0);
    do {
        ivec3 step = ivec3(beyond, beyond >> 1, beyond >> 2) & 1;
        vec3 w = mix(vec3(1.0), mix(1.0 - f, f, vec3(step)), vec3(crosses));
        sum += w.x * w.y * w.z * lightBetween(block + step, inTile);
        beyond = (beyond - axes) & axes;
    } while (beyond != 0);
    return sum;
}

// Red, green, blue, daylight, 0…1. A normal of zero samples inside a block, for plants.
vec4 sampleLight(vec3 position, vec3 normal) {
    vec3 at = position + 0.5 * normal - 0.5;
#if LIGHT != LIGHT_CLASSIC
    // A face in the middle of an opaque block, as stairs have, is lit by the layer in front of the block.
    const float kPastMiddle = 1.0 / 64.0;
    return sampleSmooth(at + kPastMiddle * normal, normal);
#else
    return sampleClassic(at);
#endif
}
