#include "terrane/shared/bindings.h"
#include "terrane/shared/frame.h"

layout(std140, binding = kFrameBinding) uniform FrameBlock {
    Frame frame;
};

// From the camera to what lies one block ahead at a place of the screen, -1…1. Not by an inverse matrix: far from the
// corner of the chunk that would round away what the position is to be exact to.
vec3 rayAt(vec2 screen) {
    return frame.rayAhead.xyz + screen.x * frame.rayAcross.xyz + screen.y * frame.rayUp.xyz;
}
