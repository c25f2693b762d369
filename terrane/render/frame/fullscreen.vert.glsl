// One triangle that covers the screen, at depth 0: infinitely far.
#include "terrane/render/frame/frame_uniforms.glsl"

layout(location = 0) out vec2 outScreen;  // -1…1
layout(location = 1) out vec3 outRay;     // from the camera to the point one block ahead

void main() {
    outScreen = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(outScreen, 0.0, 1.0);
    outRay = rayAt(outScreen);
}
