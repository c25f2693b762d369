// The sky between the points of corner_sky.vert.glsl.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/render/frame/tone.glsl"

layout(location = 0) in vec3 inColor;
layout(location = 0) out vec4 outColor;

void main() {
    outColor = vec4(dithered(inColor, ivec2(gl_FragCoord.xy)), 1.0);
}
