#include "terrane/shared/bindings.h"
#include "terrane/shared/frame.h"
#include "terrane/shared/variants.h"

layout(std140, binding = kFrameBinding) uniform FrameBlock {
    Frame frame;
};

// Vector from the camera to the point one block ahead at a place of the screen, -1…1. Not computed with an inverse
// matrix: far from the corner of the chunk that would round off the precision that positions need.
vec3 rayAt(vec2 screen) {
    return frame.rayAhead.xyz + screen.x * frame.rayAcross.xyz + screen.y * frame.rayUp.xyz;
}

// Wind of clouds and waves in blocks a second, added to texture coordinates: patterns move the other way.
const vec2 kWind = vec2(5.0, 2.0);
