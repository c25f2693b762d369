// What the shaders know of a frame and of each material.
#ifndef TERRANE_SHARED_FRAME_H
#define TERRANE_SHARED_FRAME_H

#include "terrane/shared/language.h"

SHARED_BEGIN

// Positions on the GPU are in blocks from the corner of the camera's chunk at z = 0, so that they are small
// and exact wherever in the world the camera is. Colours are linear.
struct Frame {
    mat4 viewProjection;  // to clip space; depth 1 at the near plane, 0 at infinity
    mat4 toShadowMap;     // x, y: 0…1 over the map; z: its depth
    vec4 rayAhead;        // from the camera to the middle of the picture one block ahead
    vec4 rayAcross;       // from there to its right edge
    vec4 rayUp;           // and to its upper edge
    vec4 cameraPosition;  // w: distance in blocks at which the fog is complete
    vec4 lightDirection;  // to the sun or moon; w: seconds for animations
    vec4 lightColor;      // of the sun or moon; w: sine of its disc's radius
    vec4 ambientColor;    // from the sky, on faces that look up; w: share of it on faces that look down
    vec4 zenithColor;     // w: exposure
    vec4 horizonColor;    // w: 0 for the picture, else a kView… value
    vec4 glowColor;       // around the light at the horizon; w: share of lamp light that full daylight hides
    vec4 discColor;       // of the sun or moon itself; w: brightness of the stars, 0…1
    vec4 lightGrid;       // x, y: the camera chunk's first light tile; z: tiles along a side of the grid
    vec4 viewport;  // width and height in pixels; z: by how many pixels quads grow, see crack_cover.glsl;
                    // w: distance of the near plane, blocks
    vec4 shadow;    // x: strength, 0 without a map; y: blocks a texel; z: distance of no shadow; w: texels a
                    // side
    vec4
        light;  // x, y: the light on the screen, -1…1; z: how much of its rays is seen, 0…1; w: 1 under water
    vec4 sky;      // x: how far the stars have turned, 0…1; y: 1 at night, when the light is the moon
    ivec4 camera;  // x, y: the camera's chunk; z: kSwitch… bits; w: the one layer shown, 0 for all
};

// Along the view, as the depth has it, surfaces may fade from this share of the distance of the fog on: they
// do from 5/6 over the ground, and more at the sides of a wide picture.
const float kFadingBegins = 0.4f;

const uint kViewNormal = 1u;
const uint kViewDepth = 2u;
const uint kViewAggregation = 3u;  // each quad in a colour of its own
const uint kViewLight = 4u;

// Frame::camera.z: what costs nothing to switch within a shader.
const int kSwitchAnimation = 1;
const int kSwitchAtmosphere = 4;
const int kSwitchUnlit = 8;  // the colours of the blocks alone

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
static_assert(sizeof(Frame) == 2 * 64 + 17 * 16, "std140 and std430 agree on mat4 and vec4");
static_assert(sizeof(MaterialRecord) == 16);
}  // namespace terrane::shared
#endif
#endif
