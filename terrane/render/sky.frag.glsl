// The sky where it can be seen, behind surfaces that fade too. SAMPLES: of the G-buffer.
#include "terrane/render/frame_uniforms.glsl"
#include "terrane/render/sky_color.glsl"
#if SAMPLES > 1
#include "terrane/render/surfaces.glsl"
#endif

layout(location = 0) in vec2 inScreen;
layout(location = 1) in vec3 inRay;
layout(location = 0) out vec4 outColor;

void main() {
#if SAMPLES > 1
    float farthest = 1.0;
    for (int k = 0; k < SAMPLES; ++k) farthest = min(farthest, depthAt(ivec2(gl_FragCoord.xy), k));
    if (blocksOfDepth(farthest) < 0.4 * frame.cameraPosition.w) discard;
#endif
    vec3 direction = normalize(inRay);
    float angle = acos(clamp(dot(direction, frame.lightDirection.xyz), -1.0, 1.0));
    float disc = 1.0 - smoothstep(0.92, 1.0, angle / frame.lightColor.w);
    outColor = vec4(skyColor(direction) + disc * frame.discColor.rgb, 0.0);
}
