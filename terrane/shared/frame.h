// What the shaders know of a frame, of each draw and of each material.
#ifndef TERRANE_SHARED_FRAME_H
#define TERRANE_SHARED_FRAME_H

#include "terrane/shared/language.h"

SHARED_BEGIN

// Positions on the GPU are in blocks from the corner of the camera's chunk at z = 0, so that they are small
// and exact wherever in the world the camera is. Colours are linear.
struct Frame {
    mat4 viewProjection;  // to clip space; depth 1 at the near plane, 0 at infinity
    mat4 inverseViewProjection;
    vec4 cameraPosition;  // w: distance in blocks at which the fog is complete
    vec4 lightDirection;  // to the sun or moon; w: seconds for animations
    vec4 lightColor;      // of the sun or moon; w: radius of its disc, radians
    vec4 ambientColor;    // from the sky, on faces that look up; w: share of it on faces that look down
    vec4 zenithColor;     // w: exposure
    vec4 horizonColor;    // w: 0 for the picture, else a kView… value
    vec4 glowColor;       // around the light at the horizon
    vec4 viewport;  // width and height in pixels; z: by how many pixels quads grow, see crack_cover.glsl
};

const uint kViewColor = 0u;
const uint kViewNormal = 1u;
const uint kViewDepth = 2u;
const uint kViewAggregation = 3u;  // each quad in a colour of its own

// Of one indirect draw command, found by its base instance.
struct DrawRecord {
    vec4 origin;  // of the chunk, in the space above; w: 0…65535 from its place in the world
};

// Alpha modes and animations are the values of world::AlphaMode and world::Animation.
struct MaterialRecord {
    uint texture;  // layer of the array
    uint alphaMode;
    uint animation;
    uint unused;
};

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(Frame) == 2 * 64 + 8 * 16, "std140 and std430 agree on mat4 and vec4");
static_assert(sizeof(DrawRecord) == 16 && sizeof(MaterialRecord) == 16);
}  // namespace terrane::shared
#endif
#endif
