// Uniforms of a frame, and the record of a material.
#ifndef TERRANE_SHARED_FRAME_H
#define TERRANE_SHARED_FRAME_H

#include "terrane/shared/constants.h"
#include "terrane/shared/language.h"

SHARED_BEGIN

// Positions on the GPU are in blocks from the corner of the camera's chunk at z = 0, so that they are small
// and exact wherever in the world the camera is. Colors are linear. vec4 positions, directions and colors use
// x, y, z; their w is 0.
struct Frame {
    mat4 viewProjection;  // to clip space; depth 1 at the near plane, 0 at infinity

    vec4 rayAhead;   // from the camera to the middle of the image one block ahead
    vec4 rayAcross;  // from there to its right edge
    vec4 rayUp;      // and to its upper edge
    vec4 cameraPosition;

    vec4 lightDirection;  // to the sun or moon
    vec4 lightColor;      // of the sun or moon
    vec4 ambientColor;    // from the sky, on faces that look up
    vec4 horizonColor;
    vec4 glowColor;  // around the light at the horizon
    vec4 discColor;  // of the sun or moon itself
    vec4 exposure;   // of the eye, by color

    vec2 viewportSize;   // pixels
    vec2 lightOnScreen;  // the sun or moon, -1…1
    ivec2 cameraChunk;
    ivec2 firstLightTile;  // of the camera's chunk, in the light grid

    int lightGridTiles;           // along a side of the grid
    int switches;                 // kSwitch… bits
    int singleTransparencyLayer;  // the one transparency layer shown, 0 for all
    uint view;                    // 0 for the image, else a kView… value

    float fogDistance;    // blocks at which the fog is complete
    float nearPlane;      // blocks
    float edgeExpansion;  // pixels by which quads grow, see edge_expansion.glsl
    float timeSeconds;    // for animations

    uint waterAbove;         // blocks of water over the camera, its own included; 0 in air
    float ambientFromBelow;  // share of ambientColor on faces that look down
    float hiddenLampShare;   // share of lamp light that full daylight hides
    float discSine;          // sine of the radius of the sun's or moon's disc

    float starBrightness;  // 0…1
    float starTurn;        // turn of the stars, 0…1
    float lightRayShare;   // visible share of the light's rays, 0…1
    uint isMoon;           // 1 at night, when the light is the moon

    int bottom, top;  // the world's lowest layer, and the one above its highest
    uint unused0, unused1;
};

// Share of the fog distance, along the view direction, from which surfaces may fade: 5/6 over the ground,
// less toward the sides of a wide image.
const float kFadingBegins = 0.4f;

// Depths of the pixel mask where all surfaces of a pixel belong to far tiles, or lie beyond kSimpleLightFrom
// blocks along the view. Both are steps of 16 bits.
const float kFarSurfacesDepth = 21845.0f / 65535.0f;
const float kDistantSurfacesDepth = 43690.0f / 65535.0f;
const float kSimpleLightFrom = 48.0f;

const uint kViewNormal = 1u;
const uint kViewDepth = 2u;
const uint kViewMerging = 3u;  // each quad in a color of its own
const uint kViewLight = 4u;

// Bits of Frame::switches: options that cost nothing to branch on within a shader.
const int kSwitchAnimation = 1;
const int kSwitchDistanceFog = 4;
const int kSwitchUnlit = 8;  // the colors of the blocks alone

// A camera is in the clouds up to so many blocks below and above their plane.
const float kCloudDepth = 24.0f;

struct MaterialRecord {
    uint look;       // material.h
    uint options;    // material.h
    uint meanColor;  // of its texture, sRGB: red in bits 0–7, green, blue
    uint unused;
};

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(Frame) == 64 + 18 * 16, "members lie in groups of 16 bytes, as in std140");
static_assert(sizeof(MaterialRecord) == 16);
}  // namespace terrane::shared
#endif
#endif
